// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "unseen/core/context.h"
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
  std::vector<Vec6> motion;   ///< unbalanced force/weight and torque/(weight·half size) of each body

  /// The virtual velocity with which body i starts to collapse, up to one factor for all: of its centre, and about
  /// it. No contact brakes it (v_n ≥ μ|v_t| at every point, v being the velocity of b against a) and gravity drives
  /// it, which proves that no contact forces hold the bodies. Zero if they are in balance.
  Vec3 velocity(int i, const Body& body) const {
    return body.is_static ? Vec3(Vec3::Zero()) : Vec3(motion[i].head<3>() / body.weight);
  }
  Vec3 angular_velocity(int i, const Body& body) const {
    return body.is_static ? Vec3(Vec3::Zero()) : Vec3(motion[i].tail<3>() / (body.weight * body.half_size));
  }
};

/// When `balance` may stop early.
struct Effort {
  double enough = 0;      ///< a residual with which it need go no further, though it is not the least
  double certain = 1e-8;  ///< share of the sum of squares by which it may miss the least one
  int rounds = 60;        ///< after which it is content with what it has
};

/// Minimises ‖Df + w‖ over forces in true friction cones (Eq. 4.2, 4.3), with forces in units of each body's weight
/// and torques in weight × half size. `gravity` is the acceleration in units of g (up is −gravity at rest), so that a
/// tilt or a push can be asked for; default straight down. Static bodies bear anything. `start` may hold the forces of
/// a similar problem with the same contacts, which makes it faster and changes the result by rounding only.
/// Throws std::invalid_argument for bodies without weight or size that are not static, and Cancelled within one step of
/// the solver if `context` was asked to stop; so do the functions below.
Balance balance(std::span<const Body> bodies, std::span<const ContactPoint> contacts,
                const Vec3& gravity = -Vec3::UnitZ(), std::span<const Vec3> start = {}, const Effort& effort = {},
                const Context& context = {});

/// Bodies of one group (equal numbers) become one: fixed contacts. Gives the merged bodies, `group` being their index;
/// a group with a static body is static. half_size is that of the whole.
std::vector<Body> merge(std::span<const Body> bodies, std::span<const int> group, int groups);

/// Largest horizontal acceleration (in g, worst of 16 directions, at most `limit`) that the bodies bear with residual
/// below `stable_residual`; 0 if they do not even stand.
double margin(std::span<const Body> bodies, std::span<const ContactPoint> contacts, double stable_residual,
              double limit = 1.0, const Context& context = {});
/// Smallest μ in [0, that of the contacts] that still holds; contacts with μ = 0 keep it. The largest μ of the contacts
/// if they do not even stand.
double friction_needed(std::span<const Body> bodies, std::span<const ContactPoint> contacts, double stable_residual,
                       const Context& context = {});

/// μ of a contact between measured bodies: none where its normal is near horizontal (|n·up| < 0.26), since a body that
/// is squeezed between two walls of a measured scene is so by noise, and would seem to stand.
double measured_friction(const Vec3& normal, double friction, const Vec3& up = Vec3::UnitZ());

}  // namespace unseen::cuboids
