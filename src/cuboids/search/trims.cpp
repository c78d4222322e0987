// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/search/trims.h"

#include <algorithm>
#include <limits>
#include <tuple>

#include "cuboids/boxes/box_overlap.h"
#include "cuboids/search/problem.h"
#include "unseen/cuboids/evaluate.h"

namespace unseen::cuboids {
namespace {

constexpr double kMostLost = 0.1, kHardlyLost = 0.02;        // of the measured points of a box
constexpr double kContained = 0.75;                         // of a box
constexpr double kLeastLeft = 1.0, kLeastShareLeft = 0.2;  // tolerances, of the size: the smaller one must be left of it

bool is_within(const OrientedBox& box, const Vec3& p, double margin) {
  return ((box.axes.transpose() * (p - box.center)).cwiseAbs() - box.half_size).maxCoeff() <= margin;
}

/// A trim and what it costs: measured points that it leaves in no box, as far as they are more than hardly any, and m³ that lie in one box only.
struct PricedTrim {
  Trim trim;
  double points = 0, volume = 0;
};

/// The trims of one of the two boxes, `corners` and `both` being those and the volume (m³) of what lies in both.
void price_trims(const DepthView& view, const std::vector<OrientedBox>& boxes, const std::vector<double>& tolerance, int k, const std::vector<Vec3>& corners,
                 double both, std::vector<PricedTrim>& priced) {
  const OrientedBox& box = boxes[k];
  std::vector<Vec3> points = view.measured_in(box, tolerance[k]);
  const double all = static_cast<double>(points.size());
  std::erase_if(points, [&](const Vec3& p) {  // what another box explains anyway
    for (std::size_t i = 0; i < boxes.size(); ++i)
      if (static_cast<int>(i) != k && is_within(boxes[i], p, tolerance[i])) return true;
    return false;
  });
  for (int face = 0; face < 6; ++face) {
    const Vec3 normal = face_normal(box, face);
    double inner = std::numeric_limits<double>::infinity();
    for (const Vec3& p : corners) inner = std::min(inner, normal.dot(p - box.center));
    const double size = 2.0 * box.half_size[face / 2], length = box.half_size[face / 2] - inner;
    if (size - length < std::min(kLeastLeft * tolerance[k], kLeastShareLeft * size)) continue;
    const OrientedBox left = extended(box, face, -length);
    const double lost = static_cast<double>(std::count_if(points.begin(), points.end(), [&](const Vec3& p) { return !is_within(left, p, tolerance[k]); }));
    if (lost <= kMostLost * all) priced.push_back({{k, face, length}, std::max(0.0, lost - kHardlyLost * all), box.volume() - left.volume() - both});
  }
}

}  // namespace

bool is_contained(const DepthView& view, const OrientedBox& inner, double tolerance, const OrientedBox& outer, double outer_tolerance) {
  if (inner.volume() > outer.volume() || intersection_volume(inner, outer) < kContained * inner.volume()) return false;
  const std::vector<Vec3> points = view.measured_in(inner, tolerance);
  const auto outside = std::count_if(points.begin(), points.end(), [&](const Vec3& p) { return !is_within(outer, p, outer_tolerance); });
  return static_cast<double>(outside) <= kMostLost * static_cast<double>(points.size());
}

std::vector<Trim> trims_of(const DepthView& view, const std::vector<OrientedBox>& boxes, const std::vector<double>& tolerance, std::array<int, 2> pair) {
  const std::vector<Vec3> corners = intersection_corners(boxes[pair[0]], boxes[pair[1]]);
  if (corners.empty()) return {};
  const double both = intersection_volume(boxes[pair[0]], boxes[pair[1]]);
  std::vector<PricedTrim> priced;
  for (const int k : pair) price_trims(view, boxes, tolerance, k, corners, both, priced);
  std::stable_sort(priced.begin(), priced.end(), [](const PricedTrim& s, const PricedTrim& t) { return std::tuple(s.points, s.volume) < std::tuple(t.points, t.volume); });
  std::vector<Trim> trims;
  for (const PricedTrim& p : priced) trims.push_back(p.trim);
  return trims;
}

}  // namespace unseen::cuboids
