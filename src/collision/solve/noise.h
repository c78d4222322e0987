// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cmath>
#include <vector>

#include "collision/solve/problem.h"
#include "collision/solve/scalar.h"

namespace unseen::collision {

/// α of the density exp(−|x/α|^power) whose standard deviation is 1.
inline double width_of_power(double power) { return std::sqrt(std::tgamma(1.0 / power) / std::tgamma(3.0 / power)); }

/// A residual whose fourth power is |x/α|^power, for x over its standard deviation and powers of 4 and more. Split like this, between residual and
/// loss, Gauss-Newton's steps are nearly Newton's; as the square of a residual they would be twice as long.
template <class T>
T flat_residual(const T& x, double power) {
  using std::pow;
  const double sign = value_of(x) < 0.0 ? -1.0 : 1.0;
  return sign * pow(sign * x / width_of_power(power), 0.25 * power);
}

/// −log likelihood of a value with this noise, but for |x/α|^power, against that of a normal distribution with deviation 1.
double log_noise(double sigma, double power);

/// How far the centres that were seen are from where a solution has them: x of all of them, then y; px.
std::vector<double> pixels_off(const Problem& problem, const State& state);

/// Deviation of the normal noise that would leave as much doubt about flights as noise |x/α|^power with these residuals does (asymptotic variance of
/// an M-estimator, Huber 1981, and for what the solution follows its residuals by their leverage, HC2 of MacKinnon and White 1985); their unit. It is
/// that of the residuals themselves, not of the power that stands for their shape.
double equivalent_deviation(const std::vector<double>& off, double power);

/// The noise as the residuals of a solution have it, corrected for the unknowns that the data had to pay for. `expected` is the problem as it
/// came. Sightings that are off alike often but never by much, as by a uniform distribution or by rounding to pixels, say far more than normal
/// noise of their deviation would let them: their noise is flat, if that is clearly likelier.
void estimate_noise(const Problem& expected, Problem& problem, const State& state);

}  // namespace unseen::collision
