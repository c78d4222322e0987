// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Noise that is correlated over more than a small surface turns it, and the surface itself cannot tell. Large ones can: pieces of them, as large as
// that, are turned from the whole by as much.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "planes/patches/facets.h"
#include "planes/scan/weighted.h"
#include "unseen/core/quantile.h"

namespace unseen::planes {
namespace {

constexpr double kFinest = 2.0;             // scales: the width of the smallest windows; each following ones are twice as wide
constexpr int kWidths = 10;
constexpr double kCells = 4.0;              // in a window, of a patch that fills its box
constexpr std::size_t kFewestCells = 200;   // of a patch that tells,
constexpr std::size_t kFewestOfPatch = 8;   // windows on it,
constexpr double kFewest = 20.0;            // and on all
constexpr double kMostOfPatch = 64.0;       // of which a patch has no more than so many votes: a ground that undulates does not speak for what stands on it
constexpr double kFewestPoints = 12;        // in a window,
constexpr double kFilled = 0.2;             // of its width: their spread along either axis
constexpr double kQuartile = 0.25, kUsual = 0.1015;  // the square of a standard normal variable is below this so often; of windows, and of votes
constexpr double kAlike = 0.1;               // of the excess on other patches: a paraboloid through a small one takes most of its waves
constexpr double kIndependent = 2.0;        // times what independent points leave is none of waves

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
  while (kCells * size.x() * size.y() > static_cast<double>(patch.cells.size()) * width * width) width *= 2.0;  // points far apart
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

/// The squared turns of a patch's windows against a paraboloid through it (curved surfaces have no waves), over what residuals of that size leave of a
/// tilt if all were one observation, without what independent points leave. And the number of windows: 0 if they are too few.
struct Turns {
  double excess = 0;
  std::size_t windows = 0;
};

Turns turns_of(const Windows& windows, const PlaneFit& fit, double width) {
  struct Turned {
    Eigen::Vector3d place;  // 1, and its middle along the patch's axes
    Eigen::Vector2d slope;
    Eigen::Array2d weight;  // of a squared slope
  };
  std::vector<Turned> turned;
  double independent = 0;  // sum over windows
  Mat3 places = Mat3::Zero();
  Eigen::Matrix<double, 3, 2> slopes = Eigen::Matrix<double, 3, 2>::Zero();
  for (const Moments& m : windows.at) {
    if (m.count < kFewestPoints) continue;
    const std::optional<Slope> slope = slope_of(m, fit);
    if (!slope || !(slope->error > 0.0)) continue;
    const Eigen::Array2d spread2 = Eigen::Array2d(fit.u.dot(m.scatter * fit.u), fit.v.dot(m.scatter * fit.v)) / m.count;
    if (spread2.minCoeff() < kFilled * kFilled * width * width) continue;
    const Turned& t = turned.emplace_back(Turned{{1.0, fit.u.dot(m.mean) / width, fit.v.dot(m.mean) / width}, slope->slope, spread2 / (slope->error / m.count)});
    independent += 1.0 / m.count;
    places += t.place * t.place.transpose();
    slopes += t.place * t.slope.transpose();
  }
  if (turned.size() < kFewestOfPatch) return {};
  std::vector<double> turns;
  const Eigen::Matrix<double, 3, 2> trend = places.ldlt().solve(slopes);
  const double lost = static_cast<double>(turned.size()) / (static_cast<double>(turned.size()) - 3.0);
  for (const Turned& t : turned) {
    const Eigen::Array2d turn = (t.slope - trend.transpose() * t.place).array().square() * t.weight * lost;
    turns.insert(turns.end(), {turn.x(), turn.y()});
  }
  return {std::max(quantile(std::move(turns), kQuartile) / kUsual - kIndependent * independent / static_cast<double>(turned.size()), 0.0), turned.size()};
}

/// How much of what waves leave on other patches is left on this one, as its own windows tell, the widest that are enough; all, if none are.
double share_of(const std::vector<Turns>& own, const std::vector<double>& excess) {
  for (std::size_t k = own.size(); k-- > 0;)
    if (own[k].windows > 0) return own[k].excess < kAlike * excess[k] ? own[k].excess / (kAlike * excess[k]) : own[k].excess > 0.0 ? 1.0 : 0.0;
  return 1.0;
}

}  // namespace

double Waves::variance(double rms, double spread, double across) const {
  if (excess.empty() || !(spread > 0.0)) return 0.0;
  const auto wanted = static_cast<std::size_t>(std::max(0L, std::lround(std::log2(std::sqrt(12.0) * spread / finest))));
  const std::size_t known = std::min(wanted, excess.size() - 1);
  const double wider = std::pow(4.0, static_cast<double>(wanted - known));  // of points twice as far four times as many are independent
  return excess[known] / wider * rms * rms / (spread * spread) * std::min(1.0, spread / across);
}

Waves measure_waves(const VoxelGrid& grid, Patches& patches, const Context& context) {
  const std::size_t count = patches.patches.size();
  Waves waves{kFinest * 2.0 * grid.edge, {}};
  std::vector<std::vector<Turns>> turns(count, std::vector<Turns>(kWidths));
  parallel_blocks(context, count, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      const Patch& patch = patches.patches[j];
      if (patch.bowed || patch.cells.size() < kFewestCells) continue;
      double width = waves.finest;
      Windows windows = finest_windows(grid, patch, width);
      for (auto k = static_cast<std::size_t>(std::lround(std::log2(width / waves.finest))); k < kWidths && windows.at.size() >= kFewestOfPatch; ++k, width *= 2.0) {
        turns[j][k] = turns_of(windows, patch.fit, width);
        if (turns[j][k].windows == 0) break;
        windows = wider(windows);
      }
    }
  });
  for (std::size_t k = 0; k < kWidths; ++k) {
    std::vector<std::pair<double, double>> votes;
    double all = 0;
    for (const std::vector<Turns>& of_patch : turns)
      if (of_patch[k].windows > 0) votes.emplace_back(of_patch[k].excess, std::min(static_cast<double>(of_patch[k].windows), kMostOfPatch)), all += votes.back().second;
    if (all < kFewest) break;  // where points are too sparse for the finest, wider ones see relief
    waves.excess.push_back(weighted_quantile(std::move(votes), kQuartile));
  }
  for (std::size_t j = 0; j < count && !waves.excess.empty(); ++j) {
    turns[j].resize(waves.excess.size());
    patches.patches[j].waves = share_of(turns[j], waves.excess);
  }
  return waves;
}

void add_waves(const Waves& waves, Patch& patch) {
  const auto add = [&](double& variance, double& doubt, double systematic, double spread, double across) {
    const double least = patch.waves * waves.variance(patch.fit.rms, spread, across);
    variance = std::max(variance, least);
    doubt = std::max(doubt, least + systematic);
  };
  add(patch.variance_u, patch.doubt_u, patch.systematic_u, patch.fit.spread_u, patch.fit.spread_v);
  add(patch.variance_v, patch.doubt_v, patch.systematic_v, patch.fit.spread_v, patch.fit.spread_u);
}

}  // namespace unseen::planes
