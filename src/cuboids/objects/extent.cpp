// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/extent.h"

#include <algorithm>

#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr double kEnd = 0.02;        // quantile of the points, that counts as the end
constexpr double kRoomSigmas = 3.0;  // about an extent

}  // namespace

DirectedExtent extent_of(const Observation& seen, const Directions& directions, std::span<const int> points) {
  DirectedExtent extent;
  std::vector<Vec3> places;
  for (const int i : points) places.push_back(directions(seen.points[i]));
  for (int k = 0; k < 3; ++k) {
    std::vector<double> place;
    for (const Vec3& p : places) place.push_back(p[k]);
    extent.low[k] = quantile(place, kEnd);
    extent.high[k] = quantile(std::move(place), 1.0 - kEnd);
  }
  extent.room = kRoomSigmas * seen.graph.sigma[points.front()];
  return extent;
}

double share_within(const Observation& seen, const Directions& directions, const DirectedExtent& extent, std::span<const int> points) {
  const auto within = std::count_if(points.begin(), points.end(), [&](int i) { return extent.holds(directions(seen.points[i])); });
  return static_cast<double>(within) / static_cast<double>(points.size());
}

}  // namespace unseen::cuboids
