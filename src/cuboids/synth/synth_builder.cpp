// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/synth/synth_builder.h"

#include <algorithm>
#include <cmath>

#include "core/clip_convex.h"
#include "cuboids/boxes/box_overlap.h"

namespace unseen::cuboids {
namespace {

constexpr double kFlushFace = 1e-7;      // m, faces this near are one plane
constexpr double kLeastArea = 1e-4;  // m²
constexpr double kLeastEdge = 5e-3;  // m
constexpr double kInside = 1e-3;     // m, an edge counts only so far inside the other's face

/// m², that two parallel rectangles share.
double shared_area(const BoxFace& a, const BoxFace& b) {
  std::vector<Vec2> polygon;
  for (const auto& [su, sv] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const Vec3 p = b.center + su * b.half_u * b.u + sv * b.half_v * b.v - a.center;
    polygon.emplace_back(p.dot(a.u), p.dot(a.v));
  }
  for (const double sign : {-1.0, 1.0}) {
    polygon = clip_convex(polygon, [&](const Vec2& p) { return sign * p.x() - a.half_u; });
    polygon = clip_convex(polygon, [&](const Vec2& p) { return sign * p.y() - a.half_v; });
  }
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    twice += p.x() * q.y() - p.y() * q.x();
  }
  return std::abs(twice) / 2.0;
}

/// m, of the edge from p to q that lies well within a face.
double length_on(const BoxFace& face, const Vec3& p, const Vec3& q) {
  if (std::abs(face.normal.dot(p - face.center)) > kFlushFace || std::abs(face.normal.dot(q - face.center)) > kFlushFace)
    return 0.0;
  double low = 0.0, high = 1.0;
  for (const auto& [axis, half] : {std::pair{face.u, face.half_u}, {face.v, face.half_v}}) {
    const double from = axis.dot(p - face.center), to = axis.dot(q - face.center), reach = half - kInside;
    if (std::abs(to - from) < kFlushFace) {
      if (std::abs(from) > reach) return 0.0;
      continue;
    }
    const double t0 = (-reach - from) / (to - from), t1 = (reach - from) / (to - from);
    low = std::max(low, std::min(t0, t1));
    high = std::min(high, std::max(t0, t1));
  }
  return std::max(0.0, high - low) * (q - p).norm();
}

bool edge_lies_on(const OrientedBox& a, const OrientedBox& b) {
  const auto corners = corners_of(a);
  for (int k = 0; k < 3; ++k)
    for (int corner = 0; corner < 8; ++corner) {
      if (corner & (1 << k)) continue;
      for (int f = 0; f < 3; ++f)
        for (const double sign : {-1.0, 1.0})
          if (length_on(face_of(b, f, sign), corners[corner], corners[corner | (1 << k)]) > kLeastEdge) return true;
    }
  return false;
}

/// True if an edge or a face of the box lies on the plane.
bool touches_plane(const OrientedBox& box, const Plane& plane) {
  int near = 0;
  for (const Vec3& corner : corners_of(box)) near += std::abs(plane.signed_distance(corner)) < kFlushFace;
  return near >= 2;
}

}  // namespace

std::array<Vec3, 8> corners_of(const OrientedBox& box) {
  std::array<Vec3, 8> corners;
  for (int i = 0; i < 8; ++i) {
    const Vec3 side(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
    corners[i] = box.center + box.axes * side.cwiseProduct(box.half_size);
  }
  return corners;
}

bool boxes_touch(const OrientedBox& a, const OrientedBox& b) {
  for (int k = 0; k < 3; ++k)
    for (const double sign : {-1.0, 1.0}) {
      const BoxFace face = face_of(a, k, sign);
      for (int m = 0; m < 3; ++m)
        for (const double other : {-1.0, 1.0}) {
          const BoxFace against = face_of(b, m, other);
          const bool opposed = (face.normal + against.normal).norm() < kFlushFace;
          const double gap = face.normal.dot(against.center - face.center);
          if (opposed && std::abs(gap) < kFlushFace && shared_area(face, against) > kLeastArea) return true;
        }
    }
  return edge_lies_on(a, b) || edge_lies_on(b, a);
}

int SynthBuilder::add(const OrientedBox& box) {
  boxes_.push_back(box);
  return static_cast<int>(boxes_.size()) - 1;
}

int SynthBuilder::stand(const Vec3& foot, const Vec3& size, double yaw) {
  return add({foot + Vec3(0, 0, size.z() / 2), Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix(), size / 2});
}

int SynthBuilder::lean(const Vec3& foot, double heading, double slope, const Vec3& size) {
  const Vec3 level(std::cos(heading), std::sin(heading), 0.0);
  Mat3 axes;
  axes.col(0) = std::cos(slope) * level + std::sin(slope) * Vec3::UnitZ();
  axes.col(2) = -std::sin(slope) * level + std::cos(slope) * Vec3::UnitZ();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return add({foot + axes.col(0) * size.x() / 2 + axes.col(2) * size.z() / 2, axes, size / 2});
}

double SynthBuilder::back() const {
  double y = 0;
  for (const OrientedBox& box : boxes_)
    for (const Vec3& corner : corners_of(box)) y = std::max(y, corner.y());
  return y;
}

SynthModel SynthBuilder::take() const {
  SynthModel model;
  model.supports.push_back({0, SupportKind::ground, {Vec3::UnitZ(), 0.0}, {}});
  if (wall_) model.supports.push_back({1, SupportKind::wall, {-Vec3::UnitY(), -*wall_}, {}});
  model.boxes = boxes_;
  const auto listed = [](const std::vector<std::pair<int, int>>& pairs, int a, int b) {
    return std::any_of(pairs.begin(), pairs.end(),
                       [&](const auto& p) { return p == std::pair{a, b} || p == std::pair{b, a}; });
  };
  const int count = static_cast<int>(boxes_.size());
  const auto add = [&](int a, int b, bool fixed) {
    Contact contact;
    contact.a = a;
    contact.b = b;
    contact.kind = fixed ? ContactKind::fixed : ContactKind::touching;
    model.contacts.push_back(contact);
  };
  for (const Support& support : model.supports)
    for (int b = 0; b < count; ++b) {
      const bool held = support.kind == SupportKind::wall &&
                        std::count(fixed_to_wall_.begin(), fixed_to_wall_.end(), b) > 0;
      if (touches_plane(boxes_[b], support.plane)) add(support.id, model.id_of_box(b), held);
    }
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b)
      if (listed(touching_, a, b) || boxes_touch(boxes_[a], boxes_[b]))
        add(model.id_of_box(a), model.id_of_box(b), listed(fixed_, a, b));
  return model;
}

}  // namespace unseen::cuboids
