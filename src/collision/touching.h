// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "collision/contact.h"

namespace unseen::collision {

/// One way in which two solids, turned as they are, can touch.
struct Touching {
  Vec3 offset;        ///< from the second body's centre to the first's
  Vec3 arm_a, arm_b;  ///< from each centre to the contact point
  Vec3 normal;        ///< unit, from b to a
};

/// The way to touch with the centres' offset along `direction`; nothing if none is found.
std::optional<Touching> touch_along(const Solid& a, const Quat& q_a, const Solid& b, const Quat& q_b, const Vec3& direction);

}  // namespace unseen::collision
