// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/stack_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "cuboids/objects/outline_steps.h"
#include "cuboids/objects/upright_box.h"
#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr std::size_t kCoarse = 400, kFine = 2000;  // samples of a part: to see whether it is a stack, and to place its levels
constexpr std::size_t kFewestLevelSamples = 24;    // on either side of a level …
constexpr double kSmallestShare = 0.06;            // … and of the samples that are cut
constexpr double kLeastHeight = 0.02, kLeastHeightSigmas = 10.0;  // m, of what stands on or under another
constexpr int kFirstLevels = 20, kFinerLevels = 4, kPlaceRounds = 3;
constexpr double kLeastExplained = 0.08;  // of the points, that a level must explain more …
constexpr double kLeastShare = 0.2;       // … and of those that one box leaves unexplained
constexpr double kMostLeft = 0.25;        // of the points, that a stack may leave unexplained …
constexpr double kMostOfOne = 0.5;        // … and of those that one box leaves so
constexpr double kMostOfStepped = 0.8;    // … where the outline steps at its levels
constexpr double kLooksDown = -0.7;
constexpr double kFront = 0.7;  // of a normal, at most along another direction
constexpr double kFar = 1e9;

/// Samples in order along a direction.
std::vector<Sample> along(std::span<const Sample> samples, const Vec3& direction) {
  std::vector<Sample> sorted(samples.begin(), samples.end());
  for (Sample& s : sorted) s.at = direction.dot(s.p);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Sample& a, const Sample& b) { return a.at < b.at; });
  return sorted;
}

/// Of samples in order.
std::span<const Sample> between(std::span<const Sample> samples, double low, double high) {
  const auto lower = [&](double at) { return std::lower_bound(samples.begin(), samples.end(), at, [](const Sample& s, double value) { return s.at < value; }); };
  return {lower(low), lower(high)};
}

/// A level, and what boxes below and above it leave unexplained. In a row of boxes a wall between two, and "below" is on its one side.
struct StackLevel {
  double at = 0, left = std::numeric_limits<double>::infinity();
};

/// The level that leaves least; infinitely much if there is none.
StackLevel best_level(std::span<const Sample> samples) {
  const double low = samples.front().at, high = samples.back().at;
  const std::size_t fewest = std::max(kFewestLevelSamples, static_cast<std::size_t>(kSmallestShare * static_cast<double>(samples.size())));
  const double height = std::max(kLeastHeight, kLeastHeightSigmas * samples[samples.size() / 2].sigma);
  StackLevel best;
  for (int k = 1; k < kFirstLevels; ++k) {
    const double at = low + (high - low) * k / kFirstLevels;
    const auto below = between(samples, -kFar, at), above = between(samples, at, kFar);
    if (at - low < height || high - at < height || below.size() < fewest || above.size() < fewest) continue;
    const double left = unexplained(below) + unexplained(above);
    if (left < best.left) best = {at, left};
  }
  return best;
}

/// Levels that cut some samples into boxes, from below; none where one box does nearly as well.
std::vector<double> split(std::span<const Sample> samples) {
  const double count = static_cast<double>(samples.size()), one = unexplained(samples);
  if (samples.size() < 2 * kFewestLevelSamples || one < kLeastExplained * count) return {};
  const StackLevel level = best_level(samples);
  if (one - level.left < std::max(kLeastExplained * count, kLeastShare * one)) return {};
  std::vector<double> levels = split(between(samples, -kFar, level.at));
  levels.push_back(level.at);
  const std::vector<double> above = split(between(samples, level.at, kFar));
  levels.insert(levels.end(), above.begin(), above.end());
  return levels;
}

/// Moves each level to where the boxes on either side explain most.
void place(std::vector<double>& levels, std::span<const Sample> samples) {
  if (samples.empty()) return;
  double step = (samples.back().at - samples.front().at) / kFirstLevels;
  for (int round = 0; round < kPlaceRounds; ++round) {
    step /= kFinerLevels;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      const double low = k > 0 ? levels[k - 1] : -kFar, high = k + 1 < levels.size() ? levels[k + 1] : kFar, middle = levels[k];
      double least = std::numeric_limits<double>::infinity();
      for (int move = -kFinerLevels; move <= kFinerLevels; ++move) {
        const double z = middle + step * move;
        if (z <= low || z >= high) continue;
        const auto below = between(samples, low, z), above = between(samples, z, high);
        if (std::min(below.size(), above.size()) < kFewestLevelSamples) continue;
        if (const double left = unexplained(below) + unexplained(above); left < least) least = left, levels[k] = z;
      }
    }
  }
}

/// What boxes between levels leave unexplained.
double left_between(std::span<const Sample> samples, const std::vector<double>& levels) {
  double left = unexplained(between(samples, levels.back(), kFar)), low = -kFar;
  for (const double level : levels) left += unexplained(between(samples, low, level)), low = level;
  return left;
}

/// The levels between which a stack's boxes are; none if it is not much better explained so than by one box, or by one body that leans.
std::vector<double> levels_of(std::span<const Sample> samples) {
  std::vector<double> levels = split(samples);
  if (levels.empty()) return {};
  place(levels, samples);
  // The first cuts of a tower may lie within a box: whatever one box between the next levels explains as well is one.
  levels.insert(levels.begin(), -kFar);
  levels.push_back(kFar);
  for (std::size_t k = 1; k + 1 < levels.size();) {
    const auto both = between(samples, levels[k - 1], levels[k + 1]);
    const double gain = unexplained(both) - unexplained(between(samples, levels[k - 1], levels[k])) - unexplained(between(samples, levels[k], levels[k + 1]));
    if (gain < kLeastExplained * static_cast<double>(both.size())) levels.erase(levels.begin() + static_cast<std::ptrdiff_t>(k));
    else ++k;
  }
  levels = {levels.begin() + 1, levels.end() - 1};
  if (levels.empty()) return {};
  const double most = std::min(kMostLeft * static_cast<double>(samples.size()), kMostOfOne * std::min(unexplained(samples), unexplained_leaning(samples)));
  return left_between(samples, levels) > most ? std::vector<double>() : levels;
}

/// Where a part is cut, in order along a direction.
struct Cuts {
  Vec3 direction = Vec3::UnitZ();
  std::vector<double> at;
};

/// Whether the tops or the fronts of what is on either side of a wall are apart; those of slices of something round are not.
bool steps_at(double wall, std::span<const Sample> row, const Vec3& direction) {
  constexpr double kBeside = 0.04;  // m
  std::array<std::vector<double>, 2> heights, fronts;
  for (const Sample& s : between(row, wall - kBeside, wall + kBeside)) {
    heights[s.at > wall].push_back(s.p.z());
    if (std::abs(s.n.z()) < kFront && std::abs(s.n.dot(direction)) < kFront) fronts[s.at > wall].push_back(direction.cross(Vec3::UnitZ()).dot(s.p));
  }
  const double least = std::max(kLeastHeight, kLeastHeightSigmas * row[row.size() / 2].sigma);
  const auto apart = [&](std::array<std::vector<double>, 2>& places, double share) {
    return !places[0].empty() && !places[1].empty() && std::abs(quantile(places[0], share) - quantile(places[1], share)) > least;
  };
  return apart(heights, 0.98) || apart(fronts, 0.5);
}

/// Boxes side by side; no cuts where these do not explain the samples much better than boxes upon each other, which leave `left`.
Cuts row_of(std::span<const Sample> samples, double left) {
  const Vec2 across = across_front(samples);
  Cuts row;
  for (const Vec3& direction : {Vec3(across.x(), across.y(), 0), Vec3(-across.y(), across.x(), 0)}) {
    const std::vector<Sample> sorted = along(samples, direction);
    const std::vector<double> at = levels_of(sorted);
    if (at.empty() || !std::all_of(at.begin(), at.end(), [&](double wall) { return steps_at(wall, sorted, direction); })) continue;
    const double left_so = left_between(sorted, at);
    if (left - left_so < std::max(kLeastExplained * static_cast<double>(samples.size()), kMostOfOne * left)) continue;
    row = {direction, at};
    left = left_so;
  }
  return row;
}

/// Levels at which the outline steps; none where boxes between them do not explain the samples better than one does.
std::vector<double> outline_levels(const Observation& seen, const std::vector<int>& part, std::span<const Sample> samples) {
  std::vector<double> levels = outline_steps(seen, part, across_front(samples));
  if (levels.empty()) return {};
  if (left_between(samples, levels) > std::min(kMostLeft * static_cast<double>(samples.size()), kMostOfStepped * unexplained(samples))) return {};
  return levels;
}

/// At most so many points of a part, in order of height. What looks down tells of no level.
std::vector<Sample> samples_of(const Observation& seen, const std::vector<int>& points, std::size_t most) {
  std::vector<Sample> samples;
  const std::size_t step = points.size() / most + 1;
  for (std::size_t k = 0; k < points.size(); k += step) {
    const std::size_t jittered = std::min(k + k / step * 2654435761u % step, points.size() - 1);  // rows of an image may be as long as a step
    const int i = points[jittered];
    const Vec3& n = seen.graph.normals[i];
    if (!n.isZero() && n.z() > kLooksDown) samples.push_back({seen.points[i], n, seen.graph.sigma[i]});
  }
  return along(samples, Vec3::UnitZ());
}

}  // namespace

Stacks no_stacks(const Observation& seen) { return {std::vector<int>(seen.points.size(), 0), {-1}}; }

Stacks find_stacks(const Observation& seen, const std::vector<std::vector<int>>& parts, const Context& context) {
  Stacks stacks = no_stacks(seen);
  int stack = 0;
  for (const std::vector<int>& part : parts) {
    context.check();
    const std::vector<Sample> coarse = samples_of(seen, part, kCoarse);
    if (coarse.empty()) continue;
    Cuts cuts{Vec3::UnitZ(), levels_of(coarse)};
    const bool by_outline = cuts.at.empty();
    if (by_outline) cuts.at = outline_levels(seen, part, coarse);
    Cuts row = row_of(coarse, cuts.at.empty() ? unexplained(coarse) : left_between(coarse, cuts.at));
    const bool is_row = !row.at.empty();
    if (is_row) cuts = std::move(row);
    if (is_row || !by_outline) place(cuts.at, along(samples_of(seen, part, kFine), cuts.direction));
    if (cuts.at.empty()) continue;
    const auto first = static_cast<int>(stacks.stack_of_piece.size());
    for (const int i : part)
      stacks.piece_of_point[i] = first + static_cast<int>(std::upper_bound(cuts.at.begin(), cuts.at.end(), cuts.direction.dot(seen.points[i])) - cuts.at.begin());
    stacks.stack_of_piece.resize(stacks.stack_of_piece.size() + cuts.at.size() + 1, stack++);
  }
  return stacks;
}

}  // namespace unseen::cuboids
