// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/plain_colors.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cuboids/objects/color_regions.h"
#include "cuboids/objects/upright_box.h"
#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr double kEnd = 0.02;         // quantile of the points, that counts as the end of a region
constexpr double kRoomSigmas = 3.0;   // about an extent
constexpr double kWithin = 0.9;       // of a region's points, in the extent of another one
constexpr double kInLine = 0.2;       // of the lesser size, by which the ends of pieces of one thing differ at most
constexpr double kBand = 0.6;         // of the lesser size, that a band between them is long at most
constexpr double kMostOff = 0.15;     // of a part's points, that are not on the sides of the boxes of its regions
constexpr std::size_t kSamplesOfRegion = 400;

/// Along and across the front of something, and up.
struct Directions {
  Vec2 along;
  Vec3 operator()(const Vec3& p) const { return {along.dot(p.head<2>()), along.x() * p.y() - along.y() * p.x(), p.z()}; }
};

/// As far as points reach in some directions.
struct Extent {
  Vec3 low, high;
  double room = 0;  ///< m

  bool holds(const Vec3& p) const { return (p.array() >= low.array() - room).all() && (p.array() <= high.array() + room).all(); }
  bool has_on_side(const Vec3& p) const { return holds(p) && std::min((p - low).cwiseAbs().minCoeff(), (p - high).cwiseAbs().minCoeff()) < room; }
};

Extent extent_of(const Observation& seen, const Directions& directions, std::span<const int> points) {
  Extent extent;
  std::vector<Vec3> places;
  for (const int i : points) places.push_back(directions(seen.points[i]));
  for (int k = 0; k < 3; ++k) {
    std::vector<double> place;
    for (const Vec3& p : places) place.push_back(p[k]);
    extent.low[k] = quantile(place, kEnd);
    extent.high[k] = quantile(std::move(place), 1.0 - kEnd);
  }
  extent.room = kRoomSigmas * seen.graph.sigma[points.front()];
  return extent;
}

double share_within(const Observation& seen, const Directions& directions, const Extent& extent, std::span<const int> points) {
  const auto within = std::count_if(points.begin(), points.end(), [&](int i) { return extent.holds(directions(seen.points[i])); });
  return static_cast<double>(within) / static_cast<double>(points.size());
}

/// Whether one goes on, beyond a band, where the other ends: along two directions they begin or end alike, and along the third they are apart by much less
/// than either is long.
bool goes_on(const Extent& a, const Extent& b) {
  const Vec3 low = (a.low - b.low).cwiseAbs(), high = (a.high - b.high).cwiseAbs(), size = (a.high - a.low).cwiseMin(b.high - b.low);
  const Vec3 gap = a.low.cwiseMax(b.low) - a.high.cwiseMin(b.high);
  int alike = 0, apart = 0;
  for (int k = 0; k < 3; ++k) {
    if (gap[k] > 0.0) apart += gap[k] < kBand * size[k];
    else alike += std::min(low[k], high[k]) < kInLine * size[k] + a.room;
  }
  return alike == 2 && apart == 1;
}

/// The regions that lie between two, as a print across one thing of their colour; none if others reach in.
std::vector<std::size_t> bands_between(const Observation& seen, const Directions& directions, const std::vector<ColorRegion>& regions,
                                       const std::vector<Extent>& extents, std::size_t a, std::size_t b) {
  if (are_other_tints(regions[a].tint, regions[b].tint) || !goes_on(extents[a], extents[b])) return {};
  const Extent both{extents[a].low.cwiseMin(extents[b].low), extents[a].high.cwiseMax(extents[b].high), extents[a].room};
  std::vector<std::size_t> between;
  for (std::size_t c = 0; c < regions.size(); ++c) {
    if (c == a || c == b) continue;
    const double share = share_within(seen, directions, both, regions[c].points);
    if (share > kWithin) between.push_back(c);
    else if (share > 1.0 - kWithin) return {};
  }
  return between;
}

/// Merges one print with what it is on; whether there was one.
bool merge_print(const Observation& seen, const Directions& directions, std::vector<ColorRegion>& regions) {
  std::vector<Extent> extents;
  for (const ColorRegion& region : regions) extents.push_back(extent_of(seen, directions, region.points));
  for (std::size_t a = 0; a < regions.size(); ++a)
    for (std::size_t b = 0; b < regions.size(); ++b)
      if (regions[b].points.size() < regions[a].points.size() && share_within(seen, directions, extents[a], regions[b].points) > kWithin) {
        absorb(regions[a], regions[b]);
        return true;
      }
  for (std::size_t a = 0; a < regions.size(); ++a)
    for (std::size_t b = a + 1; b < regions.size(); ++b) {
      const std::vector<std::size_t> bands = bands_between(seen, directions, regions, extents, a, b);
      if (bands.empty()) continue;
      absorb(regions[a], regions[b]);
      for (const std::size_t c : bands) absorb(regions[a], regions[c]);
      return true;
    }
  return false;
}

std::vector<Sample> some_samples(const Observation& seen, std::span<const int> points) {
  std::vector<Sample> samples;
  const std::size_t step = points.size() / kSamplesOfRegion + 1;
  for (std::size_t k = 0; k < points.size(); k += step)
    if (const int i = points[k]; !seen.graph.normals[i].isZero()) samples.push_back({seen.points[i], seen.graph.normals[i], seen.graph.sigma[i]});
  return samples;
}

/// How many of a region's points are not on the sides of the upright box around it.
double off_box(const Observation& seen, const ColorRegion& region) {
  const auto count = static_cast<double>(region.points.size());
  const std::vector<Sample> samples = some_samples(seen, region.points);
  if (samples.empty()) return count;
  const Directions directions{across_front(samples)};
  const Extent extent = extent_of(seen, directions, region.points);
  const auto on = std::count_if(samples.begin(), samples.end(), [&](const Sample& s) { return extent.has_on_side(directions(s.p)); });
  return count * (1.0 - static_cast<double>(on) / static_cast<double>(samples.size()));
}

/// Of each support that was seen, in the middle.
std::vector<Tint> tints_of_supports(const Observation& seen) {
  std::vector<std::array<std::vector<double>, 2>> values(seen.supports.size());
  for (std::size_t i = 0; i < seen.points.size(); ++i)
    for (int k = 0; seen.support_of_point[i] >= 0 && k < 2; ++k) values[seen.support_of_point[i]][k].push_back(seen.tints[seen.pixel_of_point[i]][k]);
  std::vector<Tint> tints;
  for (auto& [a, b] : values)
    if (!a.empty()) tints.emplace_back(median(std::move(a)), median(std::move(b)));
  return tints;
}

/// Whether two regions have all the colours that there are, two or more: what parts them is printed on them too, as on a checked box.
bool are_one_print(const std::vector<ColorRegion>& regions) {
  const auto has = [](const ColorRegion& region, const Tint& tint) {
    return !are_other_tints(region.tint, tint) || std::any_of(region.others.begin(), region.others.end(), [&](const Tint& own) { return !are_other_tints(own, tint); });
  };
  return 2 <= std::count_if(regions.begin(), regions.end(), [&](const ColorRegion& region) {
    const bool is_printed = std::any_of(region.others.begin(), region.others.end(), [&](const Tint& own) { return are_other_tints(region.tint, own); });
    return is_printed && std::all_of(regions.begin(), regions.end(), [&](const ColorRegion& other) { return has(region, other.tint); });
  });
}

/// The boxes of plain colours that a part consists of; none if it does not. What has the colour of a support may be that: the picture may be shifted
/// against the depth image, or of another scale.
std::vector<ColorRegion> plain_boxes(const RgbdFrame& frame, const Observation& seen, std::span<const Tint> supports, std::span<const int> part, std::vector<int>& scratch) {
  std::vector<ColorRegion> regions = color_regions(frame, seen, part, scratch);
  for (const ColorRegion& region : regions)
    if (std::any_of(supports.begin(), supports.end(), [&](const Tint& tint) { return (region.tint - tint).norm() < kSameTint; })) return {};
  const std::vector<Sample> samples = some_samples(seen, part);
  if (regions.size() < 2 || samples.empty()) return {};
  const Directions directions{across_front(samples)};
  while (merge_print(seen, directions, regions)) std::erase_if(regions, [](const ColorRegion& region) { return region.points.empty(); });
  if (regions.size() < 2 || are_one_print(regions)) return {};
  double off = 0;
  for (const ColorRegion& region : regions) off += off_box(seen, region);
  if (off > kMostOff * static_cast<double>(part.size())) return {};
  return regions;
}

}  // namespace

void find_plain_colors(const RgbdFrame& frame, const Observation& seen, const std::vector<std::vector<int>>& parts, Stacks& stacks, const Context& context) {
  if (seen.tints.empty()) return;
  const std::vector<Tint> supports = tints_of_supports(seen);
  std::vector<int> scratch(seen.points.size(), -2);
  int stack = *std::max_element(stacks.stack_of_piece.begin(), stacks.stack_of_piece.end()) + 1;
  for (const std::vector<int>& part : parts) {
    context.check();
    const std::vector<ColorRegion> boxes = plain_boxes(frame, seen, supports, part, scratch);
    if (boxes.empty()) continue;
    for (const int i : part) stacks.piece_of_point[i] = 0;
    for (const ColorRegion& box : boxes) {
      const auto piece = static_cast<int>(stacks.stack_of_piece.size());
      for (const int i : box.points) stacks.piece_of_point[i] = piece;
      for (const int i : box.rim) stacks.piece_of_point[i] = piece;
      stacks.stack_of_piece.push_back(stack);
    }
    ++stack;
  }
}

}  // namespace unseen::cuboids
