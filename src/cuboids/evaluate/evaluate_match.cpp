// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <tuple>

#include "cuboids/evaluate/evaluate_parts.h"

namespace unseen::cuboids {
namespace {

constexpr double kLeastOverlap = 0.1;    // intersection over union that makes two boxes the same
constexpr double kMostlyWithin = 0.5;    // share of a piece that lies in the true box
constexpr double kNear = 0.015;          // m, a visible point this near a box is on it
constexpr double kSameDirection = radians(10.0), kSameOffset = 0.05;  // rad, m

/// How much a result box and a true box are the same: at least as a whole, or the one as a piece of the other.
struct Pair {
  double score;
  int result, truth;
  bool whole;
};

std::vector<Pair> pairs_by_volume(const Completion& result, const Truth& truth) {
  std::vector<Pair> pairs;
  for (int r = 0; r < static_cast<int>(result.cuboids.size()); ++r)
    for (int t = 0; t < static_cast<int>(truth.cuboids.size()); ++t) {
      const OrientedBox &box = result.cuboids[r].box, &initial = result.cuboids[r].initial, &real = *truth.cuboids[t].box;
      const double both = intersection_volume(box, real);
      const double of_initial = intersection_volume(initial, real) / std::max(initial.volume(), 1e-12);
      const double score = both / (box.volume() + real.volume() - both);
      // The initial box is where points were seen: what it shares with a true box tells even if the rest went wrong.
      const bool piece = both > kMostlyWithin * box.volume() || of_initial > kMostlyWithin;
      if (score >= kLeastOverlap || piece) pairs.push_back({score, r, t, score >= kLeastOverlap || of_initial > kMostlyWithin});
    }
  return pairs;
}

std::vector<Pair> pairs_by_points(const Completion& result, const Truth& truth) {
  std::vector<Pair> pairs;
  for (int r = 0; r < static_cast<int>(result.cuboids.size()); ++r) {
    OrientedBox around = result.cuboids[r].initial;
    around.half_size.array() += kNear;
    for (int t = 0; t < static_cast<int>(truth.cuboids.size()); ++t) {
      std::size_t inside = 0;
      for (const Vec3& p : truth.cuboids[t].points) inside += around.contains(result.T_world_camera * p);
      const double share = truth.cuboids[t].points.empty()
                               ? 0.0
                               : static_cast<double>(inside) / static_cast<double>(truth.cuboids[t].points.size());
      if (share > 0.02) pairs.push_back({share, r, t, true});
    }
  }
  return pairs;
}

}  // namespace

Truth moved_to_result(const Truth& truth, const Completion& result) {
  Truth moved = truth;
  const RigidTransform T = result.T_world_camera * truth.T_world_camera.inverse();
  for (TrueCuboid& cuboid : moved.cuboids)
    if (cuboid.box) {
      cuboid.box->center = T * cuboid.box->center;
      cuboid.box->axes = T.rotation * cuboid.box->axes;
    }
  for (Support& support : moved.supports) {
    support.plane.normal = T.rotation * support.plane.normal;
    support.plane.offset += support.plane.normal.dot(T.translation);
    for (Vec3& corner : support.outline) corner = T * corner;
  }
  moved.T_world_camera = result.T_world_camera;
  return moved;
}

Matching match_cuboids(const Completion& result, const Truth& truth) {
  const bool poses = std::all_of(truth.cuboids.begin(), truth.cuboids.end(), [](const auto& c) { return c.box.has_value(); });
  std::vector<Pair> pairs = poses ? pairs_by_volume(result, truth) : pairs_by_points(result, truth);
  std::sort(pairs.begin(), pairs.end(), [](const Pair& a, const Pair& b) {
    return std::tuple(-a.score, a.result, a.truth) < std::tuple(-b.score, b.result, b.truth);
  });
  Matching matching;
  matching.pieces.resize(truth.cuboids.size());
  matching.true_of_result.assign(result.cuboids.size(), -1);
  const auto take = [&](const Pair& pair) {
    matching.pieces[pair.truth].push_back(pair.result);
    matching.true_of_result[pair.result] = pair.truth;
  };
  for (const Pair& pair : pairs)
    if (pair.whole && matching.true_of_result[pair.result] < 0 && matching.pieces[pair.truth].empty()) take(pair);
  for (const Pair& pair : pairs)
    if (matching.true_of_result[pair.result] < 0) take(pair);
  return matching;
}

std::vector<int> match_supports(const Completion& result, const Truth& truth) {
  const bool has_poses = !truth.cuboids.empty() && truth.cuboids.front().box.has_value();
  std::vector<int> matched;
  for (const Support& support : result.supports) {
    int best = -1;
    double least = kSameOffset;
    for (int t = 0; t < static_cast<int>(truth.supports.size()); ++t) {
      const Support& real = truth.supports[t];
      if (!has_poses) {  // nor have supports: the kind has to do
        if (best < 0 && real.kind == support.kind) best = t;
        continue;
      }
      const double angle = std::acos(std::clamp(support.plane.normal.dot(real.plane.normal), -1.0, 1.0));
      const double apart = std::abs(support.plane.offset - real.plane.offset);
      if (angle < kSameDirection && apart < least) {
        best = t;
        least = apart;
      }
    }
    matched.push_back(best);
  }
  return matched;
}

}  // namespace unseen::cuboids
