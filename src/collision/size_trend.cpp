// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/size_trend.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "collision/median.h"

namespace unseen::collision {
namespace {

constexpr std::size_t kFewest = 8;   // sightings
constexpr double kSystematic = 0.005;  // of the size: change along a flight that is none of the distance, and
constexpr double kPixels = 0.3;      // px of the diameter
constexpr double kOutlier = 3.0;     // σ

struct Size {
  double time, log_depth, diameter;
};

/// A parabola about the middle of the times, in units of half their span: its coefficients.
Vec3 parabola(const std::vector<Size>& sizes, double middle, double half) {
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const Size& s : sizes) {
    const double x = (s.time - middle) / half;
    const Vec3 row(1.0, x, x * x);
    normal += row * row.transpose();
    right += s.log_depth * row;
  }
  return normal.ldlt().solve(right);
}

std::optional<SizeTrend> trend_of(std::vector<Size> sizes, int body, bool after) {
  if (sizes.size() < kFewest) return std::nullopt;
  const auto [first, last] = std::minmax_element(sizes.begin(), sizes.end(), [](const Size& a, const Size& b) { return a.time < b.time; });
  const double begin = first->time, end = last->time, middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
  if (half <= 0.0) return std::nullopt;
  const auto off = [&](const Size& s, const Vec3& fit) {
    const double x = (s.time - middle) / half;
    return std::abs(s.log_depth - fit.dot(Vec3(1.0, x, x * x)));
  };
  Vec3 fit = Vec3::Zero();
  double sigma = 0.0;
  for (int round = 0; round < 2; ++round) {
    fit = parabola(sizes, middle, half);
    std::vector<double> all;
    for (const Size& s : sizes) all.push_back(off(s, fit));
    sigma = 1.4826 * median(all);
    std::vector<Size> near;
    for (const Size& s : sizes)
      if (off(s, fit) <= kOutlier * sigma + 1e-9) near.push_back(s);
    if (near.size() < kFewest) break;
    sizes = near;
  }
  std::vector<double> diameters;
  for (const Size& s : sizes) diameters.push_back(s.diameter);
  const double random = sigma * std::sqrt(12.0 / static_cast<double>(sizes.size()));
  return SizeTrend{body, after, begin, end, 2.0 * fit[1], std::hypot(random, kSystematic, kPixels / median(diameters))};
}

}  // namespace

std::vector<SizeTrend> size_trends(const Problem& problem) {
  std::vector<SizeTrend> trends;
  for (int body = 0; body < 2; ++body) {
    const Solid& solid = problem.solids[static_cast<std::size_t>(body)];
    if (!solid.is_sphere()) continue;
    for (const bool after : {false, true}) {
      std::vector<Size> sizes;
      for (const PointObservation& p : problem.points)
        if (p.body == body && p.after == after && p.depth > 0.0)
          sizes.push_back({p.time, std::log(p.depth), problem.camera.fx * solid.mass.extent / p.depth});
      if (const auto trend = trend_of(std::move(sizes), body, after)) trends.push_back(*trend);
    }
  }
  return trends;
}

}  // namespace unseen::collision
