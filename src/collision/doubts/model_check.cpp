// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/model_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "collision/solve/estimates.h"
#include "collision/solve/residuals.h"
#include "collision/solve/solve.h"
#include "collision/solve/unknowns.h"
#include "core/linear.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr double kMostChi2 = 3.0;
constexpr double kMostEnergy = 1.005;  // of that before: bounds are soft, so a little more than 1 is none
constexpr double kLeastNoise = 0.3;   // px: what regions of a compressed video are known to at best
constexpr int kFewestLeft = 3;          // sightings of a flight, where some are held out
constexpr double kMostStrain = 3.0;   // noise that contact and orientations may be off by in the mean
constexpr double kFar = 5.0, kMedianOfNorm = 1.1774;  // noise; of normal noise in two dimensions
constexpr double kMostOutliers = 0.2;  // of the sightings, or
constexpr double kMostScattered = 0.35;  // where those that follow each other are off
constexpr double kScattered = 0.3;       // this little alike: what no model explains is off alike
constexpr double kTrend = 0.7;        // neighbouring residuals that are so much alike are no noise
constexpr double kTrendSize = 2.0;    // in noise: smaller trends do no harm

std::vector<Vec2> residuals(const Problem& problem, const State& state) {
  const StateT<double> s = values_of(problem, state);
  std::vector<Vec2> all;
  for (const PointObservation& seen : problem.points)
    all.push_back(seen.pixel - problem.camera.project(position_at<double>(problem, s, seen.body, seen.after, seen.time)));
  return all;
}

/// Whether sightings that are `out` and follow each other in a flight are off in directions of their own.
bool are_scattered(const std::vector<PointObservation>& points, const std::vector<Vec2>& off, const std::vector<char>& out) {
  double alike = 0.0, pairs = 0.0;
  std::map<std::pair<int, bool>, std::size_t> last;
  for (std::size_t i = 0; i < off.size(); ++i) {
    const auto [it, first] = last.try_emplace({points[i].body, points[i].after}, i);
    if (!first && out[i] && out[it->second]) alike += off[i].normalized().dot(off[it->second].normalized()), pairs += 1.0;
    it->second = i;
  }
  return pairs > 0.0 && alike <= kScattered * pairs;
}

/// Sightings that a tracker or a person got wrong: few, and far beyond what the others are off by.
std::vector<char> outliers(const std::vector<PointObservation>& points, const std::vector<Vec2>& off, double noise) {
  std::vector<double> sizes;
  for (const Vec2& o : off) sizes.push_back(o.norm());
  const double far = kFar * std::max(noise, median(sizes) / kMedianOfNorm);
  std::vector<char> out;
  for (const Vec2& o : off) out.push_back(o.norm() > far);
  const double share = static_cast<double>(std::count(out.begin(), out.end(), 1)) / static_cast<double>(off.size());
  if (share > (are_scattered(points, off, out) ? kMostScattered : kMostOutliers)) out.assign(off.size(), 0);
  return out;
}

/// Whether the data ask for energy out of nothing. The soft bound draws an excess in by 1 + σ² over its own σ².
bool adds_energy(const Estimate& kept) {
  constexpr double kFar = 2.0;  // deviations that noise explains
  const double excess = kept.value - 1.0;
  return kept.value > kMostEnergy && excess * (1.0 + kept.sd * kept.sd / (kBound * kBound)) > kFar * kept.sd;
}

/// Root mean square over the held-out points, or over the others, without outliers.
double rms(const std::vector<Vec2>& off, const ModelCheck& check, bool held_out) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < off.size(); ++i)
    if ((check.held_out[i] != 0) == held_out && !check.outlier[i]) sum += off[i].squaredNorm(), ++count;
  return count ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

/// Flights whose residuals go on alike from frame to frame, and are larger than the noise.
std::vector<std::string> trends(const Problem& problem, const BodyNames& names, const std::vector<Vec2>& off, const std::vector<char>& outlier, double noise) {
  struct Sums {
    double square = 0, lag = 0;
    int count = 0;
    Vec2 last = Vec2::Zero();
  };
  std::map<std::pair<int, bool>, Sums> flights;
  for (std::size_t i = 0; i < off.size(); ++i) {
    if (outlier[i]) continue;
    Sums& sums = flights[{problem.points[i].body, problem.points[i].after}];
    if (sums.count > 0) sums.lag += off[i].dot(sums.last);
    sums.square += off[i].squaredNorm();
    sums.last = off[i];
    ++sums.count;
  }
  std::vector<std::string> found;
  for (const auto& [key, sums] : flights) {
    if (sums.count < 6) continue;
    const double size = std::sqrt(sums.square / (2.0 * sums.count)) / noise;
    if (sums.lag / sums.square > kTrend && size > kTrendSize)
      found.push_back(fmt::format("{}: its flight {} the impact is no free flight: residuals of {:.1f} px go on alike from frame to frame", names[static_cast<std::size_t>(key.first)],
                                  key.second ? "after" : "before", size * noise));
  }
  return found;
}

/// Every n-th sighting of each flight, of those that leave it enough.
std::vector<char> every_nth(const std::vector<PointObservation>& points, int n) {
  std::map<std::pair<int, bool>, int> all, counted;
  for (const PointObservation& p : points) ++all[{p.body, p.after}];
  std::vector<char> held_out;
  for (const PointObservation& p : points) {
    const std::pair flight(p.body, p.after);
    const bool nth = counted[flight]++ % n == n - 1;
    held_out.push_back(nth && all[flight] - all[flight] / n >= kFewestLeft);
  }
  return held_out;
}

/// Variance of each held-out sighting, in that of the noise: its own, and that of a parabola through what is left of its flight, at its time.
std::vector<double> predicted_variances(const std::vector<PointObservation>& points, const std::vector<char>& held_out) {
  std::map<std::pair<int, bool>, std::vector<double>> left;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!held_out[i]) left[{points[i].body, points[i].after}].push_back(points[i].time);
  std::vector<double> variances(points.size(), 1.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!held_out[i]) continue;
    const std::vector<double>& times = left[{points[i].body, points[i].after}];
    const auto [first, last] = std::minmax_element(times.begin(), times.end());
    const auto powers = [&, start = *first, length = std::max(*last - *first, 1e-9)](double time) {
      const double t = (time - start) / length;
      return Vec3(1.0, t, t * t);
    };
    Mat3 information = Mat3::Zero();
    for (const double time : times) information += powers(time) * powers(time).transpose();
    const Vec3 x = powers(points[i].time);
    variances[i] += x.dot(solve_symmetric(information, x));
  }
  return variances;
}

/// Reduced χ² of what was held out, without outliers.
double held_out_chi2(const Problem& problem, const std::vector<Vec2>& off, const ModelCheck& check, double noise) {
  const std::vector<double> variances = predicted_variances(problem.points, check.held_out);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < off.size(); ++i)
    if (check.held_out[i] && !check.outlier[i]) sum += off[i].squaredNorm() / (2.0 * noise * noise * variances[i]), ++count;
  return count ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace

ModelCheck check_model(const Solution& solution, int every, double noise, const BodyNames& names) {
  ModelCheck check;
  const Problem& problem = solution.problem;
  check.held_out.assign(problem.points.size(), 0);
  check.outlier.assign(problem.points.size(), 0);
  double size = 0.0;
  for (const PointObservation& p : problem.points)
    if (p.depth > 0.0) size = std::max(size, problem.camera.fx * problem.solids[p.body].mass.extent / p.depth);
  noise = std::hypot(std::max(noise, kLeastNoise), kLopsided * size);
  State state = solution.fit.state;
  if (every > 1) {
    Problem rest = problem;
    rest.points.clear();
    check.held_out = every_nth(problem.points, every);
    for (std::size_t i = 0; i < problem.points.size(); ++i)
      if (!check.held_out[i]) rest.points.push_back(problem.points[i]);
    const Fit fit = settle(rest, state);
    if (fit.usable) state = fit.state;
  }
  const std::vector<Vec2> off = residuals(problem, state);
  if (!problem.filmed && !off.empty()) check.outlier = outliers(problem.points, off, noise);
  check.used_rms = rms(residuals(problem, solution.fit.state), check, false);
  check.held_out_rms = rms(off, check, true);
  check.held_out_chi2 = held_out_chi2(problem, off, check, noise);
  if (check.held_out_chi2 > kMostChi2)
    check.reasons.push_back(fmt::format("frames that were held out are {:.1f} px off, where the tracks' own noise is {:.1f} px", check.held_out_rms, noise));
  for (std::string& trend : trends(problem, names, off, check.outlier, noise)) check.reasons.push_back(std::move(trend));
  const Estimate kept = energy_kept_of(problem, solution.fit);
  const auto strain = [&](const char* term) {
    const auto it = solution.fit.terms.find(term);
    return it == solution.fit.terms.end() ? 0.0 : it->second;
  };
  if (strain("touch") > kMostStrain) check.reasons.push_back("the bodies do not touch where their flights meet");
  if (strain("orientation") > kMostStrain) check.reasons.push_back("the orientations do not belong to one rotation before the impact and one after it");
  if (adds_energy(kept)) check.reasons.push_back(fmt::format("the impact would add energy ({:.1f} % kept)", 100.0 * kept.value));
  check.fits = check.reasons.empty();
  return check;
}

}  // namespace unseen::collision
