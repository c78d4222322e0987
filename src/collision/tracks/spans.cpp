// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/spans.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace unseen::collision {
namespace {

constexpr int kFewestOfSpan = 4;           // points
constexpr int kLongest = 900;        // points
constexpr double kSkip = 12.0;       // σ², of a frame that belongs to no flight
constexpr double kNew = 24.0;        // σ², of another flight
constexpr double kSpread = 0.08;     // of the gravity, from flight to flight: perspective, drag
constexpr double kShows = 5.0;       // σ of its curvature that a gravity must be to be seen in a flight, and
constexpr double kShown = 0.6;       // of the gravity that must be seen
constexpr double kShowsClearly = 8.0;  // σ, sagitta of a flight to take a gravity from
constexpr double kSignificant = 8.0;  // σ of the curvature
constexpr double kAgrees = 0.12;     // of the gravity
constexpr double kForeseen = 3.5;    // σ of a point at a flight's end
constexpr double kOddSizeOfSpan = 0.15;    // off the flight's typical diameter: an impact's blur, a shadow, a part
constexpr int kForeseeing = 7;       // points next to it that foresee it
constexpr int kTrimmed = 12;         // points that may come off an end
constexpr int kRested = 5;           // points beside a flight that lie at one place, as where the body is held,
constexpr double kOnePlace = 1.5;    // noises about their mean
constexpr double kWorstFit = 6.0;    // χ² a degree of freedom
constexpr double kFlightModel = 0.003;     // of a flight's length: what a parabola leaves of drag and perspective

double sagitta(double curvature, double duration) { return 0.125 * curvature * duration * duration; }

/// Variance of a point about a flight's parabola, px².
double variance_of(const Curve& curve, double begin, double end, double noise) {
  const double length = 0.5 * (curve.velocity_at(begin).norm() + curve.velocity_at(end).norm()) * (end - begin);
  return noise * noise + kFlightModel * kFlightModel * length * length;
}

/// True if a flight under that gravity is told from a straight line, as something held, rolling or at rest moves.
bool shows(const Curve& free, const Vec2& gravity, double noise) {
  const double g = gravity.norm();
  if (g == 0.0) return true;
  return g > kShows * noise * std::sqrt(free.cofactor(2, 2)) && free.curvature.dot(gravity) > kShown * g * g;
}

Curve fit_of(const std::vector<Candidate>& track, int begin, int end) {
  CurveSums sums(track[begin].u);
  for (int i = begin; i < end; ++i) sums.add(track[i].u, track[i].pixel);
  return sums.fit();
}

/// How many of at most `most` points from `first` on, by steps of ±1, are still where the body rested before.
int still_resting(const std::vector<Candidate>& track, int first, int step, int most, double noise) {
  const int far = first - kRested * step;
  if (far < 0 || far >= static_cast<int>(track.size())) return 0;
  Vec2 place = Vec2::Zero();
  for (int i = far; i != first; i += step) place += track[i].pixel / kRested;
  const auto rests = [&](int i) { return (track[i].pixel - place).norm() < kOnePlace * noise; };
  for (int i = far; i != first; i += step)
    if (!rests(i)) return 0;
  int count = 0;
  while (count < most && rests(first + count * step)) ++count;
  return count;
}

}  // namespace

std::vector<Stretch> split_into_flights(const std::vector<Candidate>& track, double noise, const std::optional<ImageGravity>& gravity,
                                        Context& context) {
  const int count = static_cast<int>(track.size());
  const double weight = gravity ? noise * noise / (gravity->sigma * gravity->sigma) : 0.0;
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
      if (end - begin < kFewestOfSpan) continue;
      if (gravity && !shows(sums.fit(), expected, noise)) continue;
      const Curve curve = sums.fit(expected, weight);
      const double total = cost[begin] + kNew + curve.squares / variance_of(curve, track[begin].u, track[end - 1].u, noise);
      if (total - cost[begin] > kNew + kSkip * (end - begin)) {
        if (end - begin > 2 * kFewestOfSpan) break;  // longer ones do not get better
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
    if (end - from[end] >= kFewestOfSpan) flights.push_back({from[end], end, fit_of(track, from[end], end)});
  std::reverse(flights.begin(), flights.end());
  return flights;
}

std::optional<ImageGravity> shared_gravity(const std::vector<Stretch>& flights, const std::vector<Candidate>& track, double noise) {
  std::vector<const Stretch*> clear;
  for (const Stretch& f : flights) {
    const double a = f.curve.curvature.norm(), sigma = noise * std::sqrt(f.curve.cofactor(2, 2));
    const double freedom = 2.0 * (f.end - f.begin) - 6.0, variance = variance_of(f.curve, track[f.begin].u, track[f.end - 1].u, noise);
    if (a > kSignificant * sigma && sagitta(a, track[f.end - 1].u - track[f.begin].u) > kShowsClearly * noise &&
        f.curve.squares < kWorstFit * freedom * variance)
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
  const int count = flight.end - flight.begin, reach = std::min(kTrimmed, count - kFewestOfSpan - 1);
  const auto surprise = [&](int begin, int end, const Candidate& c) {
    const Curve rest = fit_of(track, begin, end);
    const double sigma = std::max(noise, std::sqrt(rest.squares / std::max(1.0, 2.0 * rest.count - 6.0)));
    return (c.pixel - rest.at(c.u)).norm() / (sigma * std::sqrt(2.0 * (1.0 + rest.variance_at(c.u))));
  };
  int begin = flight.begin, end = flight.end;
  const double typical = typical_diameter({track.begin() + begin, track.begin() + end});
  const auto odd = [&](const Candidate& c) { return c.diameter > 0.0 && std::abs(c.diameter - typical) > kOddSizeOfSpan * typical; };
  while (end - begin > kFewestOfSpan && odd(track[begin]) && !odd(track[begin + 1])) ++begin;
  while (end - begin > kFewestOfSpan && odd(track[end - 1]) && !odd(track[end - 2])) --end;
  begin += still_resting(track, begin, 1, end - begin - kFewestOfSpan, noise);
  end -= still_resting(track, end - 1, -1, end - begin - kFewestOfSpan, noise);
  for (int i = begin; i < flight.begin + reach; ++i)  // the innermost one that surprises counts
    if (surprise(i + 1, std::min(end, i + 1 + kForeseeing), track[i]) > kForeseen) begin = i + 1;
  const int last = end;
  for (int i = last - 1; i >= last - reach; --i)
    if (surprise(std::max(begin, i - kForeseeing), i, track[i]) > kForeseen && i - begin >= kFewestOfSpan) end = i;
  if (end - begin >= kFewestOfSpan) {
    flight.begin = begin;
    flight.end = end;
  }
  flight.curve = fit_of(track, flight.begin, flight.end);
}

}  // namespace unseen::collision
