// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/common_bend.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

#include "collision/tracks/curve.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr std::size_t kFewest = 5;      // sightings of a flight
constexpr double kLeastNoise = 0.3;     // px
constexpr double kSignificant = 25.0;   // χ²

/// How a flight bends in the picture.
struct Bend {
  Vec2 acceleration = Vec2::Zero(), direction = Vec2::Zero();  ///< px/s²; of its way, unit
  double weight = 0;  ///< 1 / variance of either coordinate
};

/// `noise`: px; `systematic`: how far the middle of the flight may be off its ends, px.
std::optional<Bend> bend_of(std::span<const TrackPoint> points, double noise, double systematic) {
  if (points.size() < kFewest) return std::nullopt;
  const double start = points.front().time, end = points.back().time, length = end - start;
  if (length <= 0.0) return std::nullopt;
  CurveSums sums(0.5 * (start + end) / length);
  for (const TrackPoint& p : points) sums.add(p.time / length, p.pixel);
  const Curve curve = sums.fit();
  const double per_second = 1.0 / (length * length), variance = noise * noise * curve.cofactor(2, 2) + 64.0 * systematic * systematic;
  return Bend{per_second * curve.curvature, curve.velocity.normalized(), 1.0 / (per_second * per_second * variance)};
}

}  // namespace

std::optional<double> common_bend(const Tracks& tracks, const std::vector<SolvedImpact>& impacts) {
  if (impacts.empty() || impacts.front().solution.problem.gravity != 0.0) return std::nullopt;
  const Problem& problem = impacts.front().solution.problem;
  std::vector<double> scales;  // m a pixel
  for (const TrackPoint& p : tracks.points)
    if (p.diameter > 0.0) scales.push_back(problem.solids[static_cast<std::size_t>(p.body)].mass.extent / p.diameter);
  if (scales.empty()) return std::nullopt;
  const double scale = median(std::move(scales));
  std::set<int> flights;
  for (const SolvedImpact& impact : impacts)
    for (const auto* spans : {&impact.meeting.before, &impact.meeting.after}) flights.insert(spans->begin(), spans->end());
  std::vector<Bend> bends;
  for (const int flight : flights) {
    const FlightSpan& span = tracks.spans[static_cast<std::size_t>(flight)];
    const double lopsided = problem.filmed ? 0.5 * kLopsided * problem.solids[static_cast<std::size_t>(span.body)].mass.extent / scale : 0.0;
    if (const auto bend = bend_of(std::span(tracks.points).subspan(span.begin, span.end - span.begin), std::max(tracks.noise, kLeastNoise), lopsided)) bends.push_back(*bend);
  }
  double weights = 0.0, slowing = 0.0, by_slowing = 0.0, by_common = 0.0;
  Vec2 common = Vec2::Zero();
  for (const Bend& b : bends) weights += b.weight, common += b.weight * b.acceleration, slowing -= b.weight * b.acceleration.dot(b.direction);
  if (bends.size() < 2) return std::nullopt;
  common /= weights, slowing = std::max(slowing / weights, 0.0);
  for (const Bend& b : bends) {
    by_common += b.weight * (b.acceleration - common).squaredNorm();
    by_slowing += b.weight * (b.acceleration + slowing * b.direction).squaredNorm();
  }
  return by_slowing - by_common > kSignificant ? std::optional(scale * common.norm()) : std::nullopt;
}

}  // namespace unseen::collision
