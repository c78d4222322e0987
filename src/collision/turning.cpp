// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <Eigen/Cholesky>
#include <algorithm>

#include "collision/rotation.h"
#include "collision/spin_search.h"

namespace unseen::collision {
namespace {

using Residuals = Eigen::Matrix<double, kDirections, Eigen::Dynamic>;  ///< a column a look

std::vector<Quat> path(const Turning& turning, const SpinBody& body, const std::vector<Look>& looks, std::size_t begin, std::size_t end) {
  const Vec3& inertia = body.solid.mass.inertia;
  std::vector<Quat> all(end - begin);
  std::size_t middle = begin;
  while (middle < end && looks[middle].time < turning.time) ++middle;
  Quat q = turning.q;
  double time = turning.time;
  for (std::size_t i = middle; i < end; ++i) {
    q = turned<double>(q, turning.h, inertia, looks[i].time - time);
    time = looks[i].time;
    all[i - begin] = q;
  }
  q = turning.q;
  time = turning.time;
  for (std::size_t i = middle; i-- > begin;) {
    q = turned<double>(q, turning.h, inertia, looks[i].time - time);
    time = looks[i].time;
    all[i - begin] = q;
  }
  return all;
}

/// Costs of the silhouettes of looks [begin, end) and how they change.
class Problem6 {
 public:
  Problem6(const SpinBody& body, const Camera& camera, const std::vector<Look>& looks, std::size_t begin, std::size_t end)
      : body_(body), camera_(camera), looks_(looks), begin_(begin), end_(end) {
    const double duration = std::max(1e-3, looks[end - 1].time - looks[begin].time);
    scale_ = body.solid.mass.inertia.mean() / duration;
  }

  Residuals residuals(const Turning& t) const {
    const std::vector<Quat> q = path(t, body_, looks_, begin_, end_);
    Residuals r(static_cast<Eigen::Index>(kDirections), static_cast<Eigen::Index>(q.size()));
    for (std::size_t i = 0; i < q.size(); ++i)
      r.col(static_cast<Eigen::Index>(i)) = silhouette_residual(body_, camera_, looks_[begin_ + i], q[i]);
    return r;
  }

  static double cost(const Residuals& r) {
    double sum = 0.0;
    for (Eigen::Index i = 0; i < r.cols(); ++i) sum += frame_loss(r.col(i).squaredNorm());
    return sum;
  }

  /// `move`: a turn (rad), and a change of momentum in units of scale().
  Turning moved(const Turning& t, const Eigen::Matrix<double, 6, 1>& move) const {
    Turning next = t;
    next.q = (rotation_by<double>(Vec3(move.head<3>())) * t.q).normalized();
    next.h = t.h + scale_ * move.tail<3>();
    return next;
  }

  void linearise(const Turning& t, const Residuals& r, Eigen::Matrix<double, 6, 6>& normal, Eigen::Matrix<double, 6, 1>& gradient) const {
    constexpr double kStep = 1e-4;
    std::array<Residuals, 6> slopes;
    for (int k = 0; k < 6; ++k) slopes[k] = (residuals(moved(t, kStep * Eigen::Matrix<double, 6, 1>::Unit(k))) - r) / kStep;
    normal.setZero();
    gradient.setZero();
    for (Eigen::Index i = 0; i < r.cols(); ++i) {
      Eigen::Matrix<double, kDirections, 6> j;
      for (int k = 0; k < 6; ++k) j.col(k) = slopes[k].col(i);
      const double weight = frame_weight(r.col(i).squaredNorm());
      normal += weight * j.transpose() * j;
      gradient += weight * j.transpose() * r.col(i);
    }
  }

  double scale() const { return scale_; }

 private:
  const SpinBody& body_;
  const Camera& camera_;
  const std::vector<Look>& looks_;
  std::size_t begin_, end_;
  double scale_ = 1;
};

}  // namespace

std::vector<Quat> orientations_of(const Turning& turning, const SpinBody& body, const std::vector<Look>& looks) {
  return path(turning, body, looks, 0, looks.size());
}

Turning at_time(const Turning& turning, const SpinBody& body, double time) {
  Turning other = turning;
  other.q = turned<double>(turning.q, turning.h, body.solid.mass.inertia, time - turning.time);
  other.time = time;
  return other;
}

double silhouette_cost(const Turning& turning, const SpinBody& body, const Camera& camera, const std::vector<Look>& looks, std::size_t begin,
                       std::size_t end) {
  return Problem6::cost(Problem6(body, camera, looks, begin, end).residuals(turning));
}

Turning refined(const Turning& start, const SpinBody& body, const Camera& camera, const std::vector<Look>& looks, std::size_t begin,
                std::size_t end, int steps) {
  constexpr double kFarthest = 0.4;
  const Problem6 problem(body, camera, looks, begin, end);
  Turning best = at_time(start, body, 0.5 * (looks[begin].time + looks[end - 1].time));
  Residuals r = problem.residuals(best);
  best.cost = Problem6::cost(r);
  double damping = 1e-3;
  Eigen::Matrix<double, 6, 6> normal;
  Eigen::Matrix<double, 6, 1> gradient;
  problem.linearise(best, r, normal, gradient);
  for (int step = 0; step < steps && damping < 1e4; ++step) {
    Eigen::Matrix<double, 6, 6> damped = normal;
    damped.diagonal() *= 1.0 + damping;
    damped.diagonal().array() += 1e-6;
    Eigen::Matrix<double, 6, 1> move = -damped.ldlt().solve(gradient);
    if (move.norm() > kFarthest) move *= kFarthest / move.norm();
    Turning next = problem.moved(best, move);
    const Residuals there = problem.residuals(next);
    next.cost = Problem6::cost(there);
    if (next.cost < best.cost) {
      const bool done = best.cost - next.cost < 1e-3;
      best = next, r = there, damping *= 0.2;
      problem.linearise(best, r, normal, gradient);
      if (done) break;
    } else {
      damping = std::max(10.0 * damping, 1e-2);
    }
  }
  Eigen::Matrix<double, 6, 1> unit;
  unit << 1, 1, 1, Vec3::Constant(1.0 / problem.scale());
  best.information = unit.asDiagonal() * normal * unit.asDiagonal();
  return best;
}

}  // namespace unseen::collision
