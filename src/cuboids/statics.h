// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::cuboids {

using Vec6 = Eigen::Matrix<double, 6, 1>;

/// A rigid body as statics sees it.
struct Body {
  double weight = 0;         ///< N
  Vec3 center = Vec3::Zero();  ///< of mass, m
  double half_size = 0;      ///< m, scale of its torques
  bool is_static = false;    ///< bears any load
};

/// A place where body a presses on body b; the normal is unit and points from a to b.
struct ContactPoint {
  int a = -1, b = -1;
  Vec3 position, normal;
  double friction = 0;  ///< μ
};

/// The best balance that contact forces can reach.
struct Balance {
  double residual = 0;        ///< largest over bodies of |force|/weight and |torque|/(weight · half size)
  std::vector<Vec3> forces;   ///< N, on b, one a contact point
  std::vector<Vec6> motion;   ///< unbalanced force/weight and torque/(weight·half size) of each body: the scaled velocity
                              ///< (linear of the centre, angular · half size) with which it starts to collapse
};

/// Minimises ‖Df + w‖ over forces in true friction cones (Eq. 4.2, 4.3), with forces in units of each body's weight
/// and torques in weight × half size. `gravity` is the acceleration in units of g (up is −gravity at rest), so that a
/// tilt or a push can be asked for; default straight down. Static bodies bear anything.
Balance balance(std::span<const Body> bodies, std::span<const ContactPoint> contacts, const Vec3& gravity = -Vec3::UnitZ());

/// Bodies of one group (equal numbers) become one: fixed contacts. Gives the merged bodies, `group` being their index;
/// a group with a static body is static. half_size is that of the whole.
std::vector<Body> merge(std::span<const Body> bodies, std::span<const int> group, int groups);

/// Largest horizontal acceleration (in g, worst of 16 directions, at most `limit`) that the bodies bear with residual
/// below `stable_residual`; 0 if they do not even stand.
double margin(std::span<const Body> bodies, std::span<const ContactPoint> contacts, double stable_residual, double limit = 1.0);
/// Smallest μ in [0, that of the contacts] that still holds; contacts with μ = 0 keep it.
double friction_needed(std::span<const Body> bodies, std::span<const ContactPoint> contacts, double stable_residual);

}  // namespace unseen::cuboids
