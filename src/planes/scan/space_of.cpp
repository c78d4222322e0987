// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "planes/scan/scale.h"

namespace unseen::planes {
namespace {

/// Whether a flat sample fills an area rather than lines: its box-counting dimension, from cells of an eighth
/// of the extent down to a sixty-fourth or to eight points each.
bool fills_area(const Survey& survey, int axis) {
  constexpr double kPointsPerCell = 8, kFilled = 1.7;
  const auto occupied = [&](int cells) {
    const double edge = survey.extent() * (1.0 + 1e-9) / cells;
    KeyTable table;
    for (const Vec3& p : survey.sample) {
      const Vec3 at = (p - survey.low) / edge;
      table.insert(
          {static_cast<std::int32_t>(at[(axis + 1) % 3]), static_cast<std::int32_t>(at[(axis + 2) % 3]), 0});
    }
    return static_cast<double>(table.keys().size());
  };
  double coarse = occupied(8);
  for (int cells = 16; cells <= 64; cells *= 2) {
    const double fine = occupied(cells);
    if (cells > 16 && fine * kPointsPerCell > static_cast<double>(survey.sample.size())) break;
    if (std::log2(fine / coarse) < kFilled) return false;
    coarse = fine;
  }
  return true;
}

/// Whether a sample lies between two parallel cuts: far thinner than it is wide, and as dense at one height as at another wherever one looks, while noise about a
/// surface heaps up in its middle.
bool is_slice(const Survey& survey, int axis) {
  constexpr double kThin = 0.005;    // of the lesser of the other two extents
  constexpr double kUniform = 2.2;   // kurtosis: 1.8 of a uniform distribution, 3 of a normal one
  constexpr double kSlanting = 0.2;  // of the variance: more is a surface that falls
  const Vec3 extent = survey.high - survey.low;
  if (extent[axis] > kThin * std::min(extent[(axis + 1) % 3], extent[(axis + 2) % 3])) return false;
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : survey.sample) mean += p / static_cast<double>(survey.sample.size());
  Mat3 covariance = Mat3::Zero();  // of the other two coordinates, and this one
  double fourth = 0;
  const auto about = [&](const Vec3& p) { return Vec3((p - mean)[(axis + 1) % 3], (p - mean)[(axis + 2) % 3], (p - mean)[axis]); };
  for (const Vec3& p : survey.sample) {
    const Vec3 d = about(p);
    covariance += d * d.transpose();
    fourth += std::pow(d.z(), 4);
  }
  const Vec2 across = covariance.topRightCorner<2, 1>();
  const double variance = covariance(2, 2), slanting = across.dot(covariance.topLeftCorner<2, 2>().ldlt().solve(across));
  return slanting < kSlanting * variance && fourth * static_cast<double>(survey.sample.size()) < kUniform * variance * variance;
}

}  // namespace

Space space_of(const Survey& survey, bool declared_2d) {
  Space space;
  const Vec3 extent = survey.high - survey.low;
  if (declared_2d) space.flat_axis = Vec3::UnitZ();
  for (int a = 2; a >= 0 && !space.is_2d(); --a)
    if ((extent[a] == 0.0 || is_slice(survey, a)) && extent[(a + 1) % 3] > 0.0 && extent[(a + 2) % 3] > 0.0 && !fills_area(survey, a))
      space.flat_axis = Vec3::Unit(a);
  if (space.is_2d()) space.flat_at = 0.5 * space.flat_axis->dot(survey.low + survey.high);
  return space;
}

}  // namespace unseen::planes
