// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/spin_starts.h"

#include <Eigen/LU>

#include <algorithm>

#include "collision/rotation.h"
#include "core/linear.h"

namespace unseen::collision {
namespace {

constexpr double kFastest = 60.0;  // rad/s
constexpr int kMostTurns = 3;      // between two orientations

/// Gauss–Newton over orientation and momentum at the first observation's time.
SpinGuess refined(const std::vector<const OrientationObservation*>& seen, const Vec3& inertia, double sigma, SpinGuess guess) {
  constexpr int kRounds = 12;
  std::vector<double> times;
  for (const OrientationObservation* o : seen) times.push_back(o->time - seen[0]->time);
  const auto residuals = [&](const SpinGuess& g) {
    Eigen::VectorXd r(3 * seen.size());
    const std::vector<TurnedEnd> ends = turned_through(g.q, g.h, inertia, times, false);
    for (std::size_t i = 0; i < seen.size(); ++i) r.segment<3>(3 * i) = rotation_vector<double>(ends[i].q * seen[i]->q.conjugate()) / sigma;
    return r;
  };
  const auto jacobian = [&](const SpinGuess& g) {
    Eigen::MatrixXd j(3 * seen.size(), 6);
    const std::vector<TurnedEnd> ends = turned_through(g.q, g.h, inertia, times, true);
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const Mat3& along = ends[i].along_h;
      Mat3 cross;
      cross << 0, -g.h.z(), g.h.y(), g.h.z(), 0, -g.h.x(), -g.h.y(), g.h.x(), 0;
      j.block<3, 3>(3 * i, 0) = (Mat3::Identity() + along * cross) / sigma;  // turning the start alone
      j.block<3, 3>(3 * i, 3) = along / sigma;
    }
    return j;
  };
  double damping = 1e-6;
  Eigen::VectorXd r = residuals(guess);
  Eigen::MatrixXd j = jacobian(guess);
  for (int round = 0; round < kRounds; ++round) {
    Eigen::MatrixXd normal = j.transpose() * j;
    normal.diagonal() *= 1.0 + damping;
    normal.diagonal().array() += 1e-12;
    const Eigen::VectorXd step = solve_symmetric(normal, -j.transpose() * r);
    if (!step.allFinite()) break;
    SpinGuess next = guess;
    next.q = (rotation_by<double>(Vec3(step.head<3>())) * guess.q).normalized();
    next.h += step.tail<3>();
    const Eigen::VectorXd r_next = residuals(next);
    const bool better = r_next.squaredNorm() < r.squaredNorm();
    damping = better ? std::max(1e-9, damping * 0.1) : std::min(1e6, std::max(1e-3, damping * 10.0));
    if (!better) continue;
    guess = next;
    r = r_next;
    j = jacobian(guess);
  }
  guess.cost = 0.5 * r.squaredNorm();
  Eigen::MatrixXd normal = j.transpose() * j;
  normal.bottomRightCorner<3, 3>() += Mat3((kFastest * inertia).cwiseAbs2().cwiseInverse().asDiagonal());
  guess.spread = normal.inverse().bottomRightCorner<3, 3>();
  return guess;
}

}  // namespace

std::vector<SpinGuess> spin_guesses(const Problem& problem, int body, bool after, double time) {
  std::vector<const OrientationObservation*> seen;
  for (const OrientationObservation& o : problem.orientations)
    if (o.body == body && o.after == after) seen.push_back(&o);
  if (seen.empty() || !problem.terms.orientation) return {};
  const Vec3& inertia = problem.solids[body].mass.inertia;
  if (seen.size() == 1) return {{seen[0]->q, Vec3::Zero(), Mat3((kFastest * inertia).cwiseAbs2().asDiagonal()), 0.0}};
  std::sort(seen.begin(), seen.end(), [](const auto* a, const auto* b) { return a->time < b->time; });
  // the two that are nearest in time leave the fewest turns open
  std::size_t near = 0;
  for (std::size_t i = 0; i + 1 < seen.size(); ++i)
    if (seen[i + 1]->time - seen[i]->time < seen[near + 1]->time - seen[near]->time) near = i;
  const double dt = std::max(1e-6, seen[near + 1]->time - seen[near]->time);
  const Vec3 turn = rotation_vector<double>(seen[near + 1]->q * seen[near]->q.conjugate());
  const Vec3 axis = turn.norm() > 1e-9 ? turn.normalized() : Vec3::UnitX();
  std::vector<SpinGuess> guesses;
  for (int turns = -kMostTurns; turns <= kMostTurns; ++turns) {
    const Vec3 omega = (turn + 2.0 * kPi * turns * axis) / dt;
    if (omega.norm() > kFastest && turns != 0) continue;
    const Quat& q = seen[near]->q;
    SpinGuess guess{q, q * inertia.cwiseProduct(q.conjugate() * omega), Mat3::Zero(), 0.0};
    guess.q = turned<double>(guess.q, guess.h, inertia, seen[0]->time - seen[near]->time);
    guess = refined(seen, inertia, problem.orientation_sigma, guess);
    guess.q = turned<double>(guess.q, guess.h, inertia, time - seen[0]->time);
    if (angular_velocity<double>(guess.q, guess.h, inertia).norm() < kFastest) guesses.push_back(guess);
  }
  std::stable_sort(guesses.begin(), guesses.end(), [](const SpinGuess& a, const SpinGuess& b) { return a.cost < b.cost; });
  return guesses;
}

}  // namespace unseen::collision
