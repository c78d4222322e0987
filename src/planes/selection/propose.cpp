// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "planes/selection/select.h"

namespace unseen::planes {
namespace {

constexpr double kCluster = 0.3 * kPi / 180.0;   // normals this close are one direction
constexpr double kClosing = 5.0 * kPi / 180.0;   // pairs this far from an angle of Θ close no frame
constexpr std::size_t kDirections = 200, kAnchors = 30, kFrames = 300;
constexpr double kWorth = 2.0;  // a patch that a frame leaves unexplained counts no more than this
constexpr double kLeastGain = 0.1;  // … and a frame must explain that much more than those before it

struct NormalCluster {
  Vec3 normal;
  double area;
};

std::vector<NormalCluster> cluster_normals(const Patches& patches, const std::vector<int>& members, double radius) {
  std::vector<NormalCluster> directions;
  for (const int j : members) {
    const Patch& patch = patches.patches[j];
    auto it = std::find_if(directions.begin(), directions.end(), [&](const NormalCluster& d) {
      return line_angle(d.normal, patch.fit.normal) < radius;
    });
    if (it != directions.end()) {
      it->area += patch.area;
    } else {
      directions.push_back({patch.fit.normal, patch.area});
    }
  }
  std::stable_sort(directions.begin(), directions.end(),
                   [](const NormalCluster& a, const NormalCluster& b) { return a.area > b.area; });
  return directions;
}

/// True if two closed frames have the same axes, in whatever order.
bool same(const OrientationFrame& a, const OrientationFrame& b) {
  static const double least = std::cos(kCluster / 3);
  const Mat3 cosines = (a.axes.transpose() * b.axes).cwiseAbs();
  return (cosines.rowwise().maxCoeff().array() >= least).all();
}

/// Frames that explain patches: first each that explains most of what those before it leave unexplained, so that a
/// majority does not crowd out the rest, then those that explain most.
std::vector<OrientationFrame> most_telling(const std::vector<OrientationFrame>& frames, const Patches& patches,
                                           const std::vector<int>& members, const std::vector<Vec3>& locals,
                                           double patch_angle, const Context& context) {
  std::vector<std::vector<Offer>> offers(frames.size());
  std::vector<double> unexplained(patches.patches.size(), kWorth);
  const auto worth = [&](std::size_t k) {
    double sum = 0;
    for (const Offer& o : offers[k]) sum += std::max(0.0, unexplained[o.patch] - o.cost);
    return sum;
  };
  std::vector<std::pair<double, std::size_t>> ranked(frames.size());
  parallel_blocks(context, frames.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      for (const int j : members)
        if (const double cost = best_candidate(patches.patches[j], frames[k], locals, patch_angle).cost; cost < kWorth)
          offers[k].push_back({j, cost});
      ranked[k] = {worth(k), k};
    }
  });
  const auto less = [](const auto& a, const auto& b) { return a.first < b.first || (a.first == b.first && a.second > b.second); };
  std::vector<OrientationFrame> chosen;
  const auto choose = [&](std::size_t k) {
    if (std::none_of(chosen.begin(), chosen.end(), [&](const OrientationFrame& f) { return same(f, frames[k]); }))
      chosen.push_back(frames[k]);
  };
  // What a frame adds only shrinks, so one whose stale worth is not the largest need not be looked at.
  std::vector<std::pair<double, std::size_t>> queue = ranked;
  std::make_heap(queue.begin(), queue.end(), less);
  while (!queue.empty() && chosen.size() < kFrames) {
    std::pop_heap(queue.begin(), queue.end(), less);
    const std::size_t k = queue.back().second;
    queue.back().first = worth(k);
    if (queue.back().first < kLeastGain) {
      queue.pop_back();
    } else if (queue.size() > 1 && less(queue.back(), queue.front())) {
      std::push_heap(queue.begin(), queue.end(), less);
    } else {
      queue.pop_back();
      choose(k);
      for (const Offer& o : offers[k]) unexplained[o.patch] = std::min(unexplained[o.patch], o.cost);
    }
  }
  std::sort(ranked.begin(), ranked.end(), [&](const auto& a, const auto& b) { return less(b, a); });
  for (std::size_t i = 0; i < ranked.size() && chosen.size() < kFrames; ++i) choose(ranked[i].second);
  return chosen;
}

}  // namespace

std::vector<OrientationFrame> propose_frames(const Patches& patches, const std::vector<int>& members,
                                             const std::vector<OrientationFrame>& given, const AngleSet& angles,
                                             const Space& space, double patch_angle, const Context& context) {
  std::vector<NormalCluster> directions = cluster_normals(patches, members, kCluster);
  if (directions.size() > kDirections) directions.resize(kDirections);
  std::vector<OrientationFrame> frames;
  for (const NormalCluster& d : directions) frames.push_back(open_frame(d.normal, space));
  if (space.is_2d()) return frames;

  std::vector<Vec3> anchors;
  for (const OrientationFrame& f : given)
    for (int a = 0; a < (f.closed ? 3 : 1) && anchors.size() < 3 * kAnchors; ++a) anchors.push_back(f.axes.col(a));
  for (std::size_t i = 0; i < std::min(directions.size(), kAnchors); ++i) anchors.push_back(directions[i].normal);

  std::vector<OrientationFrame> closed;
  const auto close = [&](const Vec3& a, const Vec3& b) {
    const double angle = line_angle(a, b);
    if (angle < kClosing || angles.deviation(angle) > kClosing) return;
    OrientationFrame frame = close_frame(a, b, space);
    if (std::none_of(closed.end() - std::min<std::ptrdiff_t>(64, closed.size()), closed.end(),
                     [&](const OrientationFrame& f) { return same(f, frame); }))
      closed.push_back(std::move(frame));
  };
  for (const NormalCluster& d : directions)
    for (const Vec3& anchor : anchors) close(anchor, d.normal);
  std::vector<char> generates(patches.patches.size(), 0);
  for (const int j : members) generates[j] = 1;
  for (const auto& [a, b] : patches.adjoining)
    if (generates[a] || generates[b]) close(patches.patches[a].fit.normal, patches.patches[b].fit.normal);

  const std::vector<OrientationFrame> chosen = most_telling(closed, patches, members, local_directions(angles, space), patch_angle, context);
  frames.insert(frames.end(), chosen.begin(), chosen.end());
  return frames;
}

}  // namespace unseen::planes
