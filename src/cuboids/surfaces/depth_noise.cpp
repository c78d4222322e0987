// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/surfaces/depth_noise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "core/linear.h"
#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr double kKinect = 0.0015;        // m
constexpr double kBest = 0.0006;          // m: with less, what is no wider than a pixel would count
constexpr double kCoarsest = 0.01;        // m
constexpr int kPatch = 25;                // pixels wide: sensors smooth what is nearer, and their warps count too
constexpr double kMeasuredShare = 0.8;    // of a patch
constexpr std::size_t kFewestPatches = 20;
constexpr double kFlatShare = 0.25;       // of the patches; the others hold edges and curved surfaces
constexpr double kWarps = 1.3;            // errors of wider reach, by which sensors are worse than their patches say
constexpr double kSmooth = 0.5;           // correlation of neighbours: noise has little
constexpr double kSmoothed = 0.7, kMostSmoothed = 0.004;  // of what patches of smooth noise say, as a Kinect's do; m
constexpr double kExact = 1e-5;           // m: no noise to be correlated, and no step
constexpr double kOffStep = 0.05;         // of a step

struct Patch {
  double noise = 0;        ///< m at 1 m: rms distance of 1/depth from its regression plane, which a disparity sensor has the same at any depth
  double correlation = 0;  ///< of that of neighbours
  double step = 0;         ///< m at 1 m: standard deviation of what is rounded to the depths that occur
};

double squared(double x) { return x * x; }

/// m: the width of the steps that depths come in; 0 = in none.
double step_of(std::vector<double> depths) {
  std::sort(depths.begin(), depths.end());
  std::vector<double> gaps;
  for (std::size_t i = 1; i < depths.size(); ++i)
    if (const double gap = depths[i] - depths[i - 1]; gap > kExact) gaps.push_back(gap);
  if (gaps.empty()) return 0.0;
  const double least = *std::min_element(gaps.begin(), gaps.end());
  return std::all_of(gaps.begin(), gaps.end(), [&](double gap) { return std::abs(gap / least - std::round(gap / least)) < kOffStep; }) ? least : 0.0;
}

std::optional<Patch> patch_at(const RgbdFrame& frame, int left, int top) {
  std::vector<Vec3> rows;
  std::vector<double> inverse, depths;
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (int y = 0; y < kPatch; ++y)
    for (int x = 0; x < kPatch; ++x) {
      const double depth = frame.depth[static_cast<std::size_t>(top + y) * frame.camera.width + left + x];
      if (!(depth > 0.0) || !std::isfinite(depth)) continue;
      rows.emplace_back(x - kPatch / 2, y - kPatch / 2, 1.0);
      inverse.push_back(1.0 / depth);
      depths.push_back(depth);
      normal += rows.back() * rows.back().transpose();
      right += rows.back() * inverse.back();
    }
  const double count = static_cast<double>(rows.size());
  if (count < kMeasuredShare * kPatch * kPatch) return std::nullopt;
  const Vec3 plane = solve_symmetric(normal, right);
  double squares = 0, products = 0, before = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double rest = inverse[i] - plane.dot(rows[i]);
    squares += rest * rest;
    products += rest * before;
    before = rest;
  }
  Patch patch{std::sqrt(squares / (count - 3.0)), squares > 0.0 ? products / squares : 0.0, 0.0};
  patch.step = step_of(depths) / std::sqrt(12.0) * squared(inverse[inverse.size() / 2]);
  return patch;
}

std::vector<double> each(const std::vector<Patch>& patches, double Patch::* value) {
  std::vector<double> values;
  for (const Patch& patch : patches) values.push_back(patch.*value);
  return values;
}

struct MeasuredNoise {
  double value = kKinect;
  double scatter = 0;  ///< m at 1 m, of flat patches, however large; 0 = not known
  bool smooth = false; ///< it is alike nearby, and `value` follows it
};

MeasuredNoise measure_noise(const RgbdFrame& frame) {
  std::vector<Patch> patches;
  for (int top = 0; !frame.is_fused() && top + kPatch <= frame.camera.height; top += kPatch)
    for (int left = 0; left + kPatch <= frame.camera.width; left += kPatch)
      if (const auto patch = patch_at(frame, left, top)) patches.push_back(*patch);
  if (patches.size() < kFewestPatches) return {};
  const double flattest = quantile(each(patches, &Patch::noise), kFlatShare), step = std::min(median(each(patches, &Patch::step)), kCoarsest);
  std::erase_if(patches, [&](const Patch& patch) { return patch.noise > flattest; });
  if (flattest > kExact && median(each(patches, &Patch::correlation)) > kSmooth) {
    const double smoothed = std::min(kSmoothed * flattest, kMostSmoothed);
    return smoothed > std::max(kKinect, step) ? MeasuredNoise{smoothed, flattest, true} : MeasuredNoise{std::max(kKinect, step)};
  }
  return {std::max(std::clamp(kWarps * flattest, kBest, kKinect), step), flattest};
}

}  // namespace

double depth_noise(const RgbdFrame& frame, const Options& options) { return options.noise ? *options.noise : measure_noise(frame).value; }

Options with_depth_noise(const RgbdFrame& frame, Options options, Context& context) {
  constexpr double kClearly = 1.3;
  if (options.noise) return options;
  const MeasuredNoise measured = measure_noise(frame);
  options.noise = measured.value;
  if (measured.smooth)
    context.warn(fmt::format("the depth scatters by {:.1f} mm at 1 m, alike nearby, as that of stereo cameras: boxes are no more exact, and small ones are lost", 1000.0 * measured.scatter));
  else if (measured.value > kKinect)
    context.warn(fmt::format("the depth comes in coarse steps, as wide as noise of {:.1f} mm at 1 m: boxes are no more exact", 1000.0 * measured.value));
  else if (measured.scatter > kClearly * kKinect)
    context.warn(fmt::format("the depth scatters by {0:.1f} mm at 1 m, more than what boxes are told apart with: far walls may be cut into boxes (--noise {1:.4f} keeps them whole, and loses "
                             "small boxes)", 1000.0 * measured.scatter, measured.scatter));
  return options;
}

}  // namespace unseen::cuboids
