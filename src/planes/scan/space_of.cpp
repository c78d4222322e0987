// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
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

}  // namespace

Space space_of(const Survey& survey, bool declared_2d) {
  Space space;
  const Vec3 extent = survey.high - survey.low;
  if (declared_2d) space.flat_axis = Vec3::UnitZ();
  for (int a = 2; a >= 0 && !space.is_2d(); --a)
    if (extent[a] == 0.0 && extent[(a + 1) % 3] > 0.0 && extent[(a + 2) % 3] > 0.0 && !fills_area(survey, a))
      space.flat_axis = Vec3::Unit(a);
  if (space.is_2d()) space.flat_at = space.flat_axis->dot(survey.low);
  return space;
}

}  // namespace unseen::planes
