// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/one_flight.h"

#include <algorithm>
#include <cmath>

#include "core/linear.h"

namespace unseen::collision {
namespace {

constexpr std::size_t kFewest = 12;       // points, for eight unknowns
constexpr double kFitsOneFlight = 1.5;    // noises: rms of what is left
constexpr double kLeastDepth = 0.4, kMostDepth = 2.5;  // of that in the middle: no flight comes as near, or goes as far
constexpr int kIterations = 4;

/// Picture coordinates of a parabola in space are quotients of two of one denominator: (a0 + a1 t + a2 t²) / (1 + c1 t + c2 t²), likewise with b.
using Quotient = Eigen::Matrix<double, 8, 1>;  // a0 a1 a2 b0 b1 b2 c1 c2

double denominator(const Quotient& q, double t) { return 1.0 + t * (q[6] + t * q[7]); }

Vec2 at(const Quotient& q, double t) { return Vec2(q[0] + t * (q[1] + t * q[2]), q[3] + t * (q[4] + t * q[5])) / denominator(q, t); }

/// Least squares, linear in the unknowns once each equation is divided by the denominator as it was.
Quotient fit(const std::vector<double>& times, const std::vector<Vec2>& places) {
  const auto count = static_cast<Eigen::Index>(times.size());
  Quotient q = Quotient::Zero();
  Eigen::MatrixXd rows(2 * count, 8);
  Eigen::VectorXd right(2 * count);
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    rows.setZero();
    for (Eigen::Index i = 0; i < count; ++i) {
      const double t = times[static_cast<std::size_t>(i)], weight = 1.0 / std::max(denominator(q, t), kLeastDepth);
      for (int axis = 0; axis < 2; ++axis) {
        const double place = places[static_cast<std::size_t>(i)][axis];
        rows.row(2 * i + axis).segment<3>(3 * axis) << weight, weight * t, weight * t * t;
        rows.row(2 * i + axis).tail<2>() << -weight * place * t, -weight * place * t * t;
        right[2 * i + axis] = weight * place;
      }
    }
    q = least_squares(rows, right);
  }
  return q;
}

}  // namespace

bool is_one_flight(const std::vector<Candidate>& points, double noise) {
  if (points.size() < kFewest) return false;
  const double middle = 0.5 * (points.front().u + points.back().u), half = 0.5 * (points.back().u - points.front().u);
  Vec2 mean = Vec2::Zero();
  for (const Candidate& c : points) mean += c.pixel / static_cast<double>(points.size());
  double scale = 1.0;  // px
  for (const Candidate& c : points) scale = std::max(scale, (c.pixel - mean).cwiseAbs().maxCoeff());
  std::vector<double> times;
  std::vector<Vec2> places;
  for (const Candidate& c : points) {
    times.push_back((c.u - middle) / half);
    places.push_back((c.pixel - mean) / scale);
  }
  const Quotient q = fit(times, places);
  double squares = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const double depth = denominator(q, times[i]);
    if (!(depth > kLeastDepth && depth < kMostDepth)) return false;
    squares += (at(q, times[i]) - places[i]).squaredNorm();
  }
  const double freedom = 2.0 * static_cast<double>(times.size()) - 8.0;
  return scale * std::sqrt(squares / freedom) < kFitsOneFlight * noise;
}

}  // namespace unseen::collision
