// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/touching_fit.h"

#include <Eigen/Dense>

#include <algorithm>

namespace unseen::collision {
namespace {

constexpr int kFlight = LinearFlight::kUnknowns;
constexpr int kPlace = 0, kVa = 3, kVb = 6, kJ = 9, kDelay = 12, kInverse = 13, kAll = 14;  // place of a, velocities before, impulse, delay, 1/m
using Vector = Eigen::Matrix<double, kAll, 1>;
using Matrix = Eigen::Matrix<double, kAll, kAll>;
using Map = Eigen::Matrix<double, kFlight, kAll>;

double half_chi(const LinearFlight& f, const Eigen::Matrix<double, kFlight, 1>& y) { return 0.5 * y.dot(f.normal * y) - f.right.dot(y); }

/// ½ χ² = ½ zᵀ M z − r z.
struct Quadratic {
  Matrix normal = Matrix::Zero();
  Vector right = Vector::Zero();
  /// Residual map·z + at, with a precision.
  template <class M, class V, class P>
  void add(const M& map, const V& at, const P& precision) {
    normal += map.transpose() * precision * map;
    right -= map.transpose() * (precision * at);
  }
};

}  // namespace

TouchingFit::TouchingFit(const Problem& problem, const State& base, const LinearFlight& a, const LinearFlight& b)
    : problem_(problem), base_(base), a_(a), b_(b), apart_(0.0) {
  for (const LinearFlight* f : {&a, &b}) {
    Eigen::Matrix<double, kFlight, 1> y;
    y << f->p, f->v_before, f->v_after, 0.0;
    apart_ += half_chi(*f, y);
  }
}

TouchingFit::Result TouchingFit::operator()(const Touching& touching, const Turn& turn_a, const Turn& turn_b) const {
  constexpr int kRounds = 3;
  constexpr double kFriction = 0.4, kLateness = 0.1;  // |J_t| over J_n that is still usual; s
  const double inverse_sigma = (problem_.mass_ratio ? 1e-6 : 3.0) / base_.mass_ratio;
  Vec3 impulse = base_.impulse;
  double inverse = 1.0 / base_.mass_ratio;
  const Mat3 across = Mat3::Identity() - touching.normal * touching.normal.transpose();
  const Mat3 arm_a = cross_matrix(touching.arm_a), arm_b = cross_matrix(touching.arm_b);
  Map to_a = Map::Zero(), to_b = Map::Zero();
  to_a.block<3, 3>(0, kPlace).setIdentity();
  to_a.block<3, 3>(3, kVa).setIdentity();
  to_a.block<3, 3>(6, kVa).setIdentity();
  to_a.block<3, 3>(6, kJ).setIdentity();
  to_a(9, kDelay) = 1.0;
  to_b.block<3, 3>(0, kPlace).setIdentity();
  to_b.block<3, 3>(3, kVb).setIdentity();
  to_b.block<3, 3>(6, kVb).setIdentity();
  to_b(9, kDelay) = 1.0;
  Eigen::Matrix<double, kFlight, 1> at_b = Eigen::Matrix<double, kFlight, 1>::Zero();
  at_b.head<3>() = -touching.offset;
  Vector z = Vector::Zero();
  Quadratic all;
  for (int round = 0; round < kRounds; ++round) {
    all = Quadratic();
    to_b.block<3, 3>(6, kJ) = -inverse * Mat3::Identity();
    to_b.block<3, 1>(6, kInverse) = -impulse;  // of a step of 1/m
    all.normal = to_a.transpose() * a_.normal * to_a + to_b.transpose() * b_.normal * to_b;
    all.right = to_a.transpose() * a_.right + to_b.transpose() * (b_.right - b_.normal * at_b);
    Eigen::Matrix<double, 3, kAll> turning = Eigen::Matrix<double, 3, kAll>::Zero();
    turning.block<3, 3>(0, kJ) = arm_a;
    all.add(turning, Vec3(-turn_a.change), turn_a.precision);
    turning.block<3, 3>(0, kJ) = -inverse * arm_b;
    turning.block<3, 1>(0, kInverse) = -arm_b * impulse;
    all.add(turning, Vec3(-turn_b.change), turn_b.precision);
    Eigen::Matrix<double, 3, kAll> sliding = Eigen::Matrix<double, 3, kAll>::Zero();
    sliding.block<3, 3>(0, kJ) = across / (kFriction * std::max(1e-6, impulse.norm()));
    all.add(sliding, Vec3(Vec3::Zero()), Mat3(Mat3::Identity()));
    all.normal(kDelay, kDelay) += 1.0 / (kLateness * kLateness);
    all.normal(kInverse, kInverse) += 1.0 / (inverse_sigma * inverse_sigma);
    all.right(kInverse) += (1.0 / base_.mass_ratio - inverse) / (inverse_sigma * inverse_sigma);
    z = all.normal.ldlt().solve(all.right);
    impulse = z.segment<3>(kJ);
    if (!problem_.mass_ratio) inverse = std::clamp(inverse + z[kInverse], 0.2 / base_.mass_ratio, 5.0 / base_.mass_ratio);
  }
  Result result;
  State& s = result.state = base_;
  s.p = {z.segment<3>(kPlace), z.segment<3>(kPlace) - touching.offset};
  s.v = {z.segment<3>(kVa), z.segment<3>(kVb)};
  s.impulse = impulse;
  s.mass_ratio = 1.0 / inverse;
  s.v_after = {s.v[0] + impulse, s.v[1] - inverse * impulse};
  s.time = base_.time + z[kDelay];
  for (int o = 0; o < 2; ++o) {  // the velocities are those at the time that the flights were written for
    s.v[o] = problem_.flies(o, false) ? Vec3(s.v[o] + problem_.gravity * base_.down * z[kDelay]) : Vec3(Vec3::Zero());
    s.v_after[o] += problem_.gravity * base_.down * z[kDelay];
  }
  s.x = s.p[0] + touching.arm_a;

  Eigen::Matrix<double, kFlight, 1> y_a, y_b;
  y_a << z.segment<3>(kPlace), z.segment<3>(kVa), z.segment<3>(kVa) + impulse, z[kDelay];
  y_b << s.p[1], z.segment<3>(kVb), z.segment<3>(kVb) - inverse * impulse, z[kDelay];
  const Vec3 off_a = arm_a * impulse - turn_a.change, off_b = -inverse * (arm_b * impulse) - turn_b.change;
  const double slid = (across * impulse).norm() / (kFriction * std::max(1e-6, impulse.norm()));
  const double pulled = std::min(0.0, impulse.dot(touching.normal)) / (0.05 * std::max(1e-6, impulse.norm()));  // bodies push each other
  result.cost = half_chi(a_, y_a) + half_chi(b_, y_b) - apart_ + 0.5 * (off_a.dot(turn_a.precision * off_a) + off_b.dot(turn_b.precision * off_b)) +
                0.5 * (slid * slid + pulled * pulled);
  return result;
}

}  // namespace unseen::collision
