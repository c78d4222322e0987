// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <string>

#include "unseen/interactions/types.h"

namespace unseen::report {

/// scene.glb (binary glTF 2.0): a node an object; for each person a node a joint, empty but for the head, and one a bone, as capsules of the
/// bones' median lengths, with a linear key a frame, in seconds; the camera. The root node turns z up into glTF's y up.
std::string interactions_glb(const interactions::Reconstruction& reconstruction);

inline constexpr std::size_t kMostBvhFrames = 200'000;

/// A person's motion as BVH: y up, +z forward at rest (world x, y, z become x, z, −y), centimetres, rotations Z X Y in degrees, bones of the
/// person's median lengths, arms stretched out at rest. Joints are the sixteen; between pelvis or thorax and what it carries stands a
/// joint of length 0 (right_pelvis, left_pelvis, spine, neck_base, right_collar, left_collar), for those are not rigid. Every pose has the
/// pelvis where it is and each bone's direction as it is. Frames that lack the person are between their neighbours. Empty for a person
/// without frames, and for more than kMostBvhFrames from the first to the last.
std::string interactions_bvh(const interactions::Person& person, double fps);

/// "motion.bvh" for the first person, "motion-1.bvh" for the second, and so on.
std::string bvh_name(std::size_t person);

}  // namespace unseen::report
