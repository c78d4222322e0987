// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/common_bend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <span>

#include "core/linear.h"
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

double squared(double x) { return x * x; }

/// `noise`: px; `systematic`: how far the middle of the flight may be off its ends, px.
std::optional<Bend> bend_of(std::span<const TrackPoint> points, double noise, double systematic) {
  if (points.size() < kFewest) return std::nullopt;
  const double start = points.front().time, length = points.back().time - start;
  if (length <= 0.0) return std::nullopt;
  Mat3 normal = Mat3::Zero();
  std::array<Vec3, 2> right{Vec3::Zero(), Vec3::Zero()};
  for (const TrackPoint& p : points) {
    const double t = (p.time - start) / length - 0.5;
    const Vec3 powers(1.0, t, t * t);
    normal += powers * powers.transpose();
    for (int k = 0; k < 2; ++k) right[k] += powers * p.pixel[k];
  }
  const Vec3 x = solve_symmetric(normal, right[0]), y = solve_symmetric(normal, right[1]), unit = solve_symmetric(normal, Vec3(0, 0, 1));
  const double per_second = 2.0 / (length * length);
  Bend bend;
  bend.acceleration = per_second * Vec2(x[2], y[2]);
  bend.direction = Vec2(x[1], y[1]).normalized();
  bend.weight = 1.0 / (squared(per_second * noise) * unit[2] + squared(8.0 * systematic / (length * length)));
  return bend;
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
