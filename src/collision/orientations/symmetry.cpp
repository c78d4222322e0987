// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/orientations/symmetry.h"

#include <algorithm>
#include <limits>

namespace unseen::collision {
namespace {

constexpr double kSameShare = 0.01, kToldShare = 0.04;  // shares of the reach or of the longer side: alike up to the first, told apart from the second on

/// An orthonormal frame: along `a`, then `b` across it.
Mat3 frame_of(const Vec3& a, const Vec3& b) {
  Mat3 frame;
  frame.col(0) = a.normalized();
  frame.col(2) = a.cross(b).normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

bool maps_onto_itself(const Mat3& map, const std::vector<Vec3>& corners, double slack) {
  return std::all_of(corners.begin(), corners.end(), [&](const Vec3& c) {
    return std::any_of(corners.begin(), corners.end(), [&](const Vec3& other) { return (map * c - other).norm() < slack; });
  });
}

bool known(const Mat3& map, const std::vector<Mat3>& all) {
  return std::any_of(all.begin(), all.end(), [&](const Mat3& other) { return (map - other).norm() < 0.3; });
}

}  // namespace

Symmetry symmetry_of(const std::vector<Vec3>& corners, double tolerance) {
  Symmetry symmetry{{Quat::Identity()}, {}};
  if (corners.size() < 3) return symmetry;
  const Vec3& first = *std::max_element(corners.begin(), corners.end(), [](const Vec3& a, const Vec3& b) { return a.norm() < b.norm(); });
  const Vec3& second = *std::max_element(corners.begin(), corners.end(), [&](const Vec3& a, const Vec3& b) {
    return first.cross(a).norm() < first.cross(b).norm();
  });
  const double slack = tolerance * first.norm();
  const Mat3 from = frame_of(first, second);
  std::vector<Mat3> turns{Mat3::Identity()};
  for (const Vec3& a : corners) {
    if (std::abs(a.norm() - first.norm()) > slack) continue;
    for (const Vec3& b : corners) {
      if (std::abs(b.norm() - second.norm()) > slack || std::abs((a - b).norm() - (first - second).norm()) > slack) continue;
      if (a.cross(b).norm() < 0.5 * first.cross(second).norm()) continue;
      const Mat3 to = frame_of(a, b), turn = to * from.transpose();
      if (maps_onto_itself(turn, corners, slack) && !known(turn, turns)) {
        turns.push_back(turn);
        symmetry.turns.emplace_back(turn);
      }
      const Mat3 mirror = to * Vec3(1, 1, -1).asDiagonal() * from.transpose();
      if (maps_onto_itself(mirror, corners, slack) && !known(mirror, symmetry.reflections)) symmetry.reflections.push_back(mirror);
    }
  }
  return symmetry;
}

std::vector<Quat> near_turns(const std::vector<Vec3>& corners, const Symmetry& symmetry) {
  constexpr double kNearly = 0.15, kSame = 0.35;  // of the reach; rad
  std::vector<Quat> kinds{Quat::Identity()};
  for (const Quat& g : symmetry_of(corners, kNearly).turns)
    if (std::none_of(kinds.begin(), kinds.end(), [&](const Quat& k) { return angle_between(g, k, symmetry.turns) < kSame; })) kinds.push_back(g);
  kinds.erase(kinds.begin());
  return kinds;
}

std::optional<double> nearly_alike_sides(const Body& body) {
  std::optional<double> least;
  for (int i = 0; body.shape == Shape::box && i < 3; ++i) {
    const double a = body.box[i], b = body.box[(i + 1) % 3], share = std::abs(a - b) / std::max(a, b);
    if (share > kSameShare && share < kToldShare && (!least || share < *least)) least = share;
  }
  return least;
}

std::optional<double> nearly_alike_turn(const std::vector<Vec3>& corners) {
  const std::vector<Quat> alike = symmetry_of(corners, kSameShare).turns;
  std::optional<double> least;
  for (const Quat& g : symmetry_of(corners, kToldShare).turns)
    if (const double angle = Quat::Identity().angularDistance(g); angle_between(g, Quat::Identity(), alike) > 0.3 && (!least || angle < *least)) least = angle;
  return least;
}

Quat nearest_alike(const Quat& q, const Quat& to, const std::vector<Quat>& turns) {
  Quat best = q;
  double most = -1.0;
  for (const Quat& g : turns) {
    const Quat alike = q * g;
    const double agreement = std::abs(alike.dot(to));
    if (agreement > most + 1e-9) most = agreement, best = alike;
  }
  return best;
}

double angle_between(const Quat& a, const Quat& b, const std::vector<Quat>& turns) { return nearest_alike(a, b, turns).angularDistance(b); }

}  // namespace unseen::collision
