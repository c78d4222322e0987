// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "collision/solve/problem.h"

namespace unseen::collision {

/// Where the shapes meet in this state; nothing where a shape or its orientation is not known.
std::optional<Proximity> touch_of(const Problem& problem, const State& state);

/// Where the impulse of this state may have acted on shapes that touch so.
Vec3 contact_start(const Problem& problem, const Proximity& touch, const State& state);

/// How the contact's normal follows the bodies, where it does not follow the impulse.
std::optional<ContactLaw> law_of(const Problem& problem, const State& state, const std::optional<Proximity>& touch);

}  // namespace unseen::collision
