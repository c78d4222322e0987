// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/at_rest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr std::size_t kFewestAtRest = 6;  // sightings
constexpr double kMostAtRest = 0.8;       // share of them that are at the place, within
constexpr double kOfFall = 1.0 / 6.0;     // of the fall; of a flight this share is within 0.4 of it at least

}  // namespace

bool stands_still(const std::vector<Vec2>& places, const std::vector<double>& times, double acceleration) {
  if (places.size() < kFewestAtRest) return false;
  std::vector<double> x, y, off;
  for (const Vec2& p : places) x.push_back(p.x()), y.push_back(p.y());
  const Vec2 place(median(std::move(x)), median(std::move(y)));
  for (const Vec2& p : places) off.push_back((p - place).norm());
  const double reach = quantile(off, kMostAtRest);
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (std::size_t i = 0; i < off.size(); ++i)
    if (off[i] <= reach) first = std::min(first, times[i]), last = std::max(last, times[i]);
  return reach < kOfFall * 0.125 * acceleration * (last - first) * (last - first);  // between the ends and the middle
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
    if (places.size() < kFewestAtRest) continue;
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    const double lasts = *last - *first;
    std::vector<double> early, late;
    for (std::size_t i = 0; i < times.size(); ++i)
      if (times[i] < *first + lasts / 3) early.push_back(depths[i]);
      else if (times[i] > *last - lasts / 3) late.push_back(depths[i]);
    const double nearer = std::abs(median(std::move(early)) - median(std::move(late)));
    const Vec3 ray = problem.camera.unproject(places.front().x(), places.front().y(), 1.0).normalized();
    const double across = problem.down.cross(ray).norm();
    rests[static_cast<std::size_t>(body)] = nearer < kOfFall * problem.gravity * lasts * lasts  // half of what a fall along the view makes of it
                                            && stands_still(places, times, problem.gravity * across * problem.camera.fy / median(std::move(depths)));
  }
  if (rests[0] && rests[1]) rests = {false, false};
  return rests;
}

}  // namespace unseen::collision
