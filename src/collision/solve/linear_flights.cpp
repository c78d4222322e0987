// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/linear_flights.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>

namespace unseen::collision {
namespace {

constexpr double kRidge = 1e-4;  // per m/s: keeps a velocity that nothing was seen of small
constexpr double kSettledFlight = 1e-8;  // of the unknowns
constexpr double kHeld = 1e6;    // the square of such a weight, of a velocity that is none

constexpr int kDelayOfBoth = LinearFlight::kUnknowns - 1;
using Column = Eigen::Matrix<double, LinearFlight::kUnknowns, 1>;  // P, V before, V after, delay

/// The coefficients of an equation that are not 0.
template <int N>
struct Row {
  std::array<int, N> at;
  std::array<double, N> value;

  double operator*(const Column& x) const {
    double sum = 0.0;
    for (int i = 0; i < N; ++i) sum += value[i] * x[at[i]];
    return sum;
  }
};

struct System {
  Eigen::Matrix<double, LinearFlight::kUnknowns, LinearFlight::kUnknowns> normal = decltype(normal)::Zero();
  Column right = Column::Zero();

  template <int N>
  void add(const Row<N>& row, double value, double weight) {
    for (int i = 0; i < N; ++i) {
      for (int k = 0; k < N; ++k) normal(row.at[i], row.at[k]) += weight * row.value[i] * row.value[k];
      right[row.at[i]] += weight * value * row.value[i];
    }
  }
};

/// ½ x², linear beyond 1.
double huber(double x) { return std::abs(x) < 1.0 ? 0.5 * x * x : std::abs(x) - 0.5; }

/// Coordinate `axis` of the place at τ; a later impact moves both flights back by their velocities, which are those of `near`.
Row<3> coordinate(int axis, double tau, bool after, const Column& near) {
  const int velocity = 3 + axis + (after ? 3 : 0);
  return {{axis, velocity, kDelayOfBoth}, {1.0, tau, -near[velocity]}};
}

/// What a pixel's coordinate says: (f · place − offset · z) / depth.
Row<5> seen_row(const Row<3>& place, const Row<3>& z, double focal, double offset, double depth) {
  const double a = focal / depth, b = -offset / depth;
  return {{place.at[0], place.at[1], z.at[0], z.at[1], kDelayOfBoth}, {a * place.value[0], a * place.value[1], b * z.value[0], b * z.value[1], a * place.value[2] + b * z.value[2]}};
}

}  // namespace

std::optional<LinearFlight> linear_flight(const Problem& problem, int body, double time) {
  constexpr int kRounds = 12, kAlgebraic = 2;
  const Camera& c = problem.camera;
  const Vec3 g = problem.gravity * problem.down;
  Column solution = Column::Zero();
  System system;
  bool seen = false;
  for (int round = 0; round < kRounds; ++round) {
    system = System();
    for (const PointObservation& point : problem.points) {
      if (point.body != body) continue;
      seen = true;
      const double tau = problem.flies(body, point.after) ? point.time - time : 0.0, half = 0.5 * tau * tau;
      const Row<3> z = coordinate(2, tau, point.after, solution);
      const double depth = round == 0 ? 1.0 : std::max(0.05, z * solution + half * g.z());
      const double focal[2] = {c.fx, c.fy}, seen_at[2] = {point.pixel.x() - c.cx, point.pixel.y() - c.cy};
      std::array<Row<5>, 2> rows;
      double values[2], square = 0.0;
      for (int i = 0; i < 2; ++i) {
        const Row<3> place = coordinate(i, tau, point.after, solution);
        // first as it is seen; then Gauss–Newton about the place, since noise in the coefficients draws everything nearer
        const double offset = round < kAlgebraic ? seen_at[i] : focal[i] * (place * solution + half * g[i]) / depth;
        rows[i] = seen_row(place, z, focal[i], offset, depth);
        values[i] = seen_at[i] - offset - half * (focal[i] * g[i] - offset * g.z()) / depth;
        if (round > 0) square += std::pow(rows[i] * solution - values[i], 2);
      }
      const double sigma = problem.pixel_sigma, weight = 1.0 / (sigma * sigma) / std::max(1.0, std::sqrt(square) / (3.0 * sigma));
      for (int i = 0; i < 2; ++i) system.add(rows[i], values[i], weight);
      if (problem.terms.size && point.depth > 0.0) {
        const double spread = point.depth * point.depth_sigma;
        system.add(z, point.depth - half * g.z(), 1.0 / (spread * spread));
      }
    }
    for (const SizeTrend& trend : problem.trends) {
      if (trend.body != body || !problem.terms.size || round == 0) continue;
      const double flies = problem.flies(body, trend.after) ? 1.0 : 0.0, t[2] = {flies * (trend.begin - time), flies * (trend.end - time)}, ratio = std::exp(trend.change);
      const Row<3> first = coordinate(2, t[0], trend.after, solution), last = coordinate(2, t[1], trend.after, solution);
      Row<3> row = last;
      for (int i = 0; i < 3; ++i) row.value[i] -= ratio * first.value[i];
      const double depth = std::max(0.05, last * solution + 0.5 * t[1] * t[1] * g.z()), spread = depth * trend.sigma;
      system.add(row, -0.5 * g.z() * (t[1] * t[1] - ratio * t[0] * t[0]), 1.0 / (spread * spread));
    }
    for (int i = 3; i < 9; ++i) system.normal(i, i) += kRidge * kRidge;
    if (!problem.flies(body, false))
      for (const int i : {3, 4, 5}) system.normal(i, i) += kHeld;
    if (problem.planar)
      for (const int i : {5, 8}) system.normal(i, i) += kHeld;
    const Eigen::LDLT<Eigen::Matrix<double, kDelayOfBoth, kDelayOfBoth>> solver(system.normal.topLeftCorner<kDelayOfBoth, kDelayOfBoth>());  // at the time given
    if (!seen || solver.info() != Eigen::Success) return std::nullopt;
    const Eigen::Matrix<double, kDelayOfBoth, 1> next = solver.solve(system.right.head<kDelayOfBoth>());
    if (!next.allFinite()) return std::nullopt;
    const bool settled = round >= kAlgebraic && (next - solution.head<kDelayOfBoth>()).norm() < kSettledFlight * next.norm();
    solution.head<kDelayOfBoth>() = next;
    if (settled) break;
  }
  if (solution[2] < 0.01) return std::nullopt;
  return LinearFlight{solution.segment<3>(0), solution.segment<3>(3), solution.segment<3>(6), system.normal, system.right};
}

double misfit(const Problem& problem, const LinearFlight& flight, int body, double time) {
  double sum = 0.0;
  std::array<double, 2> off_by_size = {}, count = {}, sigma = {};  // before and after: sizes of a flight are off together
  for (const PointObservation& seen : problem.points) {
    if (seen.body != body) continue;
    const double tau = problem.flies(body, seen.after) ? seen.time - time : 0.0;
    const Vec3 p = flight.p + tau * (seen.after ? flight.v_after : flight.v_before) + 0.5 * tau * tau * problem.gravity * problem.down;
    const double square = p.z() > 0.0 ? (problem.camera.project(p) - seen.pixel).squaredNorm() / (problem.pixel_sigma * problem.pixel_sigma) : 2.0 * kMostMisfit;
    sum += std::min(0.5 * square, kMostMisfit);
    if (!problem.terms.size || seen.depth <= 0.0 || p.z() <= 0.0) continue;
    off_by_size[seen.after] += std::log(p.z() / seen.depth);
    sigma[seen.after] = seen.depth_sigma;
    count[seen.after] += 1.0;
  }
  for (std::size_t side = 0; side < 2; ++side)
    if (count[side] > 0.0) sum += huber(off_by_size[side] / std::sqrt(count[side]) / sigma[side]);
  return sum;
}

}  // namespace unseen::collision
