// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/meetings.h"

#include <algorithm>
#include <cmath>

#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr double kReach = 4.0;       // σ
constexpr double kOfBody = 0.25;     // diameters: deformation, blur, shadow
constexpr double kSudden = 6.0;      // σ of the velocities
constexpr double kLeastChange = 0.12;  // of the faster velocity
constexpr double kOddSize = 0.25;    // off the flight's typical diameter: merged or covered

constexpr std::size_t kFewestNear = 6;  // points of a curve near an end
constexpr double kExplained = 1.5;   // χ² a degree of freedom
constexpr double kShorter = 0.8;     // of the points, from one try to the next

/// Fit to the first points that `points` gives by index.
template <class At>
Curve near_curve(std::size_t count, At at, double noise) {
  for (std::size_t n = count;; n = std::max(kFewestNear, static_cast<std::size_t>(kShorter * static_cast<double>(n)))) {
    CurveSums sums(at(0).u);
    for (std::size_t i = 0; i < n; ++i) sums.add(at(i).u, at(i).pixel);
    const Curve curve = sums.fit();
    if (n <= kFewestNear || curve.squares < kExplained * noise * noise * (2.0 * static_cast<double>(n) - 6.0)) return curve;
  }
}

}  // namespace

Curve curve_near_end(const std::vector<Candidate>& points, double noise) {
  return near_curve(points.size(), [&](std::size_t i) -> const Candidate& { return points[points.size() - 1 - i]; }, noise);
}

Curve curve_near_begin(const std::vector<Candidate>& points, double noise) {
  return near_curve(points.size(), [&](std::size_t i) -> const Candidate& { return points[i]; }, noise);
}

Joint joint_at(double u, const Curve& before, const Curve& after, double noise, double diameter) {
  Joint joint;
  joint.u = u;
  joint.apart = (before.at(u) - after.at(u)).norm();
  joint.spread = noise * std::sqrt(1.0 + before.variance_at(u) + after.variance_at(u));
  joint.tolerance = std::min(kReach * joint.spread + kOfBody * diameter, std::max(diameter, 10.0 * noise));
  joint.change = after.velocity_at(u) - before.velocity_at(u);
  const double faster = std::max(after.velocity_at(u).norm(), before.velocity_at(u).norm());
  const double sigma = noise * std::sqrt(before.velocity_variance_at(u) + after.velocity_variance_at(u));
  joint.sudden = joint.change.norm() > std::max(kSudden * sigma, kLeastChange * faster);
  return joint;
}

Joint join(const Curve& before, double end, const Curve& after, double begin, double noise, double diameter) {
  const double low = std::min(end, begin) - kBeyond, high = std::max(end, begin) + kBeyond;
  const double u = least_between(low, high, [&](double at) { return (before.at(at) - after.at(at)).norm(); });
  return joint_at(u, before, after, noise, diameter);
}

bool rebounds(const Curve& before, const Curve& after, const Joint& joint) {
  const Vec2 n = joint.change.normalized();
  return before.velocity_at(joint.u).dot(n) < 0.0 && after.velocity_at(joint.u).dot(n) > -0.05 * joint.change.norm();
}

void add_span(Tracks& tracks, int body, const std::vector<Candidate>& points, double fps) {
  const double typical = typical_diameter(points);
  FlightSpan span{body, tracks.points.size(), tracks.points.size() + points.size()};
  for (const Candidate& c : points) {
    const bool sized = c.whole && c.diameter > 0.0 && std::abs(c.diameter - typical) < kOddSize * typical;
    tracks.points.push_back({body, c.file_frame(), c.u / fps, c.pixel, sized ? c.diameter : 0.0, c.region});
  }
  tracks.spans.push_back(span);
}

double noise_about(const std::vector<std::vector<Candidate>>& flights, const std::vector<Curve>& curves) {
  std::vector<double> off;
  for (std::size_t i = 0; i < flights.size(); ++i)
    for (const Candidate& c : flights[i]) {
      const Vec2 r = c.pixel - curves[i].at(c.u);
      off.push_back(std::abs(r.x()));
      off.push_back(std::abs(r.y()));
    }
  if (off.empty()) return 1.0;
  const double n = static_cast<double>(off.size()), freedom = std::max(0.25 * n, n - 6.0 * static_cast<double>(flights.size()));
  return std::max(0.05, 1.4826 * median(std::move(off)) * std::sqrt(n / freedom));
}

}  // namespace unseen::collision
