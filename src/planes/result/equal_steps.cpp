// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/result/equal_steps.h"

#include <algorithm>
#include <cmath>

#include "unseen/core/quantile.h"

namespace unseen::planes {
namespace {

constexpr double kAlike = 0.25;       // of the scale: offsets that are closer are equal
constexpr double kNoise = 2.0;        // if they are closer than so many times the noise of the planes, too,
constexpr double kLeast = 0.005;      // or than this share of the scale
constexpr double kSmallest = 1.0;     // of the scale: a step is larger
constexpr double kByChance = 0.05;    // rows as long that a direction may be expected to have by chance
constexpr double kRunByChance = 0.2;  // runs as long, of planes that follow each other

/// Planes at equal steps.
Spacing spacing_of(const std::vector<int>& planes, const Arrangement& result) {
  const auto offset = [&](std::size_t i) { return result.planes[planes[i]].plane.offset; };
  const std::size_t last = planes.size() - 1;
  Spacing s;
  s.planes = planes;
  s.step = (offset(last) - offset(0)) / static_cast<double>(last);
  double sum = 0;
  for (std::size_t i = 0; i <= last; ++i) sum += std::pow(offset(i) - offset(0) - s.step * static_cast<double>(i), 2);
  s.rms = std::sqrt(sum / static_cast<double>(planes.size()));
  return s;
}

/// How many rows of `length` planes chance makes, of so many that begin with two: each further place has a plane if one lies within the tolerance of it.
double rows_by_chance(double beginnings, double length, double tolerance, double planes, double span) {
  return beginnings * std::pow(std::min(1.0, 2.0 * tolerance * planes / span), length - 2.0);
}

/// Runs of at least three planes, each a step farther than the one before, of which so many may not be expected by chance.
void find_steps(const std::vector<int>& by_offset, double tolerance, Arrangement& result) {
  const auto offset = [&](std::size_t i) { return result.planes[by_offset[i]].plane.offset; };
  for (std::size_t first = 0; first + 2 < by_offset.size();) {
    std::size_t last = first + 1;
    const double step = offset(last) - offset(first);
    while (step > kSmallest * result.scale && last + 1 < by_offset.size() &&
           std::abs(offset(last + 1) - offset(last) - step) < tolerance)
      ++last;
    const auto length = static_cast<double>(last - first + 1), all = static_cast<double>(by_offset.size());
    if (last < first + 2 || rows_by_chance(all - 2.0, length, tolerance, length, offset(last) - offset(first)) > kRunByChance) {
      ++first;
      continue;
    }
    result.spacing.push_back(spacing_of({by_offset.begin() + first, by_offset.begin() + last + 1}, result));
    first = last;
  }
}

/// Rows of planes at equal steps with others between them, as the sides of windows: the longest first, each plane in one, and none of which so many may be
/// expected by chance.
void find_rows(const std::vector<int>& by_offset, double tolerance, Arrangement& result) {
  const std::size_t count = by_offset.size();
  if (count < 4) return;
  std::vector<double> offsets;
  for (const int p : by_offset) offsets.push_back(result.planes[p].plane.offset);
  const auto by_chance = [&](const std::vector<std::size_t>& row) {
    return rows_by_chance(0.5 * static_cast<double>(count * count), static_cast<double>(row.size()), tolerance, static_cast<double>(row.back() - row.front() + 1),
                          offsets[row.back()] - offsets[row.front()]);
  };
  std::vector<char> taken(count, 0);
  const auto row_from = [&](std::size_t first, std::size_t second) {
    std::vector<std::size_t> row = {first, second};
    const double step = offsets[second] - offsets[first];
    for (;;) {
      const double next = offsets[row.back()] + step;
      double least = tolerance;
      std::size_t nearest = count;
      for (std::size_t i = std::lower_bound(offsets.begin(), offsets.end(), next - tolerance) - offsets.begin(); i < count && offsets[i] < next + tolerance; ++i)
        if (const double off = std::abs(offsets[i] - next); !taken[i] && off < least) least = off, nearest = i;
      if (nearest == count) return row;
      row.push_back(nearest);
    }
  };
  for (;;) {
    std::vector<std::size_t> best;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = i + 1; k < count && !taken[i]; ++k)
        if (!taken[k] && offsets[k] - offsets[i] > kSmallest * result.scale)
          if (std::vector<std::size_t> row = row_from(i, k); row.size() > best.size()) best = std::move(row);
    if (best.size() < 4 || by_chance(best) > kByChance) return;
    std::vector<int> planes;
    for (const std::size_t i : best) planes.push_back(by_offset[i]), taken[i] = 1;
    const auto holds = [](const std::vector<int>& all, const std::vector<int>& some) {
      return std::all_of(some.begin(), some.end(), [&](int plane) { return std::find(all.begin(), all.end(), plane) != all.end(); });
    };
    if (std::any_of(result.spacing.begin(), result.spacing.end(), [&](const Spacing& s) { return holds(s.planes, planes); })) continue;
    std::erase_if(result.spacing, [&](const Spacing& s) { return holds(planes, s.planes); });
    result.spacing.push_back(spacing_of(planes, result));
  }
}

}  // namespace

double step_tolerance(const Arrangement& result, double rounding) {
  std::vector<double> noise;
  for (const ArrangedPlane& p : result.planes) noise.push_back(p.rms);
  return std::min(std::max({kNoise * median(std::move(noise)), kLeast * result.scale, rounding}), kAlike * result.scale);
}

void find_equal_steps(const std::vector<int>& by_offset, double tolerance, Arrangement& result) {
  find_steps(by_offset, tolerance, result);
  find_rows(by_offset, tolerance, result);
}

}  // namespace unseen::planes
