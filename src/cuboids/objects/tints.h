// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

/// What a colour is apart from how bright it is: a and b of CIELAB, as they would be under a light of one strength.
using Tint = Vec2;

constexpr double kSameTint = 8.0;  ///< apart at most, within one colour

/// Of each pixel; empty for a frame without colours, and for a fused cloud.
std::vector<Tint> tints_of(const RgbdFrame& frame);

/// How far two tints are apart. Light, shade and the grain of wood make a colour paler or stronger: that counts half.
double difference(const Tint& a, const Tint& b);

/// Whether two tints are of different colours for sure.
bool are_other_tints(const Tint& a, const Tint& b);

/// The tint of points that have nearly all the same one; none without colours.
std::optional<Tint> plain_tint(const Observation& seen, std::span<const int> points);

}  // namespace unseen::cuboids
