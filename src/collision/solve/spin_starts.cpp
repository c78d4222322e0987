// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/spin_starts.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <optional>

#include "collision/orientations/views.h"
#include "collision/solve/rotation.h"
#include "core/linear.h"

namespace unseen::collision {
namespace {

constexpr double kFastest = 60.0;  // rad/s
constexpr int kMostTurns = 3;      // between two orientations
constexpr int kAxes = 32;          // about which a body may have turned once between them; about more of them, more often
constexpr double kSameMomentum = 0.01;   // of both
constexpr double kHopeless = 60.0;       // ½ χ² above the best
constexpr double kSettledSpin = 1e-9;    // of χ², that the last round gained

/// Matrix of the cross product with v.
Mat3 crossing(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Where a torque-free body has turned to, and how that turns with the momentum.
struct Followed {
  Quat q;
  Mat3 slope;
};

/// turned_through() for one time, several times faster and as exact as a search needs: Runge–Kutta of fourth order on the rotation matrix R and on the slope S, S' = R I⁻¹ Rᵀ (1 + h × S).
Followed follow(const Mat3& from, const Vec3& h, const Vec3& inertia, double dt) {
  constexpr double kStep = 0.5;  // rad
  const Vec3 inverse = inertia.cwiseInverse();
  const Mat3 cross = crossing(h);
  const int steps = std::max(8, static_cast<int>(std::ceil(h.norm() * inverse.maxCoeff() * dt / kStep)));
  const double step = dt / steps;
  Mat3 r = from, s = Mat3::Zero();
  const auto rate = [&](const Mat3& at_r, const Mat3& at_s, Mat3& r_rate, Mat3& s_rate) {
    r_rate = crossing(Vec3(at_r * inverse.cwiseProduct(at_r.transpose() * h))) * at_r;
    const Mat3 inner = at_r.transpose() * (Mat3::Identity() + cross * at_s);
    s_rate = at_r * (inverse.asDiagonal() * inner);
  };
  Mat3 r1, r2, r3, r4, s1, s2, s3, s4;
  for (int i = 0; i < steps; ++i) {
    rate(r, s, r1, s1);
    rate(r + 0.5 * step * r1, s + 0.5 * step * s1, r2, s2);
    rate(r + 0.5 * step * r2, s + 0.5 * step * s2, r3, s3);
    rate(r + step * r3, s + step * s3, r4, s4);
    r += step / 6.0 * (r1 + 2.0 * r2 + 2.0 * r3 + r4);
    s += step / 6.0 * (s1 + 2.0 * s2 + 2.0 * s3 + s4);
  }
  return {Quat(r).normalized(), s};
}

/// The momentum near `h` that turns a body from one orientation to another; nothing if none is found.
std::optional<Vec3> momentum_between(const Quat& from, const Quat& to, double dt, const Vec3& inertia, Vec3 h) {
  constexpr int kRounds = 20;
  constexpr double kThere = 1e-3, kFirstDamping = 0.1;  // rad; little: the nearest one is sought
  const Mat3 start = from.toRotationMatrix(), unit = start * inertia.asDiagonal() * start.transpose() / dt;
  const auto off_by = [&](const Followed& end) { return rotation_vector<double>(end.q * to.conjugate()); };
  double damping = kFirstDamping;
  Followed end = follow(start, h, inertia, dt);
  Vec3 off = off_by(end);
  for (int round = 0; round < kRounds && off.norm() > kThere; ++round) {
    const Mat3 slope = end.slope * unit;
    const Vec3 next = h - unit * ((slope.transpose() * slope + damping * Mat3::Identity()).inverse() * (slope.transpose() * off));
    const Followed there = follow(start, next, inertia, dt);
    const bool better = off_by(there).norm() < off.norm();
    damping = better ? 0.1 * damping : std::max(1e-3, 10.0 * damping);
    if (better) h = next, end = there, off = off_by(end);
  }
  return off.norm() <= kThere ? std::optional(h) : std::nullopt;
}

/// Momenta that turn a body from one orientation to another, by up to kMostTurns whole turns about any axis: what is left of the turns of a body that
/// tumbles does not tell their axis.
std::vector<Vec3> momenta_between(const Quat& from, const Quat& to, double dt, const Vec3& inertia) {
  constexpr double kBetween = 0.25;  // of a turn: at whole ones no start leads away
  std::vector<Vec3> all;
  const auto add = [&](const Vec3& omega) {
    if (omega.norm() > kFastest) return;
    const std::optional<Vec3> h = momentum_between(from, to, dt, inertia, from * inertia.cwiseProduct(from.conjugate() * omega));
    if (h && angular_velocity<double>(from, *h, inertia).norm() < kFastest &&
        std::none_of(all.begin(), all.end(), [&](const Vec3& known) { return (known - *h).norm() < kSameMomentum * (known.norm() + h->norm()); }))
      all.push_back(*h);
  };
  add(rotation_vector<double>(to * from.conjugate()) / dt);
  for (int turns = 1; turns <= kMostTurns; ++turns)
    for (const Vec3& axis : sphere_directions(turns * kAxes)) add(2.0 * kPi * (turns - kBetween) / dt * axis);
  return all;
}

/// Gauss–Newton over orientation and momentum at the first observation's time.
SpinGuess refined(const std::vector<const OrientationObservation*>& seen, const Vec3& inertia, double sigma, SpinGuess guess) {
  const int rounds = guess.open && seen.size() == 2 ? 4 : 12;  // whose turns are open begins where both are met
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
      j.block<3, 3>(3 * i, 0) = (Mat3::Identity() + along * crossing(g.h)) / sigma;  // turning the start alone
      j.block<3, 3>(3 * i, 3) = along / sigma;
    }
    return j;
  };
  double damping = 1e-6;
  Eigen::VectorXd r = residuals(guess);
  Eigen::MatrixXd j = jacobian(guess);
  for (int round = 0; round < rounds; ++round) {
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
    const bool settled = r.squaredNorm() - r_next.squaredNorm() < kSettledSpin * (1.0 + r.squaredNorm());
    guess = next;
    r = r_next;
    j = jacobian(guess);
    if (settled) break;
  }
  guess.cost = 0.5 * r.squaredNorm();
  Eigen::MatrixXd normal = j.transpose() * j;
  normal.bottomRightCorner<3, 3>() += Mat3((kFastest * inertia).cwiseAbs2().cwiseInverse().asDiagonal());
  guess.covariance = normal.inverse();
  guess.spread = guess.covariance.bottomRightCorner<3, 3>();
  return guess;
}

/// What was seen of a body on one side of the impact, in order of time.
std::vector<const OrientationObservation*> seen_of(const Problem& problem, int body, bool after) {
  std::vector<const OrientationObservation*> seen;
  for (const OrientationObservation& o : problem.orientations)
    if (o.body == body && o.after == after) seen.push_back(&o);
  std::sort(seen.begin(), seen.end(), [](const auto* a, const auto* b) { return a->time < b->time; });
  return seen;
}

/// The first of the two that are nearest in time: they leave the fewest turns open.
std::size_t nearest_of(const std::vector<const OrientationObservation*>& seen) {
  std::size_t near = 0;
  for (std::size_t i = 0; i + 1 < seen.size(); ++i)
    if (seen[i + 1]->time - seen[i]->time < seen[near + 1]->time - seen[near]->time) near = i;
  return near;
}

bool may_turn_whole(double dt) { return kFastest * dt > 2.0 * kPi; }

}  // namespace

OpenTurns open_turns(const Problem& problem, int body, bool after) {
  const auto seen = seen_of(problem, body, after);
  if (seen.size() < 2) return {false, static_cast<int>(seen.size())};
  const std::size_t near = nearest_of(seen);
  return {may_turn_whole(seen[near + 1]->time - seen[near]->time), static_cast<int>(seen.size())};
}

std::vector<SpinGuess> spin_guesses(const Problem& problem, int body, bool after, double time) {
  const std::vector<const OrientationObservation*> seen = seen_of(problem, body, after);
  if (seen.empty() || !problem.terms.orientation) return {};
  const Vec3& inertia = problem.solids[body].mass.inertia;
  if (seen.size() == 1) return {{seen[0]->q, Vec3::Zero(), Mat3((kFastest * inertia).cwiseAbs2().asDiagonal())}};
  const std::size_t near = nearest_of(seen);
  const double dt = std::max(1e-6, seen[near + 1]->time - seen[near]->time);
  const Quat& q = seen[near]->q;
  const bool open = may_turn_whole(dt);
  std::vector<Vec3> momenta;
  if (open) {
    momenta = momenta_between(q, seen[near + 1]->q, dt, inertia);
  } else {
    const Vec3 turn = rotation_vector<double>(seen[near + 1]->q * q.conjugate());
    const Vec3 axis = turn.norm() > 1e-9 ? turn.normalized() : Vec3::UnitX();
    for (int turns = -kMostTurns; turns <= kMostTurns; ++turns) {
      const Vec3 omega = (turn + 2.0 * kPi * turns * axis) / dt;
      if (omega.norm() <= kFastest || turns == 0) momenta.push_back(q * inertia.cwiseProduct(q.conjugate() * omega));
    }
  }
  std::vector<SpinGuess> guesses;
  for (const Vec3& h : momenta) {
    SpinGuess guess;
    guess.q = turned(q, h, inertia, seen[0]->time - seen[near]->time);
    guess.h = h;
    guess.open = open;
    guess = refined(seen, inertia, problem.orientation_sigma, guess);
    const TurnedEnd end = turned_through(guess.q, guess.h, inertia, {time - seen[0]->time}, open)[0];
    if (open) {
      Eigen::Matrix<double, 6, 6> onward = Eigen::Matrix<double, 6, 6>::Identity();
      onward.topRows<3>() << Mat3::Identity() + end.along_h * crossing(guess.h), end.along_h;
      guess.covariance = onward * guess.covariance * onward.transpose();
    }
    guess.q = end.q;
    if (angular_velocity<double>(guess.q, guess.h, inertia).norm() < kFastest) guesses.push_back(guess);
  }
  std::stable_sort(guesses.begin(), guesses.end(), [](const SpinGuess& a, const SpinGuess& b) { return a.cost < b.cost; });
  if (open) std::erase_if(guesses, [least = guesses.front().cost](const SpinGuess& g) { return g.cost > least + kHopeless; });
  return guesses;
}

}  // namespace unseen::collision
