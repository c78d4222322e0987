// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "planes/result/describe.h"
#include "planes/result/equal_steps.h"
#include "planes/result/faced.h"
#include "unseen/core/convex.h"

namespace unseen::planes {
namespace {

constexpr double kAlikeLengths = 0.25;    // of the scale: lengths are equal that differ by less than twice that
constexpr double kShortest = 1.0;         // of the scale: a length is larger
constexpr double kAlikeByChance = 0.05;   // planes as alike that a direction may be expected to have by chance
constexpr std::size_t kMostPerDirection = 400;

std::vector<Vec3> corners_of(const ArrangedPlane& p) {
  if (p.segment) return {(*p.segment)[0], (*p.segment)[1]};
  return p.polygon.empty() ? std::vector<Vec3>{} : p.polygon.front();
}

/// Length of a segment, or the longer side of the least rectangle around an outline, along one of its edges.
double length_of(const ArrangedPlane& p) {
  if (p.segment) return ((*p.segment)[1] - (*p.segment)[0]).norm();
  const Vec3 u = any_orthogonal(p.plane.normal), v = p.plane.normal.cross(u);
  std::vector<Eigen::Vector2d> corners;
  for (const Vec3& c : corners_of(p)) corners.emplace_back(u.dot(c), v.dot(c));
  corners = convex_hull(std::move(corners));
  double length = 0, least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d edge = (corners[(i + 1) % corners.size()] - corners[i]).normalized();
    Eigen::AlignedBox2d box;
    for (const Eigen::Vector2d& c : corners) box.extend(Eigen::Vector2d(edge.dot(c), edge.x() * c.y() - edge.y() * c.x()));
    if (box.volume() < least) least = box.volume(), length = box.sizes().maxCoeff();
  }
  return length;
}

/// Planes of one direction that are equally long, if so many alike may not be expected by chance.
void find_equal_lengths(const std::vector<int>& planes, double tolerance, Arrangement& result) {
  std::vector<std::pair<double, int>> lengths;
  for (const int p : planes)
    if (const double length = length_of(result.planes[p]); length > kShortest * result.scale) lengths.emplace_back(length, p);
  std::sort(lengths.begin(), lengths.end());
  // If lengths from half to twice as long are any, others are as alike as these so often.
  const auto by_chance = [&](double length, std::size_t count) {
    const auto near = static_cast<double>(std::count_if(lengths.begin(), lengths.end(), [&](const auto& l) { return l.first > 0.5 * length && l.first < 2.0 * length; }));
    const double others = (near - 1.0) * std::min(1.0, 2 * tolerance / (1.5 * length));
    double term = std::exp(-others), fewer = 0;  // Poisson
    for (std::size_t k = 0; k + 1 < count; ++k) fewer += term, term *= others / static_cast<double>(k + 1);
    return near * (1.0 - fewer) > kAlikeByChance;
  };
  for (std::size_t first = 0; first < lengths.size();) {
    std::size_t end = first + 1;
    while (end < lengths.size() && lengths[end].first - lengths[first].first < 2 * tolerance) ++end;
    if (end - first >= 3 && !by_chance(lengths[first].first, end - first)) {
      EqualLength e;
      double sum = 0, squares = 0;
      for (std::size_t i = first; i < end; ++i) {
        e.planes.push_back(lengths[i].second);
        sum += lengths[i].first;
      }
      e.length = sum / static_cast<double>(end - first);
      for (std::size_t i = first; i < end; ++i) squares += std::pow(lengths[i].first - e.length, 2);
      e.rms = std::sqrt(squares / static_cast<double>(end - first));
      std::sort(e.planes.begin(), e.planes.end());
      result.equal_lengths.push_back(std::move(e));
    }
    first = end;
  }
}

}  // namespace

void find_second_order(Arrangement& result, double rounding) {
  if (result.planes.empty()) return;
  std::vector<std::vector<int>> of_direction(result.directions.size());
  for (std::size_t p = 0; p < result.planes.size(); ++p) of_direction[result.planes[p].direction].push_back(static_cast<int>(p));
  const double tolerance = step_tolerance(result, rounding);
  const std::optional<int> flat = flat_axis(result);
  for (std::size_t d = 0; d < of_direction.size(); ++d) {
    std::vector<int> planes = of_direction[d];
    if (planes.size() < 2) continue;
    if (planes.size() > kMostPerDirection) planes.resize(kMostPerDirection);  // the largest
    std::stable_sort(planes.begin(), planes.end(), [&](int a, int b) {
      return result.planes[a].plane.offset < result.planes[b].plane.offset;
    });
    const Vec3& n = result.directions[d].normal;
    const Vec3 u = flat ? Vec3(n.cross(Vec3::Unit(*flat)).normalized()) : any_orthogonal(n);
    std::vector<int> levels;  // one plane an offset, the lowest id
    for (std::size_t i = 0; i < planes.size();) {
      std::vector<int> group = {planes[i]};
      const double offset = result.planes[planes[i]].plane.offset;
      for (++i; i < planes.size() && result.planes[planes[i]].plane.offset - offset < 1e-9; ++i) group.push_back(planes[i]);
      std::sort(group.begin(), group.end());
      levels.push_back(group.front());
      if (group.size() > 1) result.coplanar.push_back(std::move(group));
    }
    find_equal_steps(levels, tolerance, result);
    find_equal_lengths(planes, kAlikeLengths * result.scale, result);
    find_distances(planes, u, n.cross(u), result);
  }
}

}  // namespace unseen::planes
