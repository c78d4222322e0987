// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/doubt.h"

#include <algorithm>
#include <cmath>

namespace unseen::planes {
namespace {

constexpr std::size_t kEnough = 12;      // tilts
constexpr double kPrecise = 0.3;         // of the systematic doubt: noise that does not hide it
constexpr double kQuantile = 0.75, kUsual = 1.32;  // the square of a standard normal variable is below this so often; tails are heavy
constexpr double kLeast = 0.1;
constexpr double kRough = 2;       // times the typical noise
constexpr double kFewPoints = 15;  // of these, clutter at a rim is a part that large walls do not show

/// Median over the area (m).
double typical_rms(const Patches& patches) {
  std::vector<std::pair<double, double>> rms;  // and area
  double all = 0;
  for (const Patch& patch : patches.patches) {
    rms.emplace_back(patch.fit.rms, patch.area);
    all += patch.area;
  }
  std::sort(rms.begin(), rms.end());
  std::size_t at = 0;
  for (double sum = rms[0].second; sum < 0.5 * all; sum += rms[at].second) ++at;
  return rms[at].first;
}

}  // namespace

double shown_doubt(const Patches& patches, const Selection& s, const std::vector<Vec3>& locals) {
  if (s.frames.empty()) return 1.0;
  std::vector<double> area(s.frames.size(), 0.0);
  for (std::size_t j = 0; j < patches.patches.size(); ++j) area[s.frame_of_patch[j]] += patches.patches[j].area;
  const auto largest = std::max_element(area.begin(), area.end()) - area.begin();
  std::vector<std::pair<const Patch*, int>> members;
  for (std::size_t j = 0; j < patches.patches.size(); ++j)
    if (s.frame_of_patch[j] == largest) members.emplace_back(&patches.patches[j], s.local_of_patch[j]);
  const OrientationFrame frame = refit_frame(s.frames[largest], locals, members);
  std::vector<std::pair<double, double>> squares;  // of tilts, over the systematic doubt; the patch's area
  double all = 0;
  for (const auto& [patch, local] : members) {
    const Vec3 n = frame.direction(locals[local]);
    const double across = std::abs(n.dot(patch->fit.normal));
    const auto add = [&](const Vec3& axis, double doubt, double systematic) {
      if (systematic > 0 && doubt - systematic < kPrecise * systematic) {
        squares.emplace_back(std::pow(n.dot(axis) / across, 2) / systematic, patch->area);
        all += patch->area;
      }
    };
    add(patch->fit.u, patch->doubt_u, patch->systematic_u);
    add(patch->fit.v, patch->doubt_v, patch->systematic_v);
  }
  if (squares.size() < kEnough) return 1.0;
  std::sort(squares.begin(), squares.end());
  std::size_t at = 0;
  for (double sum = squares[0].second; sum < kQuantile * all; sum += squares[at].second) ++at;
  const double safety = 2 + 4 / std::sqrt(static_cast<double>(squares.size()));
  return std::clamp(safety * std::sqrt(squares[at].first / kUsual), kLeast, 1.0);
}

void reduce_doubt(Patches& patches, double from, double to) {
  const double typical = typical_rms(patches);
  for (Patch& patch : patches.patches) {
    const bool rough = patch.fit.rms > kRough * typical;  // two sides of a wall, or more than one thing
    const double least = rough ? 1.0 : std::min(1.0, kFewPoints / patch.moments.count);
    const double kept = std::max(to * to, least) / std::max(from * from, least);
    const auto reduce = [&](double& doubt, double& systematic) {
      if (!std::isfinite(systematic)) return;  // points in a line say nothing about one of the tilts
      doubt -= (1 - kept) * systematic;
      systematic *= kept;
    };
    reduce(patch.doubt_u, patch.systematic_u);
    reduce(patch.doubt_v, patch.systematic_v);
  }
}

}  // namespace unseen::planes
