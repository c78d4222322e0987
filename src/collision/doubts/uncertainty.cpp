// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "collision/doubts/focal_doubt.h"
#include "collision/doubts/normal_doubts.h"
#include "collision/solve/estimates.h"
#include "collision/solve/unknowns.h"
#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

/// What each observation was off by, and where the solution has it.
struct Residuals {
  std::vector<Vec2> predicted, off;
  std::vector<Quat> q_predicted;
  std::vector<Vec3> turn;
};

Residuals residuals_of(const Problem& problem, const State& state) {
  Residuals all;
  const StateT<double> s = values_of(problem, state);
  for (const PointObservation& seen : problem.points) {
    all.predicted.push_back(problem.camera.project(position_at<double>(problem, s, seen.body, seen.after, seen.time)));
    all.off.push_back(seen.pixel - all.predicted.back());
  }
  for (const OrientationObservation& seen : problem.orientations) {
    all.q_predicted.push_back(orientation_at(problem, state, seen.body, seen.after, seen.time));
    all.turn.push_back(rotation_vector<double>(seen.q * all.q_predicted.back().conjugate()));
  }
  return all;
}

constexpr double kShown = 2.0;  // times the residuals: what is lopsided about a body that turns cannot hide in a straight flight

/// Shifts each flight's centres alike, by as much the other way at its other end, and in its middle: regions are lopsided, and turn.
void shift_flights(Problem& problem, Random& random) {
  struct Flight {
    double begin = 1e300, end = -1e300;
    Vec2 shift, drift, bend;
  };
  std::map<std::pair<int, bool>, Flight> flights;
  for (const PointObservation& p : problem.points) {
    Flight& f = flights[{p.body, p.after}];
    f.begin = std::min(f.begin, p.time);
    f.end = std::max(f.end, p.time);
  }
  for (auto& [key, f] : flights) {
    f.shift = Vec2(random.normal(), random.normal());
    f.drift = Vec2(random.normal(), random.normal());
    f.bend = Vec2(random.normal(), random.normal());
  }
  for (PointObservation& p : problem.points) {
    if (p.depth <= 0.0) continue;
    const Flight& f = flights[{p.body, p.after}];
    const double along = f.end > f.begin ? 2.0 * (p.time - f.begin) / (f.end - f.begin) - 1.0 : 0.0;
    const double off = kLopsided * problem.camera.fx * problem.solids[static_cast<std::size_t>(p.body)].mass.extent / p.depth;
    p.pixel += (problem.turns(p.body) ? std::min(off, kShown * problem.pixel_sigma) : off) * (f.shift + along * f.drift + along * along * f.bend);
  }
}

/// The prediction with residuals drawn anew: runs of them, since neighbouring frames are off alike; few orientations tell little of their
/// noise, so theirs is normal.
Problem resampled(const Problem& problem, const Residuals& residuals, double scale, Random& random) {
  constexpr std::size_t kRun = 4;
  Problem drawn = problem;
  const std::size_t count = drawn.points.size();
  for (std::size_t i = 0; i < count; i += kRun) {
    const std::size_t from = random.index(count);
    const double sign = random.uniform() < 0.5 ? -1.0 : 1.0;
    for (std::size_t j = i; j < std::min(count, i + kRun); ++j)
      drawn.points[j].pixel = residuals.predicted[j] + sign * scale * residuals.off[(from + j - i) % count];
  }
  for (std::size_t i = 0; i < drawn.orientations.size(); ++i) {
    const Vec3 turn = problem.orientation_sigma * Vec3(random.normal(), random.normal(), random.normal());
    drawn.orientations[i].q = (rotation_by<double>(turn) * residuals.q_predicted[i]).normalized();
  }
  if (problem.filmed) shift_flights(drawn, random);
  // the sizes of a flight are off together
  std::map<std::pair<int, bool>, std::pair<double, int>> flights;
  for (const PointObservation& p : problem.points) ++flights[{p.body, p.after}].second;
  for (auto& [key, flight] : flights) flight.first = random.normal();
  for (PointObservation& p : drawn.points) {
    const auto& [shift, points] = flights[{p.body, p.after}];
    p.depth *= std::exp(shift * p.depth_sigma / std::sqrt(static_cast<double>(points)));
  }
  for (SizeTrend& trend : drawn.trends) trend.change += trend.sigma * random.normal();
  return drawn;
}

double deviation(const std::vector<double>& values, double center) {
  // from quantiles: a solve that went astray does not count
  std::vector<double> off;
  for (const double v : values) off.push_back(std::abs(v - center));
  std::sort(off.begin(), off.end());
  return off.empty() ? 0.0 : off[static_cast<std::size_t>(0.6827 * static_cast<double>(off.size() - 1))];
}

void widen(Estimate& e, double sd, double low, double high) {
  e.sd = std::max(e.sd, sd);
  e.low = std::max(low, e.value - 1.96 * e.sd);
  e.high = std::min(high, e.value + 1.96 * e.sd);
}

/// Below which value that share of equally wide normal distributions lies; of their weights and centres.
double mixture_quantile(const std::vector<std::pair<double, double>>& modes, double sd, double share) {
  constexpr double kFar = 8.0;  // deviations
  constexpr int kHalvings = 60;
  double weights = 0.0, low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& [weight, center] : modes) {
    weights += weight;
    low = std::min(low, center - kFar * sd);
    high = std::max(high, center + kFar * sd);
  }
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    double below = 0.0;
    for (const auto& [weight, center] : modes) below += 0.5 * weight * std::erfc((center - middle) / (sd * std::sqrt(2.0)));
    (below < share * weights ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Widens to 95 % of what the solution and others, which are as noisy, are likely to be, each with the likelihood that its χ² has.
void widen_to_others(Estimate& e, const std::vector<Alternative>& others, double Alternative::*value, double sd, double low, double high) {
  std::vector<std::pair<double, double>> modes = {{1.0, e.value}};
  for (const Alternative& other : others) modes.emplace_back(std::exp(-0.5 * other.excess), other.*value);
  if (others.empty() || !(sd > 0.0)) return;
  e.low = std::max(low, std::min(e.low, mixture_quantile(modes, sd, 0.025)));
  e.high = std::min(high, std::max(e.high, mixture_quantile(modes, sd, 0.975)));
  e.sd = std::max(e.sd, (e.high - e.low) / (2.0 * 1.96));
}

}  // namespace

Uncertain uncertainty(Solution& solution, int resamples, int seed, Context& context) {
  const Problem& problem = solution.problem;
  add_covariance(problem, solution.fit);
  doubt_level(solution);
  doubt_normal(solution);
  doubt_lever(solution);
  Uncertain result{restitution_of(problem, solution.fit), mass_ratio_of(problem, solution.fit), error_by_vertical(problem, solution.fit), {}};
  const double by_covariance = result.restitution.sd;
  result.restitution.value = std::clamp(result.restitution.value, 0.0, 1.0);
  const Residuals residuals = residuals_of(problem, solution.fit.state);
  const double unknowns = 18.0, count = 2.0 * static_cast<double>(problem.points.size());
  const double scale = std::sqrt(count / std::max(4.0, count - unknowns));
  std::vector<Problem> drawn;
  Random random(static_cast<std::uint64_t>(seed));
  for (int i = 0; i < resamples; ++i) drawn.push_back(resampled(problem, residuals, scale, random));
  constexpr double kFailed = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> c(drawn.size(), kFailed), m(drawn.size(), kFailed);
  parallel_blocks(context, drawn.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      context.check();
      const Fit fit = settle(drawn[i], solution.fit.state);
      if (!fit.usable) continue;
      c[i] = bounded_restitution(drawn[i], fit.state);
      m[i] = fit.state.mass_ratio;
    }
  });
  for (std::vector<double>* values : {&c, &m}) std::erase_if(*values, [](double value) { return std::isnan(value); });
  double c_spread = deviation(c, result.restitution.value), m_spread = deviation(m, result.mass_ratio.value);
  const double c_noise = std::max(c_spread, by_covariance), m_noise = std::max(m_spread, result.mass_ratio.sd);
  for (const Alternative& other : solution.others) {  // half as likely as the best where χ² is as low
    const double share = std::exp(-0.5 * other.excess);
    c_spread = std::max(c_spread, share * std::abs(other.restitution - result.restitution.value) / 1.96);
    m_spread = std::max(m_spread, share * std::abs(other.mass_ratio - result.mass_ratio.value) / 1.96);
  }
  if (c_spread > c_noise) c_spread = std::hypot(c_spread, c_noise);  // another solution's value is as noisy
  const FocalError focal = error_by_focal_length(solution);
  result.scale = scale_ratios(solution);
  const ScaleError scale_off = error_by_scale(solution, result.scale);
  widen(result.restitution, std::hypot(c_spread, focal.restitution, scale_off.restitution), 0.0, 1.0);
  widen_to_others(result.restitution, solution.others, &Alternative::restitution, std::hypot(c_noise, focal.restitution, scale_off.restitution), 0.0, 1.0);
  if (by_covariance > 0.0) result.common *= result.restitution.sd / by_covariance;
  constexpr double kAny = std::numeric_limits<double>::infinity();
  widen(result.mass_ratio, std::hypot(m_spread, focal.mass_ratio, scale_off.mass_ratio), 0.0, kAny);
  if (!problem.fixed) widen_to_others(result.mass_ratio, solution.others, &Alternative::mass_ratio, std::hypot(m_noise, focal.mass_ratio, scale_off.mass_ratio), 0.0, kAny);
  return result;
}

}  // namespace unseen::collision
