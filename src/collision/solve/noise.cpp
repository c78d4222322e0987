// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/noise.h"

#include <algorithm>
#include <numeric>
#include <vector>

#include "collision/solve/unknowns.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr double kToSigma = 1.4826;  // from the median of a normal distribution's sizes
constexpr double kUnknownsOfFlights = 18.0, kUnknownsOfTurning = 14.0;
constexpr double kLeastOrientation = 0.002;  // rad

std::vector<double> sizes(const std::vector<double>& off) {
  std::vector<double> all;
  for (const double x : off) all.push_back(std::abs(x));
  return all;
}

double degrees_of_freedom(std::size_t count, double unknowns) { return std::max(4.0, static_cast<double>(count) - unknowns); }

double robust_deviation(const std::vector<double>& off, double unknowns) {
  return kToSigma * median(sizes(off)) * std::sqrt(static_cast<double>(off.size()) / degrees_of_freedom(off.size(), unknowns));
}

/// Of |x/α|^power with the likeliest α.
double likeliest_width(const std::vector<double>& off, double power) {
  double sum = 0.0;
  for (const double x : off) sum += std::pow(std::abs(x), power);
  return std::pow(power * sum / static_cast<double>(off.size()), 1.0 / power);
}

/// Whether neighbours are off by themselves: where they are off alike, it is the model that is off.
bool is_white(const std::vector<double>& off) {
  constexpr double kDeviations = 3.0;
  double product = 0.0, square = 0.0;
  for (std::size_t i = 1; i < off.size(); ++i) product += off[i - 1] * off[i];
  for (const double x : off) square += x * x;
  return product < kDeviations * square / std::sqrt(static_cast<double>(off.size()));
}

/// 2, unless flatter noise is clearly likelier. What few sightings leave to be off by has no shape.
double likeliest_power(const std::vector<double>& off) {
  constexpr double kClearly = 3.0;  // of log likelihood
  const double count = static_cast<double>(off.size());
  if (count < 4.0 * kUnknownsOfFlights || !is_white(off)) return 2.0;
  const auto cost = [&](double power) { return count * (log_noise(likeliest_width(off, power) / width_of_power(power), power) + 1.0 / power); };
  double best = 2.0, least = cost(best) - kClearly;
  for (const double power : {4.0, 8.0})
    if (const double other = cost(power); other < least) best = power, least = other;
  return best;
}

}  // namespace

double log_noise(double sigma, double power) {
  return std::log(sigma * width_of_power(power) * std::tgamma(1.0 + 1.0 / power) / (width_of_power(2.0) * std::tgamma(1.5)));
}

std::vector<double> pixels_off(const Problem& problem, const State& state) {
  const StateT<double> s = values_of(problem, state);
  std::vector<double> off;
  for (const int axis : {0, 1})
    for (const PointObservation& seen : problem.points)
      off.push_back((problem.camera.project(position_at<double>(problem, s, seen.body, seen.after, seen.time)) - seen.pixel)[axis]);
  return off;
}

double equivalent_deviation(const std::vector<double>& off, double power) {
  constexpr double kMostLeverage = 0.9;
  std::vector<double> weights;  // second derivatives of |x|^power, but for a factor: what is off most counts most
  for (const double x : off) weights.push_back(std::pow(std::abs(x), power - 2.0));
  const double count = static_cast<double>(off.size()), sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  double pulls = 0.0;  // squared first derivatives, but for the same factor
  for (std::size_t i = 0; i < off.size(); ++i) {
    const double leverage = std::min(kMostLeverage, kUnknownsOfFlights * weights[i] / sum);
    pulls += std::pow(weights[i] * off[i], 2) / (1.0 - leverage);
  }
  return std::sqrt(count * pulls) / ((power - 1.0) * sum);
}

void estimate_noise(const Problem& expected, Problem& problem, const State& state) {
  constexpr double kMostPixels = 3.0, kMostAngle = 8.0;  // times what was expected: more is no noise but a fit that failed
  constexpr double kLeastPixels = 0.02;
  const std::vector<double> pixels = pixels_off(problem, state);
  double sigma = robust_deviation(pixels, kUnknownsOfFlights);
  problem.noise_power = !problem.filmed && sigma > kLeastPixels ? likeliest_power(pixels) : 2.0;
  if (problem.noise_power > 2.0) sigma = likeliest_width(pixels, problem.noise_power) / width_of_power(problem.noise_power);
  problem.pixel_sigma = std::clamp(sigma, kLeastPixels, kMostPixels * expected.pixel_sigma);
  std::vector<double> angles;
  for (const OrientationObservation& seen : problem.orientations) {
    const Quat q = orientation_at(problem, state, seen.body, seen.after, seen.time);
    const Vec3 off = rotation_vector<double>(q * seen.q.conjugate());
    angles.insert(angles.end(), {off.x(), off.y(), off.z()});
  }
  if (angles.empty() || !problem.terms.orientation || !problem.scattered) return;
  // few orientations cannot tell their noise: what was expected counts as so many more
  constexpr double kExpected = 3.0;
  const double seen = std::max(kLeastOrientation, robust_deviation(angles, kUnknownsOfTurning)), count = degrees_of_freedom(angles.size(), kUnknownsOfTurning);
  problem.orientation_sigma = std::min(kMostAngle * expected.orientation_sigma,
                                       std::exp((kExpected * std::log(expected.orientation_sigma) + count * std::log(seen)) / (kExpected + count)));
}

}  // namespace unseen::collision
