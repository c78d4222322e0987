// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/layout/masks.h"

#include <algorithm>
#include <cmath>

#include "interactions/database/footprint.h"
#include "unseen/core/convex.h"

namespace unseen::interactions {
namespace {

/// A box in the picture; empty if a corner is not in front of the camera.
Polygon outline_of(const OrientedBox& box, const View& view) {
  constexpr double kNearest = 0.1;  // m
  std::vector<Vec2> corners;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    const Vec3 p = view.T_world_camera.inverse() * Vec3(box.center + box.axes * box.half_size.cwiseProduct(sign));
    if (p.z() < kNearest) return {};
    corners.push_back(view.camera.project(p));
  }
  return convex_hull(std::move(corners));
}

bool is_inside(const Mask& mask, int x, int y) {
  const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width) + static_cast<std::size_t>(x);
  return x < mask.width && at < mask.inside.size() && mask.inside[at] != 0;
}

}  // namespace

std::optional<double> share_in_masks(const Object& object, std::span<const Mask> masks, const View& view) {
  std::vector<const Mask*> same;
  for (const Mask& mask : masks)
    if (superclass_of(mask.category) == object.superclass()) same.push_back(&mask);
  if (same.empty()) return std::nullopt;
  std::vector<Polygon> outline;
  Vec2 low(view.camera.width, view.camera.height), high(-1, -1);
  for (const Part& part : object.parts) {
    outline.push_back(outline_of(part.box, view));
    if (outline.back().empty()) return std::nullopt;
    for (const Vec2& p : outline.back()) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
  }
  const Vec2 from = low.array().max(0.0).ceil(), to(std::min(high.x(), view.camera.width - 1.0), std::min(high.y(), view.camera.height - 1.0));
  constexpr double kSamples = 200;  // along the longer side: enough
  const int step = std::max(1, static_cast<int>((to - from).maxCoeff() / kSamples));
  std::size_t all = 0, covered = 0;
  for (int y = static_cast<int>(from.y()); y <= to.y(); y += step)
    for (int x = static_cast<int>(from.x()); x <= to.x(); x += step) {
      if (std::none_of(outline.begin(), outline.end(), [&](const Polygon& polygon) { return inside_convex(polygon, Vec2(x, y)); })) continue;
      ++all;
      covered += std::any_of(same.begin(), same.end(), [&](const Mask* mask) { return is_inside(*mask, x, y); });
    }
  if (all == 0) return std::nullopt;
  return static_cast<double>(covered) / static_cast<double>(all);
}

void heed_masks(std::vector<FoundObject>& objects, std::span<const Mask> masks, const View& view) {
  constexpr double kSays = 4.0, kNeutral = 0.3;
  constexpr double kSurest = 0.98;  // what is found is never so sure that no mask counts
  for (FoundObject& found : objects) {
    const std::optional<double> share = share_in_masks(found.object, masks, view);
    if (!share) continue;
    const double confidence = std::min(found.confidence, kSurest), odds = confidence / (1 - confidence) * std::exp(kSays * (*share - kNeutral));
    found.confidence = odds / (1 + odds);
  }
}

}  // namespace unseen::interactions
