// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/size_trend.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr std::size_t kFewest = 8;   // sightings
constexpr double kSystematic = 0.005;  // of the size: change along a flight that is none of the distance, and
constexpr double kFilmedPixels = 0.3;  // px of the diameter: regions, and
constexpr double kTrackedPixels = 1.0;  // px: whatever else told the size
constexpr double kOutlier = 3.0;     // σ

struct Size {
  double time, depth, diameter;
};

/// Depths over time on a parabola, as gravity has them; time from −1 to 1 along the flight.
class DepthCurve {
 public:
  DepthCurve(double begin, double end) : middle_(0.5 * (begin + end)), half_(0.5 * (end - begin)) {}

  /// Sizes are off by shares of themselves, so depths weigh by their squares.
  void fit(const std::vector<Size>& sizes) {
    Mat3 normal = Mat3::Zero();
    Vec3 right = Vec3::Zero();
    for (const Size& s : sizes) {
      const Vec3 row = row_at(s.time) / s.depth;
      normal += row * row.transpose();
      right += row;
    }
    const Eigen::LDLT<Mat3> solver(normal);
    curve_ = solver.solve(right);
    cofactor_ = solver.solve(Mat3::Identity());
  }
  double at(double time) const { return row_at(time).dot(curve_); }
  /// Logarithm of the depth at the end over that at the beginning, and its deviation where sizes have the deviation 1.
  std::pair<double, double> change() const {
    const Vec3 first(1.0, -1.0, 1.0), last(1.0, 1.0, 1.0);
    const double begin = first.dot(curve_), end = last.dot(curve_);
    const Vec3 slope = last / end - first / begin;
    return {std::log(end / begin), std::sqrt(slope.dot(cofactor_ * slope))};
  }

 private:
  Vec3 row_at(double time) const {
    const double x = (time - middle_) / half_;
    return {1.0, x, x * x};
  }
  double middle_, half_;
  Vec3 curve_ = Vec3::Zero();
  Mat3 cofactor_ = Mat3::Zero();
};

/// How much wider the mean of errors in a row, sorted by time, spreads than if each were by chance: a first-order autoregression's.
double lengthening(const std::vector<double>& errors) {
  constexpr double kMost = 0.9;  // correlation of neighbours
  double squares = 0.0, products = 0.0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    squares += errors[i] * errors[i];
    if (i > 0) products += errors[i] * errors[i - 1];
  }
  const double alike = squares > 0.0 ? std::clamp(products / squares, 0.0, kMost) : 0.0;
  return std::sqrt((1.0 + alike) / (1.0 - alike));
}

std::optional<SizeTrend> trend_of(std::vector<Size> sizes, double pixels, int body, bool after) {
  if (sizes.size() < kFewest) return std::nullopt;
  const auto [first, last] = std::minmax_element(sizes.begin(), sizes.end(), [](const Size& a, const Size& b) { return a.time < b.time; });
  const double begin = first->time, end = last->time;
  if (begin >= end) return std::nullopt;
  DepthCurve curve(begin, end);
  const auto off = [&](const Size& s) { return std::abs(curve.at(s.time) / s.depth - 1.0); };
  double sigma = 0.0;
  for (int round = 0; round < 2; ++round) {
    curve.fit(sizes);
    std::vector<double> all;
    for (const Size& s : sizes) all.push_back(off(s));
    sigma = 1.4826 * median(all);
    std::vector<Size> near;
    for (const Size& s : sizes)
      if (off(s) <= kOutlier * sigma + 1e-9) near.push_back(s);
    if (near.size() < kFewest) break;
    sizes = near;
  }
  std::vector<double> diameters, errors;
  for (const Size& s : sizes) diameters.push_back(s.diameter), errors.push_back(curve.at(s.time) / s.depth - 1.0);
  const auto [change, spread] = curve.change();
  if (!std::isfinite(change)) return std::nullopt;
  return SizeTrend{body, after, begin, end, change, std::hypot(sigma * spread * lengthening(errors), kSystematic, pixels / median(diameters))};
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
          sizes.push_back({p.time, p.depth, problem.camera.fx * solid.mass.extent / p.depth});
      if (const auto trend = trend_of(std::move(sizes), problem.filmed ? kFilmedPixels : kTrackedPixels, body, after)) trends.push_back(*trend);
    }
  }
  return trends;
}

}  // namespace unseen::collision
