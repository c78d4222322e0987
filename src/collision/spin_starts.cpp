// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/spin_starts.h"

#include <Eigen/Dense>

#include <algorithm>

#include "collision/rotation.h"

namespace unseen::collision {
namespace {

constexpr double kFastest = 60.0;  // rad/s
constexpr int kMostTurns = 3;      // between two orientations

/// Gauss–Newton over orientation and momentum at the first observation's time.
SpinGuess refined(const std::vector<const OrientationObservation*>& seen, const Vec3& inertia, double sigma, SpinGuess guess) {
  using Jet6 = ceres::Jet<double, 6>;
  constexpr int kRounds = 12;
  double damping = 1e-6;
  const auto residuals = [&](const SpinGuess& g, Eigen::MatrixXd* jacobian) {
    Eigen::VectorXd r(3 * seen.size());
    QuatT<Jet6> q = rotation_by<Jet6>(Vec3T<Jet6>(Jet6(0.0, 0), Jet6(0.0, 1), Jet6(0.0, 2))) * g.q.cast<Jet6>();
    const Vec3T<Jet6> h(Jet6(g.h.x(), 3), Jet6(g.h.y(), 4), Jet6(g.h.z(), 5));
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const QuatT<Jet6> there = turned<Jet6>(q, h, inertia, Jet6(seen[i]->time - seen[0]->time));
      const Vec3T<Jet6> off = rotation_vector<Jet6>(there * seen[i]->q.conjugate().cast<Jet6>());
      for (int k = 0; k < 3; ++k) {
        r[3 * i + k] = off[k].a / sigma;
        if (jacobian) jacobian->row(3 * i + k) = off[k].v.transpose() / sigma;
      }
    }
    return r;
  };
  Eigen::MatrixXd jacobian(3 * seen.size(), 6);
  Eigen::VectorXd r = residuals(guess, &jacobian);
  for (int round = 0; round < kRounds; ++round) {
    Eigen::MatrixXd normal = jacobian.transpose() * jacobian;
    normal.diagonal() *= 1.0 + damping;
    normal.diagonal().array() += 1e-12;
    const Eigen::VectorXd step = normal.ldlt().solve(-jacobian.transpose() * r);
    if (!step.allFinite()) break;
    SpinGuess next = guess;
    next.q = (rotation_by<double>(Vec3(step.head<3>())) * guess.q).normalized();
    next.h += step.tail<3>();
    const Eigen::VectorXd r_next = residuals(next, nullptr);
    if (r_next.squaredNorm() < r.squaredNorm()) {
      guess = next;
      r = residuals(guess, &jacobian);
      damping = std::max(1e-9, damping * 0.1);
    } else {
      damping = std::min(1e6, std::max(1e-3, damping * 10.0));
    }
  }
  guess.cost = 0.5 * r.squaredNorm();
  return guess;
}

}  // namespace

std::vector<SpinGuess> spin_guesses(const Problem& problem, int body, bool after, double time) {
  std::vector<const OrientationObservation*> seen;
  for (const OrientationObservation& o : problem.orientations)
    if (o.body == body && o.after == after) seen.push_back(&o);
  if (seen.empty() || !problem.terms.orientation) return {};
  const Vec3& inertia = problem.solids[body].mass.inertia;
  if (seen.size() == 1) return {{seen[0]->q, Vec3::Zero(), 0.0}};
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
    SpinGuess guess{q, q * inertia.cwiseProduct(q.conjugate() * omega), 0.0};
    guess.q = turned<double>(guess.q, guess.h, inertia, seen[0]->time - seen[near]->time);
    guess = refined(seen, inertia, problem.orientation_sigma, guess);
    guess.q = turned<double>(guess.q, guess.h, inertia, time - seen[0]->time);
    guesses.push_back(guess);
  }
  std::stable_sort(guesses.begin(), guesses.end(), [](const SpinGuess& a, const SpinGuess& b) { return a.cost < b.cost; });
  return guesses;
}

}  // namespace unseen::collision
