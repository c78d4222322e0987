// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <vector>

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

/// Whether a sample lies between two parallel cuts: far thinner than it is wide, and evenly spread over that thickness wherever one looks. Noise about a surface heaps
/// up in its middle, coordinates that are rounded come in steps, and ground and roofs are thinner at each place than as a whole.
bool is_slice(const Survey& survey, int axis) {
  constexpr double kThin = 0.01;            // of the lesser of the other two extents
  constexpr double kEven = 1.8, kOff = 0.2;  // kurtosis: of a uniform distribution, and how far off it may be; of a normal one it is 3, of round bars 1.5, of two levels 1
  constexpr std::size_t kSteps = 8;         // of rounded coordinates, at least
  constexpr double kWhole = 0.8;            // of the variance is seen within single cells
  constexpr double kNarrow = 0.5;           // of the thickness, cells are wide: what slopes by 45° fills half of it there. Wider ones
  constexpr double kLeastWide = 1e-6, kMostWide = 1.0 / 16;  // from the one to the other share of the extent
  constexpr double kFewest = 3, kMany = 0.5;  // until so many points are in a cell, for this share of them
  const Vec3 extent = survey.high - survey.low;
  if (extent[axis] > kThin * std::min(extent[(axis + 1) % 3], extent[(axis + 2) % 3])) return false;
  struct Sums {
    double count = 0, first = 0, second = 0;
    double scatter() const { return second - first * first / count; }
  };
  Sums all;
  const auto add = [&](const Vec3& p, Sums& sums) {
    const double height = (p - survey.low)[axis] / extent[axis];
    ++sums.count, sums.first += height, sums.second += height * height;
  };
  for (const Vec3& p : survey.sample) add(p, all);
  std::vector<double> heights;
  for (const Vec3& p : survey.sample) heights.push_back(p[axis]);
  std::sort(heights.begin(), heights.end());
  if (static_cast<std::size_t>(std::unique(heights.begin(), heights.end()) - heights.begin()) <= kSteps) return false;
  double within = 0, counted = 0;
  for (double edge = std::max(kNarrow * extent[axis], kLeastWide * survey.extent()), points = 0; points < kMany * all.count && edge < 2 * kMostWide * survey.extent(); edge *= 2) {
    KeyTable cells;
    std::vector<Sums> in_cell;
    for (const Vec3& p : survey.sample) {
      const Vec3 at = (p - survey.low) / edge;
      const std::size_t cell = cells.insert({static_cast<std::int32_t>(at[(axis + 1) % 3]), static_cast<std::int32_t>(at[(axis + 2) % 3]), 0});
      if (cell == in_cell.size()) in_cell.emplace_back();
      add(p, in_cell[cell]);
    }
    within = counted = points = 0;
    for (const Sums& sums : in_cell)
      if (sums.count >= kFewest) within += sums.scatter(), counted += sums.count - 1, points += sums.count;
  }
  double fourth = 0;
  for (const Vec3& p : survey.sample) fourth += std::pow((p - survey.low)[axis] / extent[axis] - all.first / all.count, 4);
  const double variance = all.scatter() / all.count;
  return std::abs(fourth / all.count - kEven * variance * variance) < kOff * variance * variance && within > kWhole * variance * counted && counted > 0;
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
