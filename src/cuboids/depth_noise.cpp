// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/depth_noise.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace unseen::cuboids {
namespace {

constexpr double kKinect = 0.0015;        // m
constexpr double kBest = 0.0002;          // m
constexpr int kPatch = 25;                // pixels wide: sensors smooth what is nearer, and their warps count too
constexpr double kMeasuredShare = 0.8;    // of a patch
constexpr std::size_t kFewestPatches = 20;
constexpr double kFlatShare = 0.25;        // of the patches; the others hold edges and curved surfaces
constexpr double kWarps = 1.3;            // errors of wider reach, by which sensors are worse than their patches say

/// rms distance of 1/depth from its regression plane: that of a disparity sensor is the same at any depth, and σ at 1 m.
std::optional<double> patch_noise(const RgbdFrame& frame, int left, int top) {
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  double squares = 0, count = 0;
  for (int y = 0; y < kPatch; ++y)
    for (int x = 0; x < kPatch; ++x) {
      const double depth = frame.depth[static_cast<std::size_t>(top + y) * frame.camera.width + left + x];
      if (!(depth > 0.0) || !std::isfinite(depth)) continue;
      const Vec3 row(x - kPatch / 2, y - kPatch / 2, 1.0);
      normal += row * row.transpose();
      right += row / depth;
      squares += 1.0 / (depth * depth);
      count += 1.0;
    }
  if (count < kMeasuredShare * kPatch * kPatch) return std::nullopt;
  const double rest = squares - right.dot(normal.ldlt().solve(right));
  return std::sqrt(std::max(rest, 0.0) / (count - 3.0));
}

}  // namespace

double depth_noise(const RgbdFrame& frame, const Options& options) {
  if (options.noise) return *options.noise;
  std::vector<double> noises;
  for (int top = 0; !frame.is_fused() && top + kPatch <= frame.camera.height; top += kPatch)
    for (int left = 0; left + kPatch <= frame.camera.width; left += kPatch)
      if (const auto noise = patch_noise(frame, left, top)) noises.push_back(*noise);
  if (noises.size() < kFewestPatches) return kKinect;
  const auto flat = noises.begin() + static_cast<std::ptrdiff_t>(kFlatShare * static_cast<double>(noises.size()));
  std::nth_element(noises.begin(), flat, noises.end());
  return std::clamp(kWarps * *flat, kBest, kKinect);
}

}  // namespace unseen::cuboids
