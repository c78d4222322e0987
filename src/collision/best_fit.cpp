// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/best_fit.h"

#include <fmt/format.h>

#include <algorithm>

#include "collision/starts.h"
#include "collision/unknowns.h"

namespace unseen::collision {
namespace {

constexpr double kAlike = 3.0;           // ½ χ² by which another solution may be worse and still explains the data alike
constexpr double kOtherValue = 0.05;     // of restitution, or as a share of the mass ratio: less is no other solution
constexpr double kLeastOrientation = 0.01;  // rad

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The noise as the residuals have it: medians, corrected for the unknowns that the data had to pay for.
void estimate_noise(Problem& problem, const State& state) {
  const StateT<double> s = values_of(problem, state);
  std::vector<double> pixels, angles;
  for (const PointObservation& seen : problem.points) {
    const Vec2 off = problem.camera.project(position_at<double>(problem, s, seen.body, seen.after, seen.time)) - seen.pixel;
    pixels.insert(pixels.end(), {std::abs(off.x()), std::abs(off.y())});
  }
  for (const OrientationObservation& seen : problem.orientations) {
    const Quat q = orientation_at(problem, state, seen.body, seen.after, seen.time);
    const Vec3 off = rotation_vector<double>(q * seen.q.conjugate());
    for (int i = 0; i < 3; ++i) angles.push_back(std::abs(off[i]));
  }
  constexpr double kToSigma = 1.4826, kUnknownsOfFlights = 18.0, kUnknownsOfTurning = 14.0;
  const auto paid = [](std::size_t count, double unknowns) { return std::sqrt(static_cast<double>(count) / std::max(4.0, static_cast<double>(count) - unknowns)); };
  constexpr double kMost = 3.0;  // times what was expected: more is no noise but a fit that failed
  problem.pixel_sigma = std::clamp(kToSigma * median(pixels) * paid(pixels.size(), kUnknownsOfFlights), 0.02, kMost * problem.pixel_sigma);
  // few orientations cannot tell their noise: what was expected counts as so many more
  constexpr double kExpected = 24.0;
  if (angles.empty() || !problem.terms.orientation) return;
  const double expected = problem.orientation_sigma, seen = kToSigma * median(angles) * paid(angles.size(), kUnknownsOfTurning), count = static_cast<double>(angles.size());
  problem.orientation_sigma = std::clamp(std::sqrt((kExpected * expected * expected + count * seen * seen) / (kExpected + count)), kLeastOrientation, kMost * expected);
}

std::vector<Alternative> alternatives(const Problem& problem, const std::vector<Fit>& fits, const Fit& best) {
  std::vector<Alternative> others;
  const auto values = [&](const Fit& fit) {
    const StateT<double> s = values_of(problem, fit.state);
    return std::pair{restitution<double>(problem, fit.state, s), fit.state.mass_ratio};
  };
  std::vector<std::pair<double, double>> known = {values(best)};
  for (const Fit& fit : fits) {
    if (!fit.usable || fit.cost > best.cost + kAlike) continue;
    const auto [c, m] = values(fit);
    if (std::any_of(known.begin(), known.end(), [&, c = c, m = m](const auto& k) {
          return std::abs(k.first - c) < kOtherValue && std::abs(k.second / m - 1.0) < kOtherValue;
        }))
      continue;
    known.push_back({c, m});
    others.push_back({fmt::format("other turning explains the data alike: c = {:.2f}, mass ratio {:.2f}", c, m), c, m, 2.0 * (fit.cost - best.cost)});
  }
  return others;
}

/// Each state's fit; those that end far above the best are left out.
std::vector<Fit> fits_from(const Problem& problem, const std::vector<State>& from, Fit (*step)(const Problem&, const State&), double worse, Context& context) {
  std::vector<Fit> fits(from.size());
  parallel_blocks(context, from.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) fits[i] = step(problem, from[i]);
  });
  context.check();
  std::erase_if(fits, [](const Fit& fit) { return !fit.usable; });
  std::stable_sort(fits.begin(), fits.end(), [](const Fit& a, const Fit& b) { return a.cost < b.cost; });
  if (!fits.empty()) std::erase_if(fits, [limit = fits.front().cost + worse](const Fit& fit) { return fit.cost > limit; });
  return fits;
}

std::vector<State> states_of(const std::vector<Fit>& fits) {
  std::vector<State> states;
  for (const Fit& fit : fits) states.push_back(fit.state);
  return states;
}

}  // namespace

Solution best_fit(Problem problem, double time, int starts, Context& context) {
  constexpr double kHopeless = 40.0, kPoor = 15.0;  // ½ χ² above the best, before and after the shapes were made to touch
  Solution solution;
  std::vector<Fit> fits = fits_from(problem, start_states(problem, time, starts), approach, kHopeless, context);
  fits = fits_from(problem, states_of(fits), settle, kPoor, context);
  if (!fits.empty()) {
    estimate_noise(problem, fits.front().state);
    const std::vector<Fit> again = fits_from(problem, states_of(fits), settle, kPoor, context);
    if (!again.empty()) fits = again;
    solution.fit = fits.front();
    solution.others = alternatives(problem, fits, fits.front());
  }
  solution.problem = std::move(problem);
  return solution;
}

}  // namespace unseen::collision
