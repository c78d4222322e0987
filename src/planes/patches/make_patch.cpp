// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A patch and how well its tilts are known.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "planes/patches/patches.h"
#include "unseen/core/quantile.h"

namespace unseen::planes {
namespace {

constexpr double kDithered = 0.6;  // of a step of the coordinates: noise that hides it, with what rounding adds
constexpr double kSystematicTilt = 0.5 * kPi / 180.0;  // rad: registration, calibration, walls out of plumb
constexpr double kLargestShift = 0.15;  // of the tolerance, of points one standard deviation from the centre
constexpr double kToleranceShare = 0.03;  // of the tolerance: rims and clutter pull a patch's edge by as much,
constexpr double kNoiseShare = 0.3;       // but by no more of its noise, or they would show in it

/// Variance (rad²) of the tilt that a least-squares plane has along `axis`. Residuals are summed by blocks of a
/// grid over the patch, so that noise that is correlated over up to a block's size counts as what it is
/// (cluster-robust "sandwich" estimate: Liang & Zeger, Biometrika 73, 1986).
double tilt_variance(const VoxelGrid& grid, const Patch& patch, const std::vector<int>& core, const Vec3& axis, double spread, double least_noise) {
  constexpr int kBlocks = 6;
  const PlaneFit& fit = patch.fit;
  std::map<std::pair<int, int>, double> score;  // Σ x·r of each block
  const double su = std::max(fit.spread_u, 1e-300) * 3.5 / kBlocks, sv = std::max(fit.spread_v, 1e-300) * 3.5 / kBlocks;
  for (const int i : core) {
    const Moments& m = grid.moments[i];
    const Vec3 d = m.mean - patch.moments.mean;
    const double xr = m.count * axis.dot(d) * fit.normal.dot(d) + axis.dot(m.scatter * fit.normal);
    score[{static_cast<int>(std::floor(fit.u.dot(d) / su)), static_cast<int>(std::floor(fit.v.dot(d) / sv))}] += xr;
  }
  double sum = 0;
  for (const auto& [block, s] : score) sum += s * s;
  const double information = patch.moments.count * spread * spread;
  const double robust = information > 0 ? sum / (information * information) : 0.0;
  const double plain = std::pow(std::max(fit.rms, least_noise), 2) / std::max(information, 1e-300);
  return std::max(robust, plain);
}

/// Variance (rad²) of a tilt along `axis` that shows as a wedge: where scans are turned against each other, a surface is thicker at one end
/// than in the middle, and there than at the other end, and its plane is as uncertain as that angle. What is thick at an end alone has
/// something else lying there, and what is thick for its width is no surface that scans agree on.
double wedge_variance(const VoxelGrid& grid, const Patch& patch, const std::vector<int>& core, const Vec3& axis, double spread) {
  constexpr double kMiddle = 0.5;   // of the spread, to either side
  constexpr double kClearly = 3;    // standard errors
  constexpr double kBetween = 0.2;  // of what the ends differ by: the middle differs from both by as much
  constexpr double kThin = 0.15;    // of the spread
  if (patch.fit.rms > kThin * spread) return 0.0;
  struct Part {
    double count = 0, place = 0, square = 0;
    double rms() const { return std::sqrt(square / count); }
  };
  std::array<Part, 3> parts;
  for (const int i : core) {
    const Moments& m = grid.moments[i];
    const Vec3 d = m.mean - patch.moments.mean;
    const double x = axis.dot(d), r = patch.fit.normal.dot(d);
    Part& part = parts[x < -kMiddle * spread ? 0 : x > kMiddle * spread ? 2 : 1];
    part.count += m.count;
    part.place += m.count * x;
    part.square += m.count * r * r + patch.fit.normal.dot(m.scatter * patch.fit.normal);
  }
  const auto& [low, middle, high] = parts;
  if (!(low.square > 0 && middle.square > 0 && high.square > 0)) return 0.0;
  const double error = std::sqrt(0.5 / low.count + 0.5 / high.count), more = high.rms() - low.rms();
  if (std::abs(std::log(high.rms() / low.rms())) < kClearly * error) return 0.0;
  if (std::abs((middle.rms() - low.rms()) / more - 0.5) > 0.5 - kBetween) return 0.0;
  return std::pow(more / (high.place / high.count - low.place / low.count), 2);
}

/// Variance (rad²) of a tilt along `axis` that the surface's own normals show to be none: a wall that steps back as it rises has points that
/// lean, and most of its normals, of the finest neighbourhoods, are turned from their plane to the same side.
double relief_variance(const Cells& surface, const Patch& patch, const std::vector<int>& core, const Vec3& axis, double spread, double variance) {
  constexpr std::size_t kFewest = 30;           // normals
  constexpr double kShared = 12;                // voxels that a normal is estimated from, about: neighbours have much the same
  constexpr double kClearly = 3;                // standard errors
  constexpr double kRims = 0.1 * kPi / 180.0;   // rad, of the standard error: what is beyond a rim turns normals
  constexpr double kSteepest = 0.5;             // cosine: what is turned farther is none of the surface
  constexpr double kLevels = 3;                 // more steps than between so many do lean: over n of one height, n² − 1 times as much variance is of the lean as of the steps
  std::vector<double> tilts;
  for (const int i : core) {
    const double across = surface.normal[i].dot(patch.fit.normal);
    if (surface.variation[i] < 1.0 && std::abs(across) > kSteepest) tilts.push_back(surface.normal[i].dot(axis) / across);
  }
  if (tilts.size() < kFewest) return 0.0;
  const double count = static_cast<double>(tilts.size()), tilt = median(tilts);
  for (double& t : tilts) t = std::abs(t - tilt);
  const double scatter = 1.48 * median(std::move(tilts)), error = 1.25 * scatter * std::sqrt(kShared / count);  // of a median
  const bool clear = tilt * tilt > kClearly * kClearly * (variance + error * error + kRims * kRims);
  const bool few_steps = std::abs(tilt) * spread < kLevels * patch.fit.rms;
  return clear && few_steps && std::abs(tilt) > scatter ? tilt * tilt : 0.0;
}

/// Variance (rad²) of a tilt along `axis` that rounded coordinates leave: a surface that rises by less than a step between its ends is level
/// to them, and each step that it passes says where it is (as of a uniform error of a step over its length).
double rounding_variance(const PlaneFit& fit, const Vec3& axis, double spread, double raster) {
  if (!(raster > 0.0)) return 0.0;
  int across = 0;
  fit.normal.cwiseAbs().maxCoeff(&across);
  const double length = std::sqrt(12.0) * std::max(spread, 1e-300), steps = std::abs(axis[across]) * length / raster;
  return std::pow(raster / (length * (1.0 + steps)), 2) / 3.0;
}

}  // namespace

double tilt_noise(const Moments& moments, const PlaneFit& fit, double variance, double spread) {
  const double independent = std::clamp(moments.count - 3, 1.0, kMostPoints), width = std::max(spread, 1e-300);
  return std::max(variance, fit.rms * fit.rms / (independent * width * width));
}

Patch make_patch(const VoxelGrid& grid, const Space& space, std::vector<int> cells, double least_noise, const Cells& surface) {
  Patch patch;
  patch.cells = std::move(cells);
  const std::vector<int> core = core_of(grid, space, patch.cells);
  patch.moments = sum_of(grid, core);
  patch.fit = fit_plane(patch.moments, space);
  const PlaneFit& fit = patch.fit;
  patch.area = std::sqrt(12.0) * fit.spread_u * (space.is_2d() ? 1.0 : std::sqrt(12.0) * fit.spread_v);
  patch.variance_u = tilt_variance(grid, patch, core, fit.u, fit.spread_u, least_noise);
  patch.variance_v = space.is_2d() ? 0.0 : tilt_variance(grid, patch, core, fit.v, fit.spread_v, least_noise);
  if (space.is_2d()) {
    patch.variance_u += rounding_variance(fit, fit.u, fit.spread_u, grid.raster);
  } else if (fit.rms < kDithered * grid.raster) {
    patch.variance_u += rounding_variance(fit, fit.u, fit.spread_u, grid.raster);
    patch.variance_v += rounding_variance(fit, fit.v, fit.spread_v, grid.raster);
  } else if (!surface.normal.empty()) {  // those of points on a raster follow its axes
    patch.variance_u += relief_variance(surface, patch, core, fit.u, fit.spread_u, patch.variance_u);
    patch.variance_v += relief_variance(surface, patch, core, fit.v, fit.spread_v, patch.variance_v);
  }
  const auto systematic = [&](double width) {
    const double clutter = std::min(kToleranceShare * grid.tolerance, kNoiseShare * std::max(fit.rms, 2.0 * least_noise));
    const double tilt = kSystematicTilt * kSystematicTilt + std::pow(clutter / width, 2);
    // No doubt excuses a tilt that carries the patch's points out of the plane's tolerance.
    return std::min(tilt, std::pow(kLargestShift * grid.tolerance / width, 2));
  };
  const double width_u = std::max(fit.spread_u, 1e-300), width_v = std::max(fit.spread_v, 1e-300);
  patch.systematic_u = systematic(width_u);
  patch.systematic_v = space.is_2d() ? 0.0 : systematic(width_v);  // a line cannot tilt out of its drawing
  const auto doubt = [&](const Vec3& axis, double variance, double width) {
    return tilt_noise(patch.moments, fit, variance, width) + wedge_variance(grid, patch, core, axis, width);
  };
  patch.doubt_u = doubt(fit.u, patch.variance_u, width_u) + patch.systematic_u;
  patch.doubt_v = space.is_2d() ? std::numeric_limits<double>::infinity() : doubt(fit.v, patch.variance_v, width_v) + patch.systematic_v;
  return patch;
}

}  // namespace unseen::planes
