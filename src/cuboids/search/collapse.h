// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "cuboids/search/problem.h"

namespace unseen::cuboids {

/// A rigid motion of a body: velocity of the world's origin, and angular velocity.
struct Twist {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
  Vec3 at(const Vec3& p) const { return linear + angular.cross(p); }
  bool is_zero() const { return linear.isZero(0.0) && angular.isZero(0.0); }
};

/// A way in which an arrangement collapses: gravity does work, and no contact resists. It proves the same of every
/// other arrangement that does not resist it either.
struct Collapse {
  Vec3 gravity = -Vec3::UnitZ();  ///< g, a push included
  std::vector<Twist> motion;  ///< a body; zero for those that stay
};

/// Smallest residual that the collapse proves for an arrangement; 0 if some contact resists it.
double proven_residual(const Collapse& collapse, const Problem& problem, const Arrangement& arrangement,
                       const std::vector<Touch>& touches, const std::vector<char>& held);

/// What the unbalanced rest of an arrangement's best balance would set in motion.
Collapse motion_left(const Balance& balance, const Vec3& gravity, const Structure& structure, const Problem& problem);

/// Collapses of an unstable arrangement from that motion, as small as can be: single bodies and groups that move by themselves
/// where these suffice. None if numbers are too close to call.
std::vector<Collapse> collapses_of(const Collapse& motion, const Problem& problem, const Arrangement& arrangement,
                                   const std::vector<Touch>& touches, const std::vector<char>& held);

/// Hypotheses of which at least one must hold in every arrangement, beyond those chosen, that the collapse does not rule
/// out, but for those that are closed (a mark each). `largest` has every face moved as far as any hypothesis asks.
std::vector<int> remedies(const Collapse& collapse, const Problem& problem, const Arrangement& arrangement,
                          const Arrangement& largest, const std::vector<char>& held, const std::vector<char>& closed);

}  // namespace unseen::cuboids
