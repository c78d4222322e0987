// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Two physics engines as referees: what stands still in both stands.
#pragma once

#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::test {

struct RigidBox {
  OrientedBox box;
  double density = 300.0;  ///< kg/m³
  int group = -1;          ///< boxes of equal group ≥ 0 are one rigid body
  bool is_static = false;  ///< never moves; so does the rest of its group
};

/// Boxes under gravity (−z, 9.81 m/s²) and half spaces behind planes whose normals point to where the boxes are.
struct RigidScene {
  std::vector<RigidBox> boxes;
  std::vector<Plane> planes = {Plane{}};
  double friction = 0.7;  ///< μ
};

/// Where the boxes are after a while.
struct Settled {
  std::vector<RigidTransform> poses;  ///< T_after_before of each box, world coordinates
  std::vector<double> moves;          ///< of each box: farthest way of a corner, as a share of its diagonal
  double largest_move = 0;
};

/// MuJoCo: dt 10⁻³ s, elliptic cone, impratio 20, Newton, 5 noslip iterations.
Settled settle_mujoco(const RigidScene& scene, double seconds = 2.0);
/// Bullet: 10 times as large, dt 1/480 s, 100 iterations, margin 5 mm, √μ on each body, no sleeping.
Settled settle_bullet(const RigidScene& scene, double seconds = 2.0);

/// For the engines: boxes of one rigid body share a number; −1 = static.
std::vector<int> rigid_bodies(const RigidScene& scene);
Settled settled_from(const RigidScene& scene, std::vector<RigidTransform> poses);

}  // namespace unseen::test
