// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/search/doubts.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string>

#include "cuboids/objects/slabs.h"

namespace unseen::cuboids {
namespace {

constexpr double kMuchFree = 0.25;     // of a box; in that around a standing cylinder 21 % are free
constexpr double kMuchWithin = 0.05, kWithinSigmas = 4.0;  // of what was measured in a box or on it, that lies so deep in it
constexpr std::size_t kNamed = 6;
constexpr double kGrownDown = 0.03, kGrownDownShare = 0.15;  // m, and of what was seen of a box
constexpr double kUnmeasured = 0.6, kBelowEdge = 4.0;        // of what is below a box; spacings below its lower edge
constexpr int kEdgeSamples = 12;

/// "3, 5, 8", or the first few of many.
std::string first_of(const std::vector<std::string>& names) {
  const std::size_t shown = std::min(names.size(), kNamed);
  std::string text = fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
  if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

/// How much of what is right below the lower edges of an upright box, on the sides that look at the camera, was not measured.
double unmeasured_below(const DepthView& view, const OrientedBox& box) {
  const Vec3 eye = box.axes.transpose() * (view.viewpoint() - box.center);
  const double below = kBelowEdge * view.spacing(box.center);
  int missing = 0, count = 0;
  for (int k = 0; k < 2; ++k) {
    if (std::abs(eye[k]) < box.half_size[k]) continue;
    for (int n = 0; n < kEdgeSamples; ++n) {
      Vec3 local;
      local[k] = eye[k] > 0.0 ? box.half_size[k] : -box.half_size[k];
      local[1 - k] = box.half_size[1 - k] * ((2.0 * n + 1.0) / kEdgeSamples - 1.0);
      local.z() = -box.half_size.z() - below;
      missing += view.at(box.center + box.axes * local) == DepthView::Space::missing;
      ++count;
    }
  }
  return count == 0 ? 0.0 : static_cast<double>(missing) / count;
}

/// How much of what was measured in a box or on it lies deep in it, where a box shows nothing.
double share_within(const DepthView& view, const OrientedBox& box, double tolerance) {
  const std::vector<Vec3> points = view.measured_in(box, tolerance);
  const auto is_within = [&](const Vec3& p) {
    const double inside = (box.half_size - (box.axes.transpose() * (p - box.center)).cwiseAbs()).minCoeff();
    return inside > std::max(tolerance, kWithinSigmas * view.sigma(p));
  };
  return points.empty() ? 0.0 : static_cast<double>(std::count_if(points.begin(), points.end(), is_within)) / static_cast<double>(points.size());
}

/// "5 (31 %), 2 (8 %)", the largest shares first.
std::string with_shares(std::vector<std::pair<double, int>> boxes) {
  std::stable_sort(boxes.begin(), boxes.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::string> named;
  for (const auto& [share, id] : boxes) named.push_back(fmt::format("{} ({:.0f} %)", id, 100.0 * share));
  return first_of(named);
}

}  // namespace

void warn_of_no_boxes(const DepthView& view, const std::vector<double>& tolerance, const std::vector<Cuboid>& cuboids, Context& context) {
  std::vector<std::pair<double, int>> free, within;
  for (std::size_t i = 0; i < cuboids.size(); ++i) {
    const OrientedBox& box = cuboids[i].box;
    if (const double share = 1.0 - filled_share(view, box, tolerance[i]); share > kMuchFree) free.emplace_back(share, cuboids[i].id);
    else if (const double deep = share_within(view, box, tolerance[i]); deep > kMuchWithin) within.emplace_back(deep, cuboids[i].id);
  }
  if (!free.empty()) context.warn("what was seen is no box, and its box holds space that was seen free: box " + with_shares(std::move(free)));
  if (!within.empty()) context.warn("may be several things, no box, or less than its box, as surface was seen within it: box " + with_shares(std::move(within)));
}

void warn_of_falls(const std::vector<char>& falls, double push, Completion& result, Context& context) {
  std::vector<std::string> named;
  for (std::size_t i = 0; i < result.cuboids.size(); ++i) {
    if (!falls[result.supports.size() + i]) continue;
    result.may_move.push_back(result.cuboids[i].id);
    named.push_back(std::to_string(result.cuboids[i].id));
  }
  if (named.empty()) return;
  context.warn(fmt::format("may not stay in its place in a physics engine, as it stands within the tolerance of its contacts only, or falls at a push of {} g: box {}",
                           push, first_of(named)));
}

void warn_of_unmeasured(const DepthView& view, const std::vector<Cuboid>& cuboids, Context& context) {
  std::vector<std::string> named;
  for (const Cuboid& cuboid : cuboids) {
    const OrientedBox &seen = cuboid.initial, &box = cuboid.box;
    const double down = (seen.center.z() - seen.half_size.z()) - (box.center.z() - box.half_size.z());
    if (seen.axes(2, 2) > 0.999 && down > std::max(kGrownDown, kGrownDownShare * 2.0 * seen.half_size.z()) && unmeasured_below(view, seen) > kUnmeasured)
      named.push_back(std::to_string(cuboid.id));
  }
  if (!named.empty()) context.warn("nothing was measured below what was seen of it, as if that were black or shiny: it may end there and stand on something else: box " + first_of(named));
}

}  // namespace unseen::cuboids
