// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/plain_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "cuboids/objects/color_bodies.h"
#include "cuboids/objects/color_regions.h"
#include "cuboids/objects/extent.h"
#include "cuboids/objects/prints.h"
#include "cuboids/objects/slabs.h"
#include "cuboids/objects/upright_box.h"
#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr double kMostOff = 0.15;       // of a part's points, that are not on the sides of the boxes of its regions
constexpr double kOtherSide = 0.15;     // of a region's points, on the second of its sides
constexpr double kWidestShift = 0.025;  // of the picture's longer side, that it may be shifted against the depth image
constexpr double kMostNear = 0.8;       // of a region's points, that are no farther than that from their part's outline
constexpr double kAlongOutline = 1.0;   // points beside the outline, over the root of those of a region: what has more lies along it
constexpr std::size_t kSamplesOfRegion = 400;

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
  const DirectedExtent extent = extent_of(seen, directions, region.points);
  const auto on = std::count_if(samples.begin(), samples.end(), [&](const Sample& s) { return extent.has_on_side(directions(s.p)); });
  return count * (1.0 - static_cast<double>(on) / static_cast<double>(samples.size()));
}

/// Whether the upright box around a region is not proven free for the most part, as between the legs of a chair.
bool is_filled(const Observation& seen, const DepthView& view, const ColorRegion& region) {
  constexpr double kFilled = 0.9, kVoxel = 0.2;  // share; of the longest half side
  const std::vector<Sample> samples = some_samples(seen, region.points);
  if (samples.empty()) return false;
  const Directions directions{across_front(samples)};
  const DirectedExtent extent = extent_of(seen, directions, region.points);
  OrientedBox box;
  box.axes.col(0) = Vec3(directions.along.x(), directions.along.y(), 0);
  box.axes.col(1) = Vec3(-directions.along.y(), directions.along.x(), 0);
  box.center = box.axes * (0.5 * (extent.low + extent.high));
  box.half_size = 0.5 * (extent.high - extent.low);
  return filled_share(view, box, kVoxel * box.half_size.maxCoeff()) > kFilled;
}

/// Whether a region has two sides of a box.
bool goes_round_an_edge(const Observation& seen, const ColorRegion& region) {
  const std::vector<Sample> samples = some_samples(seen, region.points);
  if (samples.empty()) return false;
  const Directions directions{across_front(samples)};
  std::array<std::size_t, 3> count{};
  for (const Sample& s : samples) {
    int axis = 0;
    directions(s.n).cwiseAbs().maxCoeff(&axis);
    ++count[axis];
  }
  std::sort(count.begin(), count.end());
  return static_cast<double>(count[1]) > kOtherSide * static_cast<double>(samples.size());
}

/// A part in the picture: its points are those that `scratch` has as 0. Where the picture ends, it ends.
struct PartOutline {
  const Observation& seen;
  const std::vector<int>& scratch;
  int width, height;

  bool is_beyond(int u, int v) const {
    const int i = u < 0 || v < 0 || u >= width || v >= height ? -1 : seen.point_of_pixel[static_cast<std::size_t>(v) * width + u];
    return i < 0 || scratch[i] != 0;
  }
  /// How many of a region's points have what is beyond the part no farther than so many pixels, across or down: two pixels of it, for one may be a hole.
  std::size_t near(const ColorRegion& region, int pixels) const {
    const auto ends = [&](int u, int v, int du, int dv) {
      for (int k = 1; k <= pixels; ++k)
        if (is_beyond(u + k * du, v + k * dv) && is_beyond(u + (k + 1) * du, v + (k + 1) * dv)) return true;
      return false;
    };
    return static_cast<std::size_t>(std::count_if(region.points.begin(), region.points.end(), [&](int i) {
      const int u = seen.pixel_of_point[i] % width, v = seen.pixel_of_point[i] / width;
      return ends(u, v, -1, 0) || ends(u, v, 1, 0) || ends(u, v, 0, -1) || ends(u, v, 0, 1);
    }));
  }
};

/// What a region is that has the colour of a support: the support itself, in a picture that is shifted against the depth image or of another scale, lies
/// along the outline of what stands before it.
enum class Kind { box, print, background };

Kind kind_of(const Observation& seen, const PartOutline& outline, const ColorRegion& region) {
  const auto count = static_cast<double>(region.points.size());
  const int shift = std::max(1, static_cast<int>(kWidestShift * std::max(outline.width, outline.height)));
  if (goes_round_an_edge(seen, region) && static_cast<double>(outline.near(region, shift)) < kMostNear * count) return Kind::box;
  return static_cast<double>(outline.near(region, 1)) > kAlongOutline * std::sqrt(count) ? Kind::background : Kind::print;
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

/// The boxes of plain colours that a part consists of, none if it does not, or if what is printed on it does not tell on which.
std::vector<ColorRegion> plain_boxes(const Observation& seen, std::span<const Tint> supports, std::span<const int> part, const PartOutline& outline, std::vector<ColorRegion> regions) {
  const auto is_any = [&](Kind kind) {
    return std::any_of(regions.begin(), regions.end(), [&](const ColorRegion& region) {
      const bool as_support = std::any_of(supports.begin(), supports.end(), [&](const Tint& tint) { return (region.tint - tint).norm() < kSameTint; });
      return as_support && kind_of(seen, outline, region) == kind;
    });
  };
  const std::vector<Sample> samples = some_samples(seen, part);
  if (regions.size() < 2 || samples.empty() || is_any(Kind::background)) return {};
  const bool has_labels = is_any(Kind::print);
  merge_prints(seen, Directions{across_front(samples)}, regions);
  if (regions.size() < 2 || are_one_print(regions) || is_any(Kind::print)) return {};
  if (has_labels && std::count_if(regions.begin(), regions.end(), [&](const ColorRegion& region) { return goes_round_an_edge(seen, region); }) < 2) return {};
  double off = 0;
  for (const ColorRegion& region : regions) off += off_box(seen, region);
  if (off > kMostOff * static_cast<double>(part.size())) return {};
  return regions;
}

}  // namespace

void find_plain_colors(const RgbdFrame& frame, const Observation& seen, const std::vector<std::vector<int>>& parts, const DepthView& view, Stacks& stacks,
                       const Context& context) {
  if (seen.tints.empty()) return;
  const std::vector<Tint> supports = tints_of_supports(seen);
  std::vector<int> scratch(seen.points.size(), -2);
  std::vector<std::vector<ColorRegion>> regions;
  for (const std::vector<int>& part : parts) {
    context.check();
    regions.push_back(color_regions(frame, seen, part, scratch));
  }
  int stack = *std::max_element(stacks.stack_of_piece.begin(), stacks.stack_of_piece.end()) + 1;
  const auto boxes_of = [&](const std::vector<int>& part, std::vector<ColorRegion> found) {
    for (const int i : part) scratch[i] = 0;
    std::vector<ColorRegion> boxes = plain_boxes(seen, supports, part, {seen, scratch, frame.camera.width, frame.camera.height}, std::move(found));
    for (const int i : part) scratch[i] = -2;
    return boxes;
  };
  const auto cut = [&](const std::vector<int>& part, const std::vector<ColorRegion>& boxes) {
    for (const int i : part) stacks.piece_of_point[i] = 0;
    for (const ColorRegion& box : boxes) {
      const auto piece = static_cast<int>(stacks.stack_of_piece.size());
      for (const int i : box.points) stacks.piece_of_point[i] = piece;
      for (const int i : box.rim) stacks.piece_of_point[i] = piece;
      stacks.stack_of_piece.push_back(stack);
    }
    ++stack;
  };
  std::vector<char> done(seen.points.size(), 0);
  for (const std::vector<int>& body : joined_by_color(seen, parts, regions)) {
    context.check();
    const std::vector<ColorRegion> boxes = boxes_of(body, color_regions(frame, seen, body, scratch));
    const bool good = std::all_of(boxes.begin(), boxes.end(), [&](const ColorRegion& box) {
      return off_box(seen, box) <= kMostOff * static_cast<double>(box.points.size()) && is_filled(seen, view, box);
    });
    if (boxes.empty() || !good) continue;
    cut(body, boxes);
    for (const int i : body) done[i] = 1;
  }
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (done[parts[k].front()] != 0) continue;
    const std::vector<ColorRegion> boxes = boxes_of(parts[k], std::move(regions[k]));
    if (!boxes.empty()) cut(parts[k], boxes);
  }
}

}  // namespace unseen::cuboids
