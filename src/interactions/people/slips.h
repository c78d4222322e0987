// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>

#include "unseen/interactions/types.h"

namespace unseen::interactions {

/// The joint of the other side of the body; that of the middle itself.
constexpr int other_side(int joint) { return joint <= left_ankle ? left_ankle - joint : joint >= right_wrist ? right_wrist + left_wrist - joint : joint; }

/// px²: how far joints must have moved to have jumped alone, from the squared motions of all that are seen: three times as far as the median, which noise adds to.
/// `squares` are left in another order.
double lone_jump(std::span<double> squares);

/// Undoes two slips of detectors, by the same person's detections before and after. Every detection has its person.
/// Left taken for right, mostly of who is seen from behind: legs or arms that for up to 0.3 s jump there and back, and hardly do so exchanged, are
/// exchanged. A joint put somewhere else: one that alone jumps there and back within 0.14 s, as no limb can, counts as not seen.
void undo_slips(Take& take);

}  // namespace unseen::interactions
