// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>
#include <vector>

#include "cuboids/statics/statics.h"

namespace unseen::cuboids {

/// Roughly the load (N) that passes through each contact point: every body's weight flows to what is static
/// like a current through equal resistors. Says how large forces are before any balance is known; neither
/// levers nor directions count. 0 between static bodies.
std::vector<double> contact_loads(std::span<const Body> bodies, std::span<const ContactPoint> contacts);

}  // namespace unseen::cuboids
