// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/spans.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace unseen::collision {
namespace {

constexpr int kFewest = 4;           // points
constexpr int kLongest = 900;        // points
constexpr double kSkip = 12.0;       // σ², of a frame that belongs to no flight
constexpr double kNew = 24.0;        // σ², of another flight
constexpr double kSpread = 0.08;     // of the gravity, from flight to flight: perspective, drag
constexpr double kShows = 4.0;       // σ that a flight's sagitta must reach with a gravity,
constexpr double kShowsClearly = 8.0;  // to take a gravity from it
constexpr double kSignificant = 8.0;  // σ of the curvature
constexpr double kAgrees = 0.12;     // of the gravity
constexpr double kForeseen = 3.5;    // σ
constexpr double kWorstFit = 6.0;    // χ² a degree of freedom

double sagitta(double curvature, double duration) { return 0.125 * curvature * duration * duration; }

Curve fit_of(const std::vector<Candidate>& track, int begin, int end) {
  CurveSums sums(track[begin].u);
  for (int i = begin; i < end; ++i) sums.add(track[i].u, track[i].pixel);
  return sums.fit();
}

}  // namespace

std::vector<Stretch> split_into_flights(const std::vector<Candidate>& track, double noise, const std::optional<ImageGravity>& gravity,
                                        Context& context) {
  const int count = static_cast<int>(track.size());
  const double square = noise * noise, weight = gravity ? square / (gravity->sigma * gravity->sigma) : 0.0;
  const Vec2 expected = gravity ? gravity->curvature : Vec2::Zero();
  std::vector<double> cost(count + 1, std::numeric_limits<double>::infinity());
  std::vector<int> from(count + 1, -1);  // where the flight that ends here begins; the place before if the frame is skipped
  cost[0] = 0.0;
  for (int begin = 0; begin < count; ++begin) {  // every cost[begin] is final when its turn comes
    context.check();
    if (cost[begin] + kSkip < cost[begin + 1]) {
      cost[begin + 1] = cost[begin] + kSkip;
      from[begin + 1] = begin;
    }
    CurveSums sums(track[begin].u);
    for (int end = begin + 1; end <= std::min(count, begin + kLongest); ++end) {
      sums.add(track[end - 1].u, track[end - 1].pixel);
      if (end - begin < kFewest) continue;
      const double duration = track[end - 1].u - track[begin].u;
      if (gravity && expected.norm() > 0.0 && sagitta(expected.norm(), duration) < kShows * noise) continue;
      const double total = cost[begin] + kNew + sums.fit(expected, weight).squares / square;
      if (total - cost[begin] > kNew + kSkip * (end - begin)) {
        if (end - begin > 2 * kFewest) break;  // longer ones do not get better
        continue;
      }
      if (total < cost[end]) {
        cost[end] = total;
        from[end] = begin;
      }
    }
  }
  std::vector<Stretch> flights;
  for (int end = count; end > 0; end = from[end])
    if (end - from[end] >= kFewest) flights.push_back({from[end], end, fit_of(track, from[end], end)});
  std::reverse(flights.begin(), flights.end());
  return flights;
}

std::optional<ImageGravity> shared_gravity(const std::vector<Stretch>& flights, const std::vector<Candidate>& track, double noise) {
  std::vector<const Stretch*> clear;
  for (const Stretch& f : flights) {
    const double a = f.curve.curvature.norm(), sigma = noise * std::sqrt(f.curve.cofactor(2, 2));
    const double freedom = 2.0 * (f.end - f.begin) - 6.0;
    if (a > kSignificant * sigma && sagitta(a, track[f.end - 1].u - track[f.begin].u) > kShowsClearly * noise &&
        f.curve.squares < kWorstFit * freedom * noise * noise)
      clear.push_back(&f);
  }
  std::optional<ImageGravity> best;
  double most = 0.0;
  for (const Stretch* f : clear) {
    double support = 0.0, weights = 0.0;
    Vec2 mean = Vec2::Zero();
    for (const Stretch* g : clear) {
      const double sigma = noise * std::sqrt(g->curve.cofactor(2, 2));
      if ((g->curve.curvature - f->curve.curvature).norm() > kAgrees * f->curve.curvature.norm() + 3.0 * sigma) continue;
      support += g->end - g->begin;
      weights += 1.0 / (sigma * sigma);
      mean += g->curve.curvature / (sigma * sigma);
    }
    if (support <= most) continue;
    most = support;
    mean /= weights;
    best = ImageGravity{mean, kSpread * mean.norm()};
  }
  return best;
}

void trim(const std::vector<Candidate>& track, double noise, Stretch& flight) {
  while (flight.end - flight.begin > kFewest) {
    const Curve later = fit_of(track, flight.begin + 1, flight.end), earlier = fit_of(track, flight.begin, flight.end - 1);
    const auto surprise = [&](const Curve& rest, const Candidate& c) {
      const double freedom = std::max(1.0, 2.0 * rest.count - 6.0);
      const double sigma = std::max(noise, std::sqrt(rest.squares / freedom));
      return (c.pixel - rest.at(c.u)).norm() / (sigma * std::sqrt(2.0 * (1.0 + rest.variance_at(c.u))));
    };
    const double first = surprise(later, track[flight.begin]), last = surprise(earlier, track[flight.end - 1]);
    if (std::max(first, last) < kForeseen) break;
    if (first > last) ++flight.begin; else --flight.end;
  }
  flight.curve = fit_of(track, flight.begin, flight.end);
}

}  // namespace unseen::collision
