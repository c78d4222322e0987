// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/linear_flights.h"

#include <Eigen/Dense>

#include <algorithm>

namespace unseen::collision {
namespace {

constexpr double kRidge = 1e-4;  // per m/s: keeps a velocity that nothing was seen of small

using Row = Eigen::Matrix<double, 1, 9>;  // P, V before, V after

struct System {
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  Eigen::Matrix<double, 9, 1> right = Eigen::Matrix<double, 9, 1>::Zero();
  void add(const Row& row, double value, double weight) {
    normal += weight * row.transpose() * row;
    right += weight * value * row.transpose();
  }
};

/// Coefficients of coordinate `axis` of the place at τ.
Row coordinate(int axis, double tau, bool after) {
  Row row = Row::Zero();
  row[axis] = 1.0;
  row[3 + axis + (after ? 3 : 0)] = tau;
  return row;
}

}  // namespace

std::optional<LinearFlight> linear_flight(const Problem& problem, int body, double time) {
  constexpr int kRounds = 8;
  const Camera& c = problem.camera;
  const Vec3 g = problem.gravity * problem.down;
  Eigen::Matrix<double, 9, 1> solution = Eigen::Matrix<double, 9, 1>::Zero();
  bool seen = false;
  for (int round = 0; round < kRounds; ++round) {
    System system;
    for (const PointObservation& point : problem.points) {
      if (point.body != body) continue;
      seen = true;
      const double tau = point.time - time, half = 0.5 * tau * tau;
      const Row z = coordinate(2, tau, point.after);
      const double depth = round == 0 ? 1.0 : std::max(0.05, z * solution + half * g.z());
      const double focal[2] = {c.fx, c.fy}, offset[2] = {point.pixel.x() - c.cx, point.pixel.y() - c.cy};
      Row rows[2];
      double values[2], square = 0.0;
      for (int i = 0; i < 2; ++i) {
        rows[i] = (focal[i] * coordinate(i, tau, point.after) - offset[i] * z) / depth;
        values[i] = -half * (focal[i] * g[i] - offset[i] * g.z()) / depth;
        if (round > 0) square += std::pow(rows[i] * solution - values[i], 2);
      }
      const double sigma = problem.pixel_sigma, weight = 1.0 / (sigma * sigma) / std::max(1.0, std::sqrt(square) / (3.0 * sigma));
      for (int i = 0; i < 2; ++i) system.add(rows[i], values[i], weight);
      if (problem.terms.size && point.depth > 0.0) {
        const double spread = point.depth * point.depth_sigma;
        system.add(z, point.depth - half * g.z(), 1.0 / (spread * spread));
      }
    }
    for (int i = 3; i < 9; ++i) system.normal(i, i) += kRidge * kRidge;
    if (problem.planar)
      for (const int i : {5, 8}) system.normal(i, i) += 1e6;
    const Eigen::LDLT<Eigen::Matrix<double, 9, 9>> solver(system.normal);
    if (!seen || solver.info() != Eigen::Success) return std::nullopt;
    solution = solver.solve(system.right);
    if (!solution.allFinite()) return std::nullopt;
  }
  if (solution[2] < 0.01) return std::nullopt;
  return LinearFlight{solution.segment<3>(0), solution.segment<3>(3), solution.segment<3>(6)};
}

}  // namespace unseen::collision
