// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Noise that is correlated over more than a small surface turns it, and the surface itself cannot tell. Large ones can: pieces of them, as large as
// that, are turned from the whole by as much.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "planes/patches/facets.h"
#include "unseen/core/quantile.h"

namespace unseen::planes {
namespace {

constexpr double kFinest = 2.0;             // scales: the width of the smallest windows; each following ones are twice as wide
constexpr int kWidths = 10;
constexpr std::size_t kFewestCells = 200;   // of a patch that tells,
constexpr std::size_t kFewestOfPatch = 8;   // windows on it,
constexpr std::size_t kFewest = 20;         // and on all
constexpr double kFewestPoints = 12;        // in a window,
constexpr double kFilled = 0.2;             // of its width: their spread along either axis
constexpr double kQuartile = 0.25, kUsual = 0.1015;  // the square of a standard normal variable is below this so often; grounds and vaults may undulate

/// A patch as a grid of square windows over its plane.
struct Windows {
  int columns = 0, rows = 0;
  std::vector<Moments> at;  ///< row by row
};

Windows finest_windows(const VoxelGrid& grid, const Patch& patch, double& width) {
  Eigen::AlignedBox2d box;
  const auto place = [&](int i) { return Eigen::Vector2d(patch.fit.u.dot(grid.moments[i].mean), patch.fit.v.dot(grid.moments[i].mean)); };
  for (const int i : patch.cells) box.extend(place(i));
  const Eigen::Vector2d size = box.sizes();
  while (size.x() * size.y() > 4.0 * static_cast<double>(patch.cells.size()) * width * width) width *= 2.0;  // points far apart
  Windows windows{1 + static_cast<int>(size.x() / width), 1 + static_cast<int>(size.y() / width), {}};
  windows.at.resize(static_cast<std::size_t>(windows.columns) * static_cast<std::size_t>(windows.rows));
  for (const int i : patch.cells) {
    const Eigen::Vector2d at = (place(i) - box.min()) / width;
    windows.at[static_cast<std::size_t>(at.y()) * static_cast<std::size_t>(windows.columns) + static_cast<std::size_t>(at.x())] += grid.moments[i];
  }
  return windows;
}

/// Windows twice as wide.
Windows wider(const Windows& fine) {
  Windows windows{(fine.columns + 1) / 2, (fine.rows + 1) / 2, {}};
  windows.at.resize(static_cast<std::size_t>(windows.columns) * static_cast<std::size_t>(windows.rows));
  for (int y = 0; y < fine.rows; ++y)
    for (int x = 0; x < fine.columns; ++x)
      windows.at[static_cast<std::size_t>(y / 2 * windows.columns + x / 2)] += fine.at[static_cast<std::size_t>(y * fine.columns + x)];
  return windows;
}

/// Of each window the squared turns along either axis against a paraboloid through the patch (curved surfaces have no waves), times the squared spread
/// along it, over its own variance: the inverse of how many of its points are independent. None of too few windows.
std::vector<double> turns_of(const Windows& windows, const PlaneFit& fit, double width) {
  struct Turned {
    Eigen::Vector3d place;  // 1, and its middle along the patch's axes
    Eigen::Vector2d slope;
    Eigen::Array2d weight;  // of a squared slope
  };
  std::vector<Turned> turned;
  Mat3 places = Mat3::Zero();
  Eigen::Matrix<double, 3, 2> slopes = Eigen::Matrix<double, 3, 2>::Zero();
  for (const Moments& m : windows.at) {
    if (m.count < kFewestPoints) continue;
    const std::optional<Slope> slope = slope_of(m, fit);
    if (!slope || !(slope->error > 0.0)) continue;
    const Eigen::Array2d spread2 = Eigen::Array2d(fit.u.dot(m.scatter * fit.u), fit.v.dot(m.scatter * fit.v)) / m.count;
    if (spread2.minCoeff() < kFilled * kFilled * width * width) continue;
    const Turned& t = turned.emplace_back(Turned{{1.0, fit.u.dot(m.mean) / width, fit.v.dot(m.mean) / width}, slope->slope, spread2 / (slope->error / m.count)});
    places += t.place * t.place.transpose();
    slopes += t.place * t.slope.transpose();
  }
  std::vector<double> turns;
  if (turned.size() < kFewestOfPatch) return turns;
  const Eigen::Matrix<double, 3, 2> trend = places.ldlt().solve(slopes);
  const double lost = static_cast<double>(turned.size()) / (static_cast<double>(turned.size()) - 3.0);
  for (const Turned& t : turned) {
    const Eigen::Array2d turn = (t.slope - trend.transpose() * t.place).array().square() * t.weight * lost;
    turns.insert(turns.end(), {turn.x(), turn.y()});
  }
  return turns;
}

}  // namespace

Waves waves_of(const VoxelGrid& grid, const Patches& patches, const Context& context) {
  Waves waves{kFinest * 2.0 * grid.edge, {}};
  std::vector<std::vector<std::vector<double>>> turns(patches.patches.size(), std::vector<std::vector<double>>(kWidths));
  parallel_blocks(context, patches.patches.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      const Patch& patch = patches.patches[j];
      if (patch.bowed || patch.cells.size() < kFewestCells) continue;
      double width = waves.finest;
      Windows windows = finest_windows(grid, patch, width);
      for (int k = static_cast<int>(std::lround(std::log2(width / waves.finest))); k < kWidths; ++k, width *= 2.0) {
        std::vector<double> found = turns_of(windows, patch.fit, width);
        if (found.empty()) break;
        turns[j][static_cast<std::size_t>(k)] = std::move(found);
        windows = wider(windows);
      }
    }
  });
  for (std::size_t k = 0; k < kWidths; ++k) {
    std::vector<double> all;
    for (const auto& of_patch : turns) all.insert(all.end(), of_patch[k].begin(), of_patch[k].end());
    if (all.size() < 2 * kFewest) break;
    waves.dependence.push_back(quantile(std::move(all), kQuartile) / kUsual);
  }
  return waves;
}

double Waves::variance(double rms, double spread, double across) const {
  const double width = std::sqrt(12.0) * spread;
  if (dependence.empty() || !(width > 0.0)) return 0.0;
  const auto k = static_cast<std::size_t>(std::max(0L, std::lround(std::log2(width / finest))));
  const std::size_t last = std::min(k, dependence.size() - 1);
  const double wider = std::pow(4.0, static_cast<double>(k - last));  // of points twice as far four times as many are independent
  return dependence[last] / wider * rms * rms / (spread * spread) * std::min(1.0, spread / across);
}

void add_waves(const Waves& waves, Patch& patch) {
  const auto add = [&](double& variance, double& doubt, double systematic, double spread, double across) {
    const double least = waves.variance(patch.fit.rms, spread, across);
    variance = std::max(variance, least);
    doubt = std::max(doubt, least + systematic);
  };
  add(patch.variance_u, patch.doubt_u, patch.systematic_u, patch.fit.spread_u, patch.fit.spread_v);
  add(patch.variance_v, patch.doubt_v, patch.systematic_v, patch.fit.spread_v, patch.fit.spread_u);
}

}  // namespace unseen::planes
