// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "collision/solve/contact.h"

namespace unseen::collision {

/// One way in which two solids, turned as they are, can touch.
struct Touching {
  Vec3 offset;        ///< from the second body's centre to the first's
  Vec3 arm_a, arm_b;  ///< from each centre to the contact point
  Vec3 normal;        ///< unit, from b to a
};

/// All ways in which two solids, turned as they are, can touch. Keeps references to both.
class Touchings {
 public:
  Touchings(const Solid& a, const Quat& q_a, const Solid& b, const Quat& q_b);

  /// With the centres' offset along a unit direction; nothing if none is found.
  std::optional<Touching> along(const Vec3& direction) const;

 private:
  std::optional<Proximity> of_polytopes(const Vec3& direction, double& distance) const;
  std::optional<Proximity> with_a_sphere(const Vec3& direction, double& distance) const;

  const Solid &a_, &b_;
  Quat q_a_, q_b_;
  double tolerance_;
  std::vector<MinkowskiFace> faces_;  ///< empty if one is a sphere
};

}  // namespace unseen::collision
