// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <vector>

#include "unseen/cuboids/evaluate.h"

namespace unseen::cuboids {

/// The truth in the world of the result, which the camera connects.
Truth moved_to_result(const Truth& truth, const Completion& result);

/// Which result boxes (indices) stand for which true box.
struct Matching {
  std::vector<std::vector<int>> pieces;  ///< of each true box, the best one first; empty = not found
  std::vector<int> true_of_result;       ///< −1 = none
};
/// Shares of volume decide where the truth has poses, visible points where not. `truth` is in the result's world.
Matching match_cuboids(const Completion& result, const Truth& truth);
/// Index of the true support for each support of the result: normals within 10°, offsets within 5 cm; −1 = none.
std::vector<int> match_supports(const Completion& result, const Truth& truth);

/// Edges between initial boxes and supports that touch within `tolerance`, all "touching".
std::vector<Contact> initial_contacts(const Completion& result, double tolerance);
/// Edges between things of the result as edges between true things, against the true ones.
GraphScore score_contacts(const std::vector<Contact>& contacts, const Completion& result, const Truth& truth,
                          const Matching& matching);

/// The three baselines' boxes, one for each cuboid of the result.
std::vector<OrientedBox> dropped(const std::vector<OrientedBox>& boxes);
std::vector<OrientedBox> fused(const std::vector<OrientedBox>& boxes);
/// The result's boxes, each grown to span what is fixed to it of the same true box.
std::vector<OrientedBox> joined(const Completion& result, const Matching& matching);

/// Sizes of `box` in the order of the true box's dimensions: by nearest axes, or so that most of them is right without a pose.
Vec3 sizes_like(const OrientedBox& box, const TrueCuboid& truth);

void score_sizes(const Completion& result, const Truth& truth, const Matching& matching, Evaluation& evaluation);
PoseScore score_pose(const Completion& result, const Truth& truth, const Matching& matching);
HiddenPartScore score_hidden_part(const Completion& result, const Truth& truth, const Matching& matching);

}  // namespace unseen::cuboids
