// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "cuboids/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kSmallGap = 2.5;  // tolerances
constexpr double kHidden = 2.0;    // tolerances: a face with less room is one that was seen
constexpr double kUpright = 0.7;   // cosine
constexpr double kFacing = 0.95;   // cosine between the move and the contact it makes

bool makes_contact(const std::optional<Interface>& meet, const Vec3& direction) {
  return meet && std::abs(meet->normal.dot(direction)) > kFacing;
}

}  // namespace

void close_hidden_gaps(const Rooms& rooms, Problem& problem) {
  std::vector<ConvexSolid> solids;
  for (const Cuboid& cuboid : problem.cuboids) solids.push_back(solid_of(cuboid.initial));
  std::vector<std::vector<char>> meet(problem.bodies(), std::vector<char>(problem.bodies(), 0));
  for (const Touch& touch : touching_pairs(problem, arrange(problem, {}))) meet[touch.a][touch.b] = meet[touch.b][touch.a] = 1;
  const int first = problem.supports_count();
  for (int body = first; body < problem.bodies(); ++body)
    for (int face = 0; face < 6; ++face) {
      const int i = body - first;
      if (std::abs(face_normal(problem.cuboids[i].initial, face).z()) < kUpright) continue;
      if (rooms[i][face] < kHidden * problem.tolerance[i]) continue;
      OrientedBox& box = problem.cuboids[i].initial;
      double length = 0.0;
      for (int other = 0; other < problem.bodies(); ++other) {
        if (other == body) continue;
        const bool support = problem.is_support(other);
        const double tolerance = problem.pair_tolerance(std::min(body, other), std::max(body, other));
        const auto gap = support ? reach(box, face, problem.supports[other]) : reach(box, face, solids[other - first], tolerance);
        if (!gap || *gap > std::min(kSmallGap * tolerance, rooms[i][face])) continue;
        if (meet[body][other]) {
          length = 0.0;
          break;
        }
        Extension extension{};
        extension[face] = *gap;
        const ConvexSolid grown = solid_of(extended(box, extension));
        if (makes_contact(support ? interface_of(problem.supports[other], grown, tolerance)
                                  : interface_of(solids[other - first], grown, tolerance), face_normal(box, face)))
          length = length > 0.0 ? std::min(length, *gap) : *gap;
      }
      if (length <= 0.0) continue;
      Extension extension{};
      extension[face] = length;
      box = extended(box, extension);
      solids[i] = solid_of(box);
    }
}

}  // namespace unseen::cuboids
