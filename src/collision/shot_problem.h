// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "collision/solve/problem.h"
#include "collision/tracks/tracks.h"
#include "unseen/collision/options.h"

namespace unseen::collision {

constexpr double kDownSigma = 0.2;  ///< rad: hand-held cameras look up or down a little, where down is not given

/// The camera with nothing left open: focal lengths from the field of view, the principal point in the middle. Throws InputError if the
/// image size is not known.
ShotCamera complete_camera(const Shot& shot, int width, int height);

/// Direction of gravity that the shot gives, by itself or by a floor's normal.
struct GivenDown {
  Vec3 down;
  double sigma;  ///< rad
};
std::optional<GivenDown> given_down(const Shot& shot);

/// What the solver needs to know of one meeting of flights. The fixed body, if there is one, is the second.
Problem problem_of(const Shot& shot, const Options& options, const ShotCamera& camera, const std::array<Solid, 2>& solids, const Tracks& tracks,
                   const Tracks::Meeting& meeting);

/// Drag of a body, 1/m: ρ·Cd·A/(2m). 0 without mass or size.
double drag_of(const Body& body, const Solid& solid, double drag_coefficient);

}  // namespace unseen::collision
