// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/color_regions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace unseen::cuboids {
namespace {

constexpr std::size_t kFewestOfColor = 60;  // points of a region …
constexpr double kSmallestColor = 0.01;     // … and of those of its part
constexpr double kInner = 0.25;             // of a region's points, with none of another among their neighbours' neighbours: what is narrower is an edge
constexpr int kWidestRim = 4;               // links
constexpr double kMostStrange = 0.05;       // of a part's points, farther from all regions
constexpr int kInward = 6;                  // pixels from a border, where normals are not of both sides
const double kCrease = std::cos(radians(30.0));
constexpr double kEdge = 0.75;              // of the links of a border, that go round an edge if nothing else is there …
constexpr double kPartlyEdge = 0.3;         // … and if tints are not far apart
constexpr double kLong = 0.3;               // of the root of the points of the lesser region, in links: a shorter border tells nothing
constexpr double kOtherLight = 20.0;        // between tints of two sides of one thing, at most

/// What is linked to a point and has its colour, of what `region_of` has as −1; it becomes `number`.
ColorRegion grow_color(const Observation& seen, int seed, int number, std::vector<int>& region_of) {
  ColorRegion region{{seed}, {}, seen.tints[seen.pixel_of_point[seed]]};
  region_of[seed] = number;
  Tint sum = region.tint;
  for (std::size_t at = 0; at < region.points.size(); ++at)
    for (const int j : seen.graph.neighbours(region.points[at])) {
      const Tint& tint = seen.tints[seen.pixel_of_point[j]];
      if (region_of[j] != -1 || (tint - region.tint).norm() > kSameTint) continue;
      region_of[j] = number;
      region.points.push_back(j);
      sum += tint;
      region.tint = sum / static_cast<double>(region.points.size());
    }
  return region;
}

/// Whether a region is more than an edge.
bool is_wide(const Observation& seen, const ColorRegion& region, const std::vector<int>& region_of) {
  const auto inner = std::count_if(region.points.begin(), region.points.end(), [&](int i) {
    const auto near = seen.graph.neighbours(i);
    return std::all_of(near.begin(), near.end(), [&](int j) {
      const auto next = seen.graph.neighbours(j);
      return std::all_of(next.begin(), next.end(), [&](int k) { return region_of[k] == region_of[i]; });
    });
  });
  return static_cast<double>(inner) > kInner * static_cast<double>(region.points.size());
}

/// Wide regions of a part, which `region_of` has as −1 and then as their number, all else as −1.
std::vector<ColorRegion> wide_regions(const Observation& seen, std::span<const int> part, std::vector<int>& region_of) {
  std::vector<ColorRegion> grown, wide;
  for (const int i : part)
    if (region_of[i] == -1) grown.push_back(grow_color(seen, i, static_cast<int>(grown.size()), region_of));
  const auto fewest = std::max(kFewestOfColor, static_cast<std::size_t>(kSmallestColor * static_cast<double>(part.size())));
  std::vector<int> number(grown.size(), -1);
  for (std::size_t r = 0; r < grown.size(); ++r)
    if (grown[r].points.size() >= fewest && is_wide(seen, grown[r], region_of)) {
      number[r] = static_cast<int>(wide.size());
      wide.push_back(std::move(grown[r]));
    }
  for (const int i : part) region_of[i] = number[region_of[i]];
  return wide;
}

/// Gives what is near regions to the nearest; how many points that are.
std::size_t grow_rims(const Observation& seen, std::vector<ColorRegion>& regions, std::vector<int>& region_of) {
  std::vector<int> front, next;
  for (const ColorRegion& region : regions) front.insert(front.end(), region.points.begin(), region.points.end());
  std::size_t count = 0;
  for (int link = 0; link < kWidestRim; ++link) {
    next.clear();
    for (const int i : front)
      for (const int j : seen.graph.neighbours(i))
        if (region_of[j] == -1) {
          region_of[j] = region_of[i];
          regions[region_of[i]].rim.push_back(j);
          next.push_back(j);
        }
    count += next.size();
    front.swap(next);
  }
  return count;
}

/// Links between two regions, and how many of them go round a convex edge.
struct Border {
  int links = 0, convex = 0;
};

/// The point of the same region that lies up to some pixels from a link's end, away from the link.
int inward(const RgbdFrame& frame, const Observation& seen, const std::vector<int>& region_of, int end, int other) {
  const int width = frame.camera.width, pixel = seen.pixel_of_point[end], from = seen.pixel_of_point[other];
  const int du = pixel % width - from % width, dv = pixel / width - from / width;
  int at = end;
  for (int step = 1; step <= kInward; ++step) {
    const int u = pixel % width + step * du, v = pixel / width + step * dv;
    if (u < 0 || v < 0 || u >= width || v >= frame.camera.height) break;
    const int next = seen.point_of_pixel[static_cast<std::size_t>(v) * width + u];
    if (next < 0 || region_of[next] != region_of[end]) break;
    if (!seen.graph.normals[next].isZero()) at = next;
  }
  return at;
}

std::map<std::pair<int, int>, Border> find_borders(const RgbdFrame& frame, const Observation& seen, std::span<const int> part, const std::vector<int>& region_of) {
  std::map<std::pair<int, int>, Border> borders;
  for (const int i : part)
    for (const int j : seen.graph.neighbours(i)) {
      if (region_of[i] < 0 || region_of[j] <= region_of[i]) continue;
      const int a = inward(frame, seen, region_of, i, j), b = inward(frame, seen, region_of, j, i);
      const Vec3 &first = seen.graph.normals[a], &second = seen.graph.normals[b];
      Border& border = borders[{region_of[i], region_of[j]}];
      ++border.links;
      border.convex += first.dot(second) < kCrease && (first - second).dot(seen.points[a] - seen.points[b]) > 0.0;
    }
  return borders;
}

/// Whether two regions are of one thing: of one colour, or two of its sides. Where one box stands on or beside another, their sides go on in one plane.
bool are_one_thing(const ColorRegion& a, const ColorRegion& b, const Border& border) {
  if (!are_other_tints(a.tint, b.tint)) return true;
  const bool is_long = border.links > kLong * std::sqrt(static_cast<double>(std::min(a.points.size(), b.points.size())));
  const double edge = difference(a.tint, b.tint) < kOtherLight ? kPartlyEdge : kEdge;
  return is_long && border.convex > edge * border.links;
}

void merge_sides(const std::map<std::pair<int, int>, Border>& borders, std::vector<ColorRegion>& regions) {
  std::vector<int> whole(regions.size());
  std::iota(whole.begin(), whole.end(), 0);
  for (const auto& [pair, border] : borders) {
    if (!are_one_thing(regions[pair.first], regions[pair.second], border)) continue;
    const int from = whole[pair.second], to = whole[pair.first];
    std::replace(whole.begin(), whole.end(), from, to);
  }
  for (std::size_t r = 0; r < regions.size(); ++r) {
    if (whole[r] == static_cast<int>(r)) continue;
    absorb(regions[whole[r]], regions[r]);
  }
  std::erase_if(regions, [](const ColorRegion& region) { return region.points.empty(); });
}

}  // namespace

void absorb(ColorRegion& region, ColorRegion& other) {
  region.points.insert(region.points.end(), other.points.begin(), other.points.end());
  region.rim.insert(region.rim.end(), other.rim.begin(), other.rim.end());
  region.others.push_back(other.tint);
  region.others.insert(region.others.end(), other.others.begin(), other.others.end());
  other = {};
}

std::vector<ColorRegion> color_regions(const RgbdFrame& frame, const Observation& seen, std::span<const int> part, std::vector<int>& scratch) {
  for (const int i : part) scratch[i] = -1;
  std::vector<ColorRegion> regions = wide_regions(seen, part, scratch);
  std::size_t reached = 0;
  for (const ColorRegion& region : regions) reached += region.points.size();
  if (!regions.empty()) reached += grow_rims(seen, regions, scratch);
  if (static_cast<double>(part.size() - reached) > kMostStrange * static_cast<double>(part.size()))
    regions.clear();
  else
    merge_sides(find_borders(frame, seen, part, scratch), regions);
  for (const int i : part) scratch[i] = -2;
  return regions;
}

}  // namespace unseen::cuboids
