// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/boxes/box_overlap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/clip_convex.h"
#include "unseen/cuboids/evaluate.h"

namespace unseen::cuboids {
namespace {

constexpr double kSame = 1e-9;  // m, planes this near are one

bool is_same(const BoxFace& a, const BoxFace& b) {
  return (a.normal - b.normal).norm() < kSame && std::abs(a.normal.dot(b.center - a.center)) < kSame;
}

std::vector<BoxFace> faces_of(const OrientedBox& box) {
  std::vector<BoxFace> faces;
  for (int k = 0; k < 3; ++k)
    for (const double sign : {-1.0, 1.0}) faces.push_back(face_of(box, k, sign));
  return faces;
}

/// The part of a face that lies in the box with these sides.
std::vector<Vec3> clipped(const BoxFace& face, const std::vector<BoxFace>& sides) {
  const Vec3 u = face.half_u * face.u, v = face.half_v * face.v;
  std::vector<Vec3> polygon = {face.center - u - v, face.center + u - v, face.center + u + v, face.center - u + v};
  for (const BoxFace& side : sides)
    polygon = clip_convex(polygon, [&](const Vec3& p) {
      const double height = side.normal.dot(p - side.center);
      return std::abs(height) <= kSame ? 0.0 : height;
    });
  return polygon;
}

/// Three times the volume over those faces of the intersection that lie on faces of `a`, seen from `from`.
double cone_volume(const std::vector<BoxFace>& a, const std::vector<BoxFace>& b, const Vec3& from, bool skip_shared) {
  double sum = 0;
  for (const BoxFace& face : a) {
    if (skip_shared && std::any_of(b.begin(), b.end(), [&](const BoxFace& f) { return is_same(f, face); })) continue;
    const std::vector<Vec3> polygon = clipped(face, b);
    Vec3 twice = Vec3::Zero();
    for (std::size_t i = 2; i < polygon.size(); ++i)
      twice += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
    sum += face.normal.dot(face.center - from) * std::abs(twice.dot(face.normal)) / 2.0;
  }
  return sum;
}

}  // namespace

BoxFace face_of(const OrientedBox& box, int k, double sign) {
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const Vec3 normal = sign * box.axes.col(k);
  return {box.center + box.half_size[k] * normal, normal, box.axes.col(i), box.axes.col(j), box.half_size[i],
          box.half_size[j]};
}

double half_extent(const OrientedBox& box, const Vec3& direction) {
  return (box.axes.transpose() * direction).cwiseAbs().dot(box.half_size);
}

double separation(const OrientedBox& a, const OrientedBox& b) {
  const Vec3 between = b.center - a.center;
  double largest = -std::numeric_limits<double>::infinity();
  const auto try_axis = [&](const Vec3& axis) {
    const double norm = axis.norm();
    if (norm < 1e-6) return;
    const Vec3 unit = axis / norm;
    largest = std::max(largest, std::abs(unit.dot(between)) - half_extent(a, unit) - half_extent(b, unit));
  };
  for (int i = 0; i < 3; ++i) {
    try_axis(a.axes.col(i));
    try_axis(b.axes.col(i));
    for (int j = 0; j < 3; ++j) try_axis(a.axes.col(i).cross(b.axes.col(j)));
  }
  return largest;
}

double intersection_volume(const OrientedBox& a, const OrientedBox& b) {
  if (separation(a, b) >= 0) return 0.0;
  const auto faces_a = faces_of(a), faces_b = faces_of(b);
  const double three = cone_volume(faces_a, faces_b, a.center, false) + cone_volume(faces_b, faces_a, a.center, true);
  return std::max(0.0, three / 3.0);
}

std::vector<Vec3> intersection_corners(const OrientedBox& a, const OrientedBox& b) {
  std::vector<Vec3> corners;
  if (separation(a, b) >= 0) return corners;
  const auto faces_a = faces_of(a), faces_b = faces_of(b);
  for (const BoxFace& face : faces_a)
    for (const Vec3& p : clipped(face, faces_b)) corners.push_back(p);
  for (const BoxFace& face : faces_b)
    for (const Vec3& p : clipped(face, faces_a)) corners.push_back(p);
  return corners;
}

double intersection_over_union(const OrientedBox& a, const OrientedBox& b) {
  const double both = intersection_volume(a, b), either = a.volume() + b.volume() - both;
  return either > 0 ? both / either : 0.0;
}

}  // namespace unseen::cuboids
