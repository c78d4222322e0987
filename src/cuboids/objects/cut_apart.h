// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>
#include <vector>

#include "cuboids/objects/hollow.h"
#include "cuboids/surfaces/observation.h"

namespace unseen::cuboids {

inline constexpr double kSmallestPiece = 0.02;  // of the points that are cut
inline constexpr double kKept = 0.95;           // of these points are in pieces: a cut along a noisy surface crumbles it

/// A piece of some points has at least so many of them.
double fewest_points(std::size_t all);

/// Connected pieces of some points on one side (1 or 2; 0 = on neither) each; those too small to tell are left out.
std::vector<Piece> pieces_of_sides(const Observation& seen, const Interior& interior, const std::vector<int>& points, std::vector<signed char>& side);

/// Whether much less free space is within the hulls of the pieces than within that of the whole.
bool saves(const Piece& whole, const std::vector<Piece>& cut);

/// Cuts across the axes and at the planes given as long as a piece is hollow by more than a share `hollow` of its hull and a cut saves free space, and joins
/// again what one hull may hold.
std::vector<Piece> cut_apart(const Observation& seen, const Interior& interior, const std::vector<Plane>& planes, const Piece& whole, double hollow,
                             Context& context);

}  // namespace unseen::cuboids
