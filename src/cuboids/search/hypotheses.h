// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cuboids/search/problem.h"
#include "cuboids/search/reach.h"
#include "cuboids/surfaces/depth_view.h"

namespace unseen::cuboids {

/// m: how far each face of each cuboid may move outward before it enters space that the view proves free; sideways also
/// no farther than its upper edge stays covered, nor than the longest side that was seen. None for what nobody saw.
using Rooms = std::vector<Extension>;
Rooms find_rooms(const DepthView& view, const std::vector<Cuboid>& cuboids, const std::vector<double>& tolerance);

/// Whether nobody could have seen that a box reaches `distance` farther at a face: there, nearly all of its upper edge is hidden,
/// on what was measured, or outside the picture. Where nothing was measured, the surface of the box would have been.
bool is_covered(const DepthView& view, const OrientedBox& box, int face, double distance, double tolerance);

/// Contacts that pairs of bodies may have through hidden space (design page, step 5; thesis Fig. 4.7). Touching: a
/// face moves until it meets the other body; or the lower body grows sideways under the upper one, or the upper one
/// sideways over the lower one, to where it just bears, to the centre of mass, or to the far end. Fixed: the same with
/// the least single move. Pairs that touch already need no hypothesis to touch, only one to be fixed.
std::vector<Hypothesis> propose_contacts(const Problem& problem, const Rooms& rooms);

inline constexpr double kFreeShare = 0.05;  ///< of samples: speckle and edges of the depth image
inline constexpr double kHiddenRoom = 2.0;  ///< tolerances: a face with less room is one that was seen
/// True if what a box adds to `known` ones lies in space that the view does not prove free, but for a share of it.
bool in_hidden_space(const DepthView& view, std::span<const OrientedBox> known, const OrientedBox& box, double margin,
                     double share = kFreeShare);
/// Share of what a box adds to `known` ones that lies in another box, deeper than a margin (m).
double share_inside(std::span<const OrientedBox> known, const OrientedBox& box, const OrientedBox& other, double margin);

}  // namespace unseen::cuboids
