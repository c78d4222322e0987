// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/prints.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace unseen::cuboids {
namespace {

constexpr double kWithin = 0.9;      // of a region's points, in the extent of another one
constexpr double kFlush = 0.05, kInLine = 0.2;  // of a size, by which the ends of pieces of one thing differ at most
constexpr double kBandBetween = 0.6; // of the lesser size, that a band between them is long at most,
constexpr double kBroadBand = 2.0;   // or if both begin and end alike along a side of it,
constexpr double kAsLong = 0.1;      // and it is not as long as one of them, as the middle one of three equal boxes
constexpr std::size_t kFewestStripes = 4;
constexpr double kWidestStripe = 0.6;  // of the longer one of its other sides: cubes of two colours by turns are boxes
constexpr double kStripeGap = 0.01;  // m between stripes: what is blurred is of neither
constexpr double kThinEnd = 0.2;     // of a thing's length, that its end in another colour goes beyond it at most

/// Whether one goes on, beyond a band, where the other ends: along two directions they begin or end alike, and along the third they are apart by much less
/// than either is long; by more only if along one direction they begin and end alike.
bool goes_on(const DirectedExtent& a, const DirectedExtent& b) {
  const Vec3 low = (a.low - b.low).cwiseAbs(), high = (a.high - b.high).cwiseAbs(), size = (a.high - a.low).cwiseMin(b.high - b.low);
  const Vec3 gap = a.low.cwiseMax(b.low) - a.high.cwiseMin(b.high);
  int alike = 0, both_ends = 0, apart = 0;
  double between = 0;
  bool as_long = false;
  for (int k = 0; k < 3; ++k) {
    if (gap[k] > 0.0) {
      ++apart;
      between = gap[k] / size[k];
      as_long = std::abs(gap[k] / (a.high[k] - a.low[k]) - 1.0) < kAsLong || std::abs(gap[k] / (b.high[k] - b.low[k]) - 1.0) < kAsLong;
      continue;
    }
    alike += std::min(low[k], high[k]) < kInLine * size[k] + a.room;
    both_ends += std::max(low[k], high[k]) < kFlush * size[k] + a.room;
  }
  return alike == 2 && apart == 1 && (between < kBandBetween || (between < kBroadBand && both_ends >= 1 && !as_long));
}

/// Whether b is no more than an end of a in another colour, as a lid or a band around it: as long along two directions, and along the third hardly beyond it.
bool is_end_of(const DirectedExtent& a, const DirectedExtent& b) {
  const Vec3 low = a.low - b.low, high = b.high - a.high, size = a.high - a.low;
  int alike = 0, beyond = 0;
  for (int k = 0; k < 3; ++k) {
    if (std::max(std::abs(low[k]), std::abs(high[k])) < kInLine * size[k] + a.room) ++alike;
    else beyond += std::max(low[k], high[k]) < kThinEnd * size[k] && std::max(low[k], high[k]) > 0.0;
  }
  return alike == 2 && beyond == 1;
}

std::vector<DirectedExtent> extents_of(const Observation& seen, const Directions& directions, const std::vector<ColorRegion>& regions) {
  std::vector<DirectedExtent> extents;
  for (const ColorRegion& region : regions) extents.push_back(extent_of(seen, directions, region.points));
  return extents;
}

void erase_empty(std::vector<ColorRegion>& regions) {
  std::erase_if(regions, [](const ColorRegion& region) { return region.points.empty(); });
}

/// Merges ends with what they are of: by how far that reached before it had any, or one end would bring the next.
void merge_ends(const Observation& seen, const Directions& directions, std::vector<ColorRegion>& regions) {
  const std::vector<DirectedExtent> extents = extents_of(seen, directions, regions);
  std::vector<std::size_t> by_size(regions.size());
  std::iota(by_size.begin(), by_size.end(), std::size_t{0});
  std::stable_sort(by_size.begin(), by_size.end(), [&](std::size_t a, std::size_t b) { return regions[a].points.size() > regions[b].points.size(); });
  for (std::size_t b = by_size.size(); b-- > 1;)
    for (std::size_t a = 0; a < b; ++a)
      if (is_end_of(extents[by_size[a]], extents[by_size[b]])) {
        absorb(regions[by_size[a]], regions[by_size[b]]);
        break;
      }
  erase_empty(regions);
}

/// The regions that lie between two, as a print across one thing of their colour; none if others reach in.
std::vector<std::size_t> bands_between(const Observation& seen, const Directions& directions, const std::vector<ColorRegion>& regions,
                                       const std::vector<DirectedExtent>& extents, std::size_t a, std::size_t b) {
  if (are_other_tints(regions[a].tint, regions[b].tint) || !goes_on(extents[a], extents[b])) return {};
  const DirectedExtent both{extents[a].low.cwiseMin(extents[b].low), extents[a].high.cwiseMax(extents[b].high), extents[a].room};
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
  const std::vector<DirectedExtent> extents = extents_of(seen, directions, regions);
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

/// The regions that, side by side along one direction from the first on, and flush with it along the others, have two colours by turns and are narrow.
std::vector<std::size_t> stripes_from(std::size_t first, int direction, const std::vector<ColorRegion>& regions, const std::vector<DirectedExtent>& extents) {
  const DirectedExtent& one = extents[first];
  double across = 0;
  for (int k = 0; k < 3; ++k)
    if (k != direction) across = std::max(across, one.high[k] - one.low[k]);
  const auto is_stripe = [&](const DirectedExtent& other) {
    for (int k = 0; k < 3; ++k)
      if (k != direction && std::max(std::abs(one.low[k] - other.low[k]), std::abs(one.high[k] - other.high[k])) > kFlush * (one.high[k] - one.low[k]) + one.room)
        return false;
    return other.high[direction] - other.low[direction] < kWidestStripe * across;
  };
  if (!is_stripe(one)) return {};
  std::vector<std::size_t> stripes{first};
  for (;;) {
    const DirectedExtent& last = extents[stripes.back()];
    std::size_t next = regions.size();
    for (std::size_t i = 0; i < regions.size(); ++i)
      if (is_stripe(extents[i]) && extents[i].low[direction] > last.low[direction] && extents[i].low[direction] < last.high[direction] + kStripeGap + last.room &&
          (next == regions.size() || extents[i].low[direction] < extents[next].low[direction]))
        next = i;
    if (next == regions.size() || !are_other_tints(regions[next].tint, regions[stripes.back()].tint)) return stripes;
    if (stripes.size() > 1 && are_other_tints(regions[next].tint, regions[stripes[stripes.size() - 2]].tint)) return stripes;
    stripes.push_back(next);
  }
}

/// Merges stripes of two colours by turns, so many that boxes would hardly stand so.
void merge_stripes(const Observation& seen, const Directions& directions, std::vector<ColorRegion>& regions) {
  for (;;) {
    const std::vector<DirectedExtent> extents = extents_of(seen, directions, regions);
    std::vector<std::size_t> most;
    for (std::size_t a = 0; a < regions.size(); ++a)
      for (int direction = 0; direction < 3; ++direction)
        if (std::vector<std::size_t> stripes = stripes_from(a, direction, regions, extents); stripes.size() > most.size()) most = std::move(stripes);
    if (most.size() < kFewestStripes) return;
    for (std::size_t k = 1; k < most.size(); ++k) absorb(regions[most.front()], regions[most[k]]);
    erase_empty(regions);
  }
}

}  // namespace

void merge_prints(const Observation& seen, const Directions& directions, std::vector<ColorRegion>& regions) {
  merge_stripes(seen, directions, regions);
  merge_ends(seen, directions, regions);
  while (merge_print(seen, directions, regions)) erase_empty(regions);
}

bool are_one_print(const std::vector<ColorRegion>& regions) {
  const auto has = [](const ColorRegion& region, const Tint& tint) {
    return !are_other_tints(region.tint, tint) || std::any_of(region.others.begin(), region.others.end(), [&](const Tint& own) { return !are_other_tints(own, tint); });
  };
  return 2 <= std::count_if(regions.begin(), regions.end(), [&](const ColorRegion& region) {
    const bool is_printed = std::any_of(region.others.begin(), region.others.end(), [&](const Tint& own) { return are_other_tints(region.tint, own); });
    return is_printed && std::all_of(regions.begin(), regions.end(), [&](const ColorRegion& other) { return has(region, other.tint); });
  });
}

}  // namespace unseen::cuboids
