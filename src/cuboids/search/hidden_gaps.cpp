// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "cuboids/search/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kSmallGap = 2.5;  // tolerances
constexpr double kLevelCosine = 0.7;   // cosine
constexpr double kFacing = 0.95;   // cosine between the move and the contact it makes

/// m, from a face of a box to the nearest body in its way, if that is near but not met yet; 0 if there is none.
double small_gap(const Problem& problem, const std::vector<ConvexSolid>& solids, const std::vector<char>& meets, int body, int face,
                 double room) {
  const int first = problem.supports_count();
  const OrientedBox& box = problem.cuboid(body).initial;
  double nearest = 0.0;
  for (int other = 0; other < problem.bodies(); ++other) {
    if (other == body) continue;
    const bool support = problem.is_support(other);
    const double tolerance = problem.pair_tolerance(std::min(body, other), std::max(body, other));
    const auto gap = support ? reach(box, face, problem.supports[other]) : reach(box, face, solids[other - first], tolerance);
    if (!gap || *gap > std::min(kSmallGap * tolerance, room)) continue;
    if (meets[other]) return 0.0;
    const ConvexSolid grown = solid_of(extended(box, face, *gap));
    const auto meet = support ? interface_of(problem.supports[other], grown, tolerance) : interface_of(solids[other - first], grown, tolerance);
    if (meet && std::abs(meet->normal.dot(face_normal(box, face))) > kFacing) nearest = nearest > 0.0 ? std::min(nearest, *gap) : *gap;
  }
  return nearest;
}

}  // namespace

void close_hidden_gaps(Rooms& rooms, Problem& problem) {
  std::vector<ConvexSolid> solids;
  for (const Cuboid& cuboid : problem.cuboids) solids.push_back(solid_of(cuboid.initial));
  std::vector<std::vector<char>> meet(problem.bodies(), std::vector<char>(problem.bodies(), 0));
  for (const Touch& touch : touching_pairs(problem, arrange(problem, {}))) meet[touch.a][touch.b] = meet[touch.b][touch.a] = 1;
  for (std::size_t i = 0; i < solids.size(); ++i)
    for (int face = 0; face < 6; ++face) {
      OrientedBox& box = problem.cuboids[i].initial;
      if (std::abs(face_normal(box, face).z()) < kLevelCosine || rooms[i][face] < kHiddenRoom * problem.tolerance[i]) continue;
      const int body = problem.supports_count() + static_cast<int>(i);
      const double length = small_gap(problem, solids, meet[body], body, face, rooms[i][face]);
      if (length <= 0.0) continue;
      box = extended(box, face, length);
      solids[i] = solid_of(box);
      rooms[i][face] -= length;
    }
}

}  // namespace unseen::cuboids
