// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/ground/standing_floor.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/linear.h"

namespace unseen::interactions {
namespace {

constexpr double kMostTilt = 1.5;  // rad, beyond which no fit goes
constexpr double kSteep = 0.45;    // rad, from which on who sits and who stands look much alike
constexpr double kPoseSd = 0.035;  // of a body's length in the picture: who leans, or takes a step
constexpr double kLegSd = 0.04;    // of the leg's length in a stature, as a logarithm
constexpr double kStarts[] = {0, 0.2, 0.35, 0.6, 0.9, 1.15};  // rad, from which pitches the fit sets out

/// What is sought: the camera's three numbers, then two of each person: logarithms of the stature over the
/// usual one, and of the leg's length over that of such a stature.
using Unknowns = Eigen::VectorXd;
constexpr Eigen::Index kShared = 3, kOwn = 2;
using Five = Eigen::Vector<double, 5>;  // the camera and one person

/// Where an upright body's hip and shoulder are seen beside where they should be, in standard deviations.
Eigen::Vector4d residuals(const Upright& body, const Five& x) {
  const double sine = std::sin(x[1]);
  const Vec2 down =
      std::cos(x[1]) * Vec2(std::sin(x[2]), std::cos(x[2]));  // in the picture; `sine` is along the view
  const double depth = std::exp(x[0]) / std::max(down.dot(body.ankle) + sine, 1e-3);
  const double leg = kLeg * std::exp(x[3] + x[4]),
               torso =
                   kTorso * std::exp(x[3] - kLeg / kTorso * x[4]);  // to first order the sum is the stature's
  const auto above = [&](double up) -> Vec2 {
    return (depth * body.ankle - up * down) / std::max(depth - up * sine, 0.1 * depth);
  };
  Eigen::Vector4d r;
  r << above(leg) - body.hip, above(leg + torso) - body.shoulder;
  return r / (kPoseSd * body.length());
}

struct Fit {
  Unknowns x;
  Eigen::MatrixXd normal;
  double cost = INFINITY;
};

/// Adds a body's part to the normal equations, by differences; `weight` is what it counts.
void add(const Upright& body, const Five& x, const std::array<Eigen::Index, 5>& at, const Eigen::Vector4d& r,
         double weight, Eigen::MatrixXd& normal, Unknowns& gradient) {
  constexpr double kStep = 1e-5;
  Eigen::Matrix<double, 4, 5> j;
  for (int k = 0; k < 5; ++k) j.col(k) = (residuals(body, x + kStep * Five::Unit(k)) - r) / kStep;
  const Eigen::Matrix<double, 5, 5> jj = weight * j.transpose() * j;
  const Five jr = weight * j.transpose() * r;
  for (int a = 0; a < 5; ++a) {
    gradient[at[a]] += jr[a];
    for (int b = 0; b < 5; ++b) normal(at[a], at[b]) += jj(a, b);
  }
}

/// Levenberg–Marquardt with Cauchy weights.
Fit fit(const std::vector<Upright>& bodies, const Unknowns& start, const Unknowns& usual, const Unknowns& sd,
        const Context& context) {
  const auto evaluate = [&](const Unknowns& x, Eigen::MatrixXd* normal, Unknowns* gradient) {
    const Unknowns off = (x - usual).cwiseQuotient(sd);
    double cost = off.squaredNorm();
    if (normal) {
      *normal = sd.cwiseAbs2().cwiseInverse().asDiagonal();
      *gradient = off.cwiseQuotient(sd);
    }
    for (const Upright& body : bodies) {
      const Eigen::Index own = kShared + kOwn * body.person;
      const std::array<Eigen::Index, 5> at = {0, 1, 2, own, own + 1};
      const Five of_body(x[0], x[1], x[2], x[own], x[own + 1]);
      const Eigen::Vector4d r = residuals(body, of_body);
      const double rough = r.squaredNorm() / (kRough * kRough);
      cost += body.weight * kRough * kRough * std::log1p(rough);
      if (normal) add(body, of_body, at, r, body.weight / (1 + rough), *normal, *gradient);
    }
    return cost;
  };
  Fit best{start, {}, evaluate(start, nullptr, nullptr)};
  Unknowns gradient;
  double damping = 1e-3;
  for (int round = 0; round < 50 && damping < 1e6; ++round) {
    context.check();
    evaluate(best.x, &best.normal, &gradient);
    Eigen::MatrixXd damped = best.normal;
    damped.diagonal() *= 1 + damping;
    const Unknowns next = best.x - solve_symmetric(damped, gradient);
    const double cost = std::abs(next[1]) < kMostTilt ? evaluate(next, nullptr, nullptr) : INFINITY;
    if (!(cost < best.cost)) {
      damping *= 10;
      continue;
    }
    const bool done = best.cost - cost < 1e-9 * cost;
    best.x = next;
    best.cost = cost;
    damping *= 0.1;
    if (done) break;
  }
  evaluate(best.x, &best.normal, &gradient);
  return best;
}

/// The best fit from several pitches.
FloorBelief fit_all(const std::vector<Upright>& bodies, int people, const FloorBelief& usual,
                    const Context& context) {
  const Eigen::Index size = kShared + kOwn * people;
  Unknowns mean = Unknowns::Zero(size), sd(size);
  mean.head<3>() = usual.mean;
  sd.head<3>() = usual.covariance.diagonal().cwiseSqrt();
  for (int person = 0; person < people; ++person)
    sd.segment<2>(kShared + kOwn * person) = Vec2(kStatureSd, kLegSd);
  Fit best = fit(bodies, mean, mean, sd, context);
  for (const double tilt : kStarts) {
    Unknowns from = mean;
    from[1] = tilt;
    if (Fit tried = fit(bodies, from, mean, sd, context); tried.cost < best.cost) best = std::move(tried);
  }
  return {best.x.head<3>(), best.normal.inverse().topLeftCorner<3, 3>()};
}

}  // namespace

FloorBelief standing_floor(const Take& take, const FloorBelief& usual, const Context& context) {
  FloorBelief level = usual, found = fit_all(upright_bodies(take, nullptr), take.people, usual, context);
  level.mean[1] = 0;
  if (found.mean[1] < kSteep)  // the seated may hide a tilt, but not a steep one
    found = fit_all(upright_bodies(take, &level), take.people, usual, context);
  return fit_all(upright_bodies(take, &found), take.people, usual, context);
}

}  // namespace unseen::interactions
