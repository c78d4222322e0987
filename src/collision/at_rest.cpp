// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/at_rest.h"

#include <algorithm>

#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr std::size_t kFewestAtRest = 6;  // sightings
constexpr double kMostAtRest = 0.8;       // share of them that are at the place, within
constexpr double kOfFall = 1.0 / 6.0;     // of the fall; of a flight this share is within 0.4 of it at least

}  // namespace

bool stands_still(const std::vector<Vec2>& places, double fall) {
  if (places.size() < kFewestAtRest) return false;
  std::vector<double> x, y, off;
  for (const Vec2& p : places) x.push_back(p.x()), y.push_back(p.y());
  const Vec2 place(median(std::move(x)), median(std::move(y)));
  for (const Vec2& p : places) off.push_back((p - place).norm());
  return quantile(std::move(off), kMostAtRest) < kOfFall * fall;
}

std::array<bool, 2> at_rest(const Problem& problem) {
  std::array<bool, 2> rests = {false, false};
  if (problem.fixed || problem.gravity == 0.0) return rests;
  for (int body = 0; body < 2; ++body) {
    std::vector<Vec2> places;
    std::vector<double> depths, times;
    for (const PointObservation& p : problem.points) {
      if (p.body != body || p.after || p.depth <= 0.0) continue;
      places.push_back(p.pixel);
      depths.push_back(p.depth);
      times.push_back(p.time);
    }
    if (places.empty()) continue;
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    const double lasts = *last - *first;
    rests[static_cast<std::size_t>(body)] = stands_still(places, 0.125 * problem.gravity * lasts * lasts * problem.camera.fy / median(std::move(depths)));
  }
  return rests;
}

}  // namespace unseen::collision
