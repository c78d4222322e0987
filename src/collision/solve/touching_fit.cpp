// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/touching_fit.h"

#include <Eigen/Dense>

#include <algorithm>

namespace unseen::collision {
namespace {

constexpr double kLateness = 0.1;  // s
constexpr int kPlace = 0, kVa = 3, kVb = 6, kDelay = 9, kAll = 16;  // of all: the flights, then both changes

using Flight = Eigen::Matrix<double, LinearFlight::kUnknowns, 1>;
using Map = Eigen::Matrix<double, LinearFlight::kUnknowns, kAll>;

double half_chi(const LinearFlight& f, const Flight& y) { return 0.5 * y.dot(f.normal * y) - f.right.dot(y); }

/// From all unknowns to a body's place, velocities and delay.
Map map_to(int velocity, int change) {
  Map map = Map::Zero();
  map.block<3, 3>(0, kPlace).setIdentity();
  map.block<3, 3>(3, velocity).setIdentity();
  map.block<3, 3>(6, velocity).setIdentity();
  map.block<3, 3>(6, change).setIdentity();
  map(9, kDelay) = 1.0;
  return map;
}

/// ½ χ² = ½ zᵀ M z − r z of the impulse and a step of 1/m.
struct Quadratic {
  Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  /// Residual map·z + at, with a precision.
  void add(const Eigen::Matrix<double, 3, 4>& map, const Vec3& at, const Mat3& precision) {
    const Eigen::Matrix<double, 3, 4> weighted = precision * map;
    normal += map.transpose() * weighted;
    right -= weighted.transpose() * at;
  }
};

}  // namespace

TouchingFit::TouchingFit(const Problem& problem, const State& base, const LinearFlight& a, const LinearFlight& b) : problem_(problem), base_(base) {
  const Map to_a = map_to(kVa, kFlights), to_b = map_to(kVb, kFlights + 3);  // the second body's place is the first's less the offset
  Eigen::Matrix<double, kAll, kAll> normal = to_a.transpose() * a.normal * to_a + to_b.transpose() * b.normal * to_b;
  normal(kDelay, kDelay) += 1.0 / (kLateness * kLateness);
  const Eigen::Matrix<double, kAll, 1> right = to_a.transpose() * a.right + to_b.transpose() * b.right;
  const Eigen::Matrix<double, kAll, 3> right_of = to_b.transpose() * b.normal.leftCols<3>();
  const Eigen::LDLT<Eigen::Matrix<double, kFlights, kFlights>> own(normal.topLeftCorner<kFlights, kFlights>());
  flights_ = own.solve(right.head<kFlights>());
  flights_of_ = own.solve(right_of.topRows<kFlights>());
  flights_by_ = own.solve(normal.topRightCorner<kFlights, kChanges>());
  normal_ = normal.bottomRightCorner<kChanges, kChanges>() - normal.bottomLeftCorner<kChanges, kFlights>() * flights_by_;
  right_ = right.tail<kChanges>() - normal.bottomLeftCorner<kChanges, kFlights>() * flights_;
  right_of_ = right_of.bottomRows<kChanges>() - normal.bottomLeftCorner<kChanges, kFlights>() * flights_of_;
  constant_ = -0.5 * right.head<kFlights>().dot(flights_);
  constant_along_ = b.right.head<3>() - flights_of_.transpose() * right.head<kFlights>();
  constant_across_ = b.normal.topLeftCorner<3, 3>() - right_of.topRows<kFlights>().transpose() * flights_of_;
  for (const LinearFlight* f : {&a, &b}) {
    Flight apart;
    apart << f->p, f->v_before, f->v_after, 0.0;
    constant_ -= half_chi(*f, apart);
  }
}

double TouchingFit::cost(const Vec3& offset, const Changes& changes) const {
  return 0.5 * changes.dot(normal_ * changes) - (right_ + right_of_ * offset).dot(changes) + constant_ + constant_along_.dot(offset) +
         0.5 * offset.dot(constant_across_ * offset);
}

TouchingFit::Result TouchingFit::operator()(const Touching& touching, const Turn& turn_a, const Turn& turn_b) const {
  constexpr int kRounds = 3;
  constexpr double kFriction = 0.4;  // |J_t| over J_n that is still usual
  const double inverse_sigma = (problem_.mass_ratio ? 1e-6 : 3.0) / base_.mass_ratio;
  const Mat3 across = Mat3::Identity() - touching.normal * touching.normal.transpose();
  const Mat3 arm_a = cross_matrix(touching.arm_a), arm_b = cross_matrix(touching.arm_b);
  const Changes right = right_ + right_of_ * touching.offset;
  Vec3 impulse = base_.impulse;
  double inverse = 1.0 / base_.mass_ratio;
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix<double, kChanges, 4> to_changes = Eigen::Matrix<double, kChanges, 4>::Zero();
    to_changes.topLeftCorner<3, 3>().setIdentity();
    to_changes.bottomLeftCorner<3, 3>() = -inverse * Mat3::Identity();
    to_changes.bottomRightCorner<3, 1>() = -impulse;
    Quadratic all{to_changes.transpose() * normal_ * to_changes, to_changes.transpose() * right};
    Eigen::Matrix<double, 3, 4> turning;
    turning << arm_a, Vec3::Zero();
    all.add(turning, -turn_a.change, turn_a.precision);
    turning << -inverse * arm_b, -arm_b * impulse;
    all.add(turning, -turn_b.change, turn_b.precision);
    all.normal.topLeftCorner<3, 3>() += across / (kFriction * kFriction * std::max(1e-12, impulse.squaredNorm()));
    all.normal(3, 3) += 1.0 / (inverse_sigma * inverse_sigma);
    all.right(3) += (1.0 / base_.mass_ratio - inverse) / (inverse_sigma * inverse_sigma);
    const Eigen::Vector4d z = all.normal.ldlt().solve(all.right);
    impulse = z.head<3>();
    if (!problem_.mass_ratio) inverse = std::clamp(inverse + z[3], 0.2 / base_.mass_ratio, 5.0 / base_.mass_ratio);
  }
  Changes changes;
  changes << impulse, -inverse * impulse;
  const Flights own = flights(touching.offset, changes);
  Result result;
  State& s = result.state = base_;
  s.p = {own.segment<3>(kPlace), own.segment<3>(kPlace) - touching.offset};
  s.v = {own.segment<3>(kVa), own.segment<3>(kVb)};
  s.impulse = impulse;
  s.mass_ratio = 1.0 / inverse;
  s.v_after = {s.v[0] + impulse, s.v[1] - inverse * impulse};
  s.time = base_.time + own[kDelay];
  for (int o = 0; o < 2; ++o) {  // the velocities are those at the time that the flights were written for
    s.v[o] = problem_.flies(o, false) ? Vec3(s.v[o] + problem_.gravity * base_.down * own[kDelay]) : Vec3(Vec3::Zero());
    s.v_after[o] += problem_.gravity * base_.down * own[kDelay];
  }
  s.x = s.p[0] + touching.arm_a;

  const Vec3 off_a = arm_a * impulse - turn_a.change, off_b = -inverse * (arm_b * impulse) - turn_b.change;
  const double slid = (across * impulse).norm() / (kFriction * std::max(1e-6, impulse.norm()));
  const double pulled = std::min(0.0, impulse.dot(touching.normal)) / (0.05 * std::max(1e-6, impulse.norm()));  // bodies push each other
  const double late = own[kDelay] / kLateness;  // a help to the fit, nothing seen
  result.cost = cost(touching.offset, changes) +
                0.5 * (off_a.dot(turn_a.precision * off_a) + off_b.dot(turn_b.precision * off_b) + slid * slid + pulled * pulled - late * late);
  return result;
}

}  // namespace unseen::collision
