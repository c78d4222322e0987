// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "planes/select.h"

namespace unseen::planes {
namespace {

constexpr double kCluster = 0.3 * kPi / 180.0;   // normals this close are one direction
constexpr double kClosing = 5.0 * kPi / 180.0;   // pairs this far from an angle of Θ close no frame
constexpr std::size_t kDirections = 200, kAnchors = 30, kFrames = 300;
constexpr double kWorth = 2.0;  // a patch that a frame leaves unexplained counts no more than this

struct Direction {
  Vec3 normal;
  double area;
};

std::vector<Direction> cluster_normals(const Patches& patches, const std::vector<int>& members, double radius) {
  std::vector<Direction> directions;
  for (const int j : members) {
    const Patch& patch = patches.patches[j];
    auto it = std::find_if(directions.begin(), directions.end(), [&](const Direction& d) {
      return line_angle(d.normal, patch.fit.normal) < radius;
    });
    if (it != directions.end()) {
      it->area += patch.area;
    } else {
      directions.push_back({patch.fit.normal, patch.area});
    }
  }
  std::stable_sort(directions.begin(), directions.end(),
                   [](const Direction& a, const Direction& b) { return a.area > b.area; });
  return directions;
}

/// True if two closed frames have the same axes, in whatever order.
bool same(const OrientationFrame& a, const OrientationFrame& b) {
  static const double least = std::cos(kCluster / 3);
  const Mat3 cosines = (a.axes.transpose() * b.axes).cwiseAbs();
  return (cosines.rowwise().maxCoeff().array() >= least).all();
}

}  // namespace

std::vector<OrientationFrame> propose_frames(const Patches& patches, const std::vector<int>& members,
                                             const std::vector<OrientationFrame>& given, const AngleSet& angles,
                                             const Space& space, double patch_angle, const Context& context) {
  std::vector<Direction> directions = cluster_normals(patches, members, kCluster);
  if (directions.size() > kDirections) directions.resize(kDirections);
  std::vector<OrientationFrame> frames;
  for (const Direction& d : directions) frames.push_back(open_frame(d.normal, space));
  if (space.is_2d()) return frames;

  std::vector<Vec3> anchors;
  for (const OrientationFrame& f : given)
    for (int a = 0; a < (f.closed ? 3 : 1) && anchors.size() < 3 * kAnchors; ++a) anchors.push_back(f.axes.col(a));
  for (std::size_t i = 0; i < std::min(directions.size(), kAnchors); ++i) anchors.push_back(directions[i].normal);

  std::vector<OrientationFrame> closed;
  for (const Direction& d : directions)
    for (const Vec3& anchor : anchors) {
      const double angle = line_angle(anchor, d.normal);
      if (angle < kClosing || angles.deviation(angle) > kClosing) continue;
      OrientationFrame frame = close_frame(anchor, d.normal, space);
      if (std::none_of(closed.end() - std::min<std::ptrdiff_t>(64, closed.size()), closed.end(),
                       [&](const OrientationFrame& f) { return same(f, frame); }))
        closed.push_back(std::move(frame));
    }

  // The closed frames that explain the most patches.
  const std::vector<Vec3> locals = local_directions(angles, space);
  std::vector<std::pair<double, std::size_t>> ranked(closed.size());
  parallel_blocks(context, closed.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      double worth = 0;
      for (const int j : members)
        worth += std::max(0.0, kWorth - best_candidate(patches.patches[j], closed[k], locals, patch_angle).cost);
      ranked[k] = {-worth, k};
    }
  });
  std::stable_sort(ranked.begin(), ranked.end());
  for (const auto& [worth, k] : ranked) {
    if (frames.size() >= directions.size() + kFrames) break;
    if (std::none_of(frames.begin() + static_cast<std::ptrdiff_t>(directions.size()), frames.end(),
                     [&, k = k](const OrientationFrame& f) { return same(f, closed[k]); }))
      frames.push_back(closed[k]);
  }
  return frames;
}

}  // namespace unseen::planes
