// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/surfaces/faces.h"

#include <algorithm>
#include <cmath>

#include "core/linear.h"

namespace unseen::cuboids {
namespace {

constexpr double kFaceSigmas = 3.0;
const double kGrowCosine = std::cos(radians(22.0));  // normals of neighbours; their error is some 3–8°
constexpr double kFirstFit = 12;                     // points, at least
constexpr int kBuckets = 64;
constexpr float kFlattest = 2.0f, kRoughest = 4.0f;  // in σ; rougher surroundings seed nothing

/// Weighted sums about an origin close by, so that nothing cancels.
struct Sums {
  Vec3 origin = Vec3::Zero(), first = Vec3::Zero();
  Mat3 second = Mat3::Zero();
  double weight = 0;

  void add(const Vec3& p, double w) {
    const Vec3 d = p - origin;
    first += w * d;
    second += w * d * d.transpose();
    weight += w;
  }
};

void fit(const Sums& sums, const Vec3& viewpoint, Face& face) {
  const Vec3 mean = sums.first / sums.weight;
  const Mat3 covariance = sums.second / sums.weight - mean * mean.transpose();
  const SymmetricEigen<3> eigen = symmetric_eigen(covariance);
  Vec3 normal = eigen.vectors.col(0);
  face.center = sums.origin + mean;
  if (normal.dot(viewpoint - face.center) < 0.0) normal = -normal;
  face.plane = {normal, normal.dot(face.center)};
  face.width = std::sqrt(std::max(eigen.values[1], 0.0));
  face.length = std::sqrt(std::max(eigen.values[2], 0.0));
}

/// Points that a region needs before its own normal is better than that of its seed: those of a square `width` σ wide.
std::size_t first_fit(const PointGraph& graph, int seed, double width) {
  const double across = width * graph.sigma[seed] / graph.spacing[seed];
  return static_cast<std::size_t>(std::max(kFirstFit, across * across));
}

/// Points in order of flatness, in a few classes; equal ones in their own order.
std::vector<int> seeds_in_order(const PointGraph& graph, std::span<const int> group) {
  std::vector<std::vector<int>> buckets(kBuckets);
  for (int i = 0; i < static_cast<int>(group.size()); ++i)
    if (group[i] >= 0 && graph.flatness[i] < kRoughest)
      buckets[static_cast<int>(std::min(graph.flatness[i] / kFlattest, 1.0f) * (kBuckets - 1))].push_back(i);
  std::vector<int> order;
  for (const std::vector<int>& bucket : buckets) order.insert(order.end(), bucket.begin(), bucket.end());
  return order;
}

void finish(Face& face, std::span<const Vec3> points, const PointGraph& graph, const Vec3& viewpoint) {
  Sums sums;
  sums.origin = points[face.points.front()];
  for (const int i : face.points) sums.add(points[i], 1.0 / (double(graph.sigma[i]) * graph.sigma[i]));
  fit(sums, viewpoint, face);
  face.area = 0;
  double squares = 0;
  for (const int i : face.points) {
    const Vec3 ray = (points[i] - viewpoint).normalized();
    const double spacing = graph.spacing[i], slant = std::max(std::abs(ray.dot(face.plane.normal)), 0.1);
    face.area += spacing * spacing / slant;
    const double d = face.plane.signed_distance(points[i]) / graph.sigma[i];
    squares += d * d;
  }
  face.rms = std::sqrt(squares / static_cast<double>(face.points.size()));
}

}  // namespace

Faces grow_faces(std::span<const Vec3> points, const PointGraph& graph, std::span<const int> group,
                 const Vec3& viewpoint, int min_points, double first_width) {
  Faces result;
  result.face_of_point.assign(points.size(), -1);
  std::vector<int>& face_of = result.face_of_point;
  std::vector<char> tried(points.size(), 0);
  for (const int seed : seeds_in_order(graph, group)) {
    if (face_of[seed] >= 0 || tried[seed]) continue;
    const int id = static_cast<int>(result.faces.size());
    Face face;
    face.plane = {graph.normals[seed], graph.normals[seed].dot(points[seed])};
    face.points = {seed};
    face_of[seed] = id;
    Sums sums;
    sums.origin = points[seed];
    std::size_t next_fit = first_fit(graph, seed, first_width);
    for (std::size_t at = 0; at < face.points.size(); ++at) {
      const int i = face.points[at];
      sums.add(points[i], 1.0 / (double(graph.sigma[i]) * graph.sigma[i]));
      if (at >= next_fit) {
        fit(sums, viewpoint, face);
        next_fit = next_fit * 3 / 2;
      }
      for (const int j : graph.neighbours(i)) {
        if (face_of[j] >= 0 || group[j] != group[seed]) continue;
        if (graph.normals[j].dot(face.plane.normal) < kGrowCosine) continue;
        if (std::abs(face.plane.signed_distance(points[j])) > kFaceSigmas * graph.sigma[j]) continue;
        face_of[j] = id;
        face.points.push_back(j);
      }
    }
    if (static_cast<int>(face.points.size()) < min_points) {
      for (const int i : face.points) face_of[i] = -1, tried[i] = 1;
      continue;
    }
    result.faces.push_back(std::move(face));
  }
  for (Face& face : result.faces) finish(face, points, graph, viewpoint);
  // Near an edge normals are mixed: there the planes decide.
  for (std::size_t f = 0; f < result.faces.size(); ++f) {
    Face& face = result.faces[f];
    for (std::size_t at = 0; at < face.points.size(); ++at)
      for (const int j : graph.neighbours(face.points[at])) {
        if (face_of[j] >= 0 || group[j] != group[face.points[at]]) continue;
        if (std::abs(face.plane.signed_distance(points[j])) > kFaceSigmas * graph.sigma[j]) continue;
        face_of[j] = static_cast<int>(f);
        face.points.push_back(j);
      }
  }
  for (Face& face : result.faces) finish(face, points, graph, viewpoint);
  return result;
}

}  // namespace unseen::cuboids
