// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "io/rgbd_parts.h"
#include "unseen/core/error.h"
#include "unseen/core/quantile.h"

namespace unseen::io {
namespace {

constexpr double kFarthest = 100.0;  ///< m: no depth camera sees farther
constexpr double kNearest = 0.05;    ///< m

/// The usual scale that puts a middle depth, in stored units, into a room.
std::string advice(double stored) {
  for (const double scale : {1000.0, 1.0, 10000.0, 5000.0, 100.0, 1e6})
    if (stored / scale >= 0.2 && stored / scale <= 20.0)
      return fmt::format("metres in 0.05…100; depth_scale {:g} would make the middle depth {:.3g} m", scale,
                         stored / scale);
  return "metres in 0.05…100 after division by depth_scale";
}

}  // namespace

void check_depths(const std::vector<float>& depths, const std::string& name, double scale) {
  std::vector<float> known;
  for (const float d : depths)
    if (d > 0.0f) known.push_back(d);
  if (known.empty())
    throw InputError(name, "depth",
                     fmt::format("none of {} pixels with a depth (all zero or not finite)", depths.size()),
                     "an image of measured depths");
  const double deepest = quantile(known, 0.99);
  if (deepest <= kFarthest && *std::max_element(known.begin(), known.end()) >= kNearest) return;
  throw InputError(name, "depth", fmt::format("a scene of {:.3g} m (depth_scale {:g})", deepest, scale),
                   advice(quantile(known, 0.5) * scale));
}

void check_distances(const PointCloud& cloud, const std::string& name) {
  std::vector<float> known;
  for (const Vec3& p : cloud.positions) {
    const double distance = (p - *cloud.viewpoint).norm();
    if (std::isfinite(distance)) known.push_back(static_cast<float>(std::min(distance, 1e30)));
  }
  if (known.empty())
    throw InputError(name, "points", fmt::format("none of {} points finite", cloud.size()),
                     "a cloud of measured points");
  const double farthest = quantile(known, 0.99);
  if (farthest <= kFarthest && *std::max_element(known.begin(), known.end()) >= kNearest) return;
  throw InputError(name, "points", fmt::format("a scene of {:.3g} m around the viewpoint", farthest),
                   "metres in 0.05…100");
}

}  // namespace unseen::io
