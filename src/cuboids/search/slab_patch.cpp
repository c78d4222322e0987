// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/search/slab_patch.h"

#include <algorithm>
#include <cmath>

#include "cuboids/search/hypotheses.h"

namespace unseen::cuboids {
namespace {

constexpr double kThin = 0.25;       // of the other sizes
constexpr double kWithin = 0.8;      // of a patch's volume
constexpr double kTooLow = 0.3;      // of a box's height
constexpr double kEqualTops = 1e-6;  // m: the overlap is one of the bottom and no other side

}  // namespace

Span span_along(const OrientedBox& box, const Vec3& axis) {
  const double middle = axis.dot(box.center), half = (box.axes.transpose() * axis).cwiseAbs().dot(box.half_size);
  return {middle - half, middle + half};
}

bool are_one_slab(const OrientedBox& a, const OrientedBox& b, double tolerance) {
  int thin = 0;
  a.half_size.minCoeff(&thin);
  if (a.half_size[thin] > kThin * std::min(a.half_size[(thin + 1) % 3], a.half_size[(thin + 2) % 3])) return false;
  const Span of_a = span_along(a, a.axes.col(thin)), of_b = span_along(b, a.axes.col(thin));
  const double within = std::min(tolerance, 0.5 * std::min(of_a.high - of_a.low, of_b.high - of_b.low));  // what lies on a board is no part of it
  return std::abs(of_a.low - of_b.low) <= within && std::abs(of_a.high - of_b.high) <= within;
}

bool is_patch_of(const OrientedBox& patch, const OrientedBox& slab, double tolerance) {
  OrientedBox around = slab;
  around.half_size.array() += tolerance;
  return are_one_slab(slab, patch, tolerance) && share_inside({}, patch, around, 0.0) >= kWithin;
}

bool stands_too_low(const OrientedBox& box, const OrientedBox& below, double depth, double tolerance) {
  const Span height = span_along(box, Vec3::UnitZ()), under = span_along(below, Vec3::UnitZ());
  return std::abs(height.low + depth - under.high) < kEqualTops && height.low > under.low - tolerance && depth < kTooLow * (height.high - height.low);
}

}  // namespace unseen::cuboids
