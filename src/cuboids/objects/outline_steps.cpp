// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/outline_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr int kMostRows = 60, kFewestRows = 8;  // of a part; on either side of a step
constexpr double kRowSpacings = 2.0;            // of a row's height
constexpr std::size_t kFewestOfRow = 4;
constexpr double kRim = 0.03;                   // of a row's points at each end, flying pixels
constexpr double kFarOff = 0.02;                // m: a row that is farther off counts as so far
constexpr double kLeastStep = 0.015, kLeastStepSpacings = 3.0, kLeastStepScatters = 3.0;  // m
constexpr double kLeastRise = 0.02;             // m, of what stands on or under another
constexpr double kMostOfWidth = 0.25;           // of the narrower side, of a step on one side only
constexpr double kMostOfOutline = 0.8;          // of what one outline leaves

/// Where a part begins and ends across, at a height, m.
struct Row {
  double z = 0;
  std::array<double, 2> ends{};
};

/// What rows have in common: where most of them begin and end, and how far the others are off in the mean, m.
struct Outline {
  std::array<double, 2> ends{}, off{};
  double left() const { return off[0] + off[1]; }
};

Outline outline_of(std::span<const Row> rows) {
  Outline all;
  for (int e = 0; e < 2; ++e) {
    std::vector<double> places;
    for (const Row& r : rows) places.push_back(r.ends[e]);
    all.ends[e] = quantile(places, 0.5);
    for (const Row& r : rows) all.off[e] += std::min(std::abs(r.ends[e] - all.ends[e]), kFarOff) / static_cast<double>(rows.size());
  }
  return all;
}

std::vector<Row> rows_of(const Observation& seen, const std::vector<int>& part, const Vec2& across, double spacing) {
  double low = 1e9, high = -1e9;
  for (const int i : part) low = std::min(low, seen.points[i].z()), high = std::max(high, seen.points[i].z());
  const double height = std::max(kRowSpacings * spacing, (high - low) / kMostRows);
  std::vector<std::vector<double>> places(static_cast<std::size_t>((high - low) / height) + 1);
  for (const int i : part) places[static_cast<std::size_t>((seen.points[i].z() - low) / height)].push_back(across.dot(seen.points[i].head<2>()));
  std::vector<Row> rows;
  for (std::size_t k = 0; k < places.size(); ++k)
    if (places[k].size() >= kFewestOfRow)
      rows.push_back({low + (static_cast<double>(k) + 0.5) * height, {quantile(places[k], kRim), quantile(places[k], 1.0 - kRim)}});
  return rows;
}

/// The row at which a step leaves least, if it is one.
std::size_t step_of(std::span<const Row> rows, double spacing) {
  const auto count = static_cast<double>(rows.size());
  const double one = outline_of(rows).left() * count;
  std::size_t best = 0;
  double least = kMostOfOutline * one;
  for (std::size_t k = kFewestRows; k + kFewestRows <= rows.size(); ++k) {
    const Outline below = outline_of(rows.first(k)), above = outline_of(rows.subspan(k));
    const double left = below.left() * static_cast<double>(k) + above.left() * (count - static_cast<double>(k));
    if (left < least) least = left, best = k;
  }
  if (best == 0 || rows[best].z - rows.front().z < kLeastRise || rows.back().z - rows[best].z < kLeastRise) return 0;
  const Outline below = outline_of(rows.first(best)), above = outline_of(rows.subspan(best));
  std::array<double, 2> step{};
  int steps = 0;
  for (int e = 0; e < 2; ++e) {
    step[e] = std::abs(above.ends[e] - below.ends[e]);
    steps += step[e] > std::max({kLeastStep, kLeastStepSpacings * spacing, kLeastStepScatters * std::max(above.off[e], below.off[e])});
  }
  const double width = std::min(below.ends[1] - below.ends[0], above.ends[1] - above.ends[0]);
  const bool is_step = steps == 2 || (steps == 1 && std::max(step[0], step[1]) < kMostOfWidth * width);
  return is_step ? best : 0;
}

void split(std::span<const Row> rows, double spacing, std::vector<double>& steps) {
  const std::size_t at = step_of(rows, spacing);
  if (at == 0) return;
  split(rows.first(at), spacing, steps);
  steps.push_back(0.5 * (rows[at - 1].z + rows[at].z));
  split(rows.subspan(at), spacing, steps);
}

}  // namespace

std::vector<double> outline_steps(const Observation& seen, const std::vector<int>& part, const Vec2& across) {
  std::vector<double> spacings;
  for (const int i : part) spacings.push_back(seen.graph.spacing[i]);
  const double spacing = quantile(std::move(spacings), 0.5);
  std::vector<double> steps;
  split(rows_of(seen, part, across, spacing), spacing, steps);
  return steps;
}

}  // namespace unseen::cuboids
