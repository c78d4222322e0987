// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/interactions/types.h"

namespace unseen::interactions {

/// The person, 0 to take.people − 1, of each detection; −1 for nobody. In each frame a person has one detection or is not seen, and a
/// detection belongs to one person at most (Eq. 6.17 with its quantifiers put right). Exact minimum of path_cost() over all people: a
/// minimum-cost flow, within branch and bound where labels would have one path be two people (in long takes the best of a bounded search).
/// Who is expected alone and seen alone is that person. Labels and detections that name a person are kept. Unlike the design's first model, somebody unseen for up to three seconds is
/// expected where his way leads, and coming back costs little enough to pay: at a price of 10³ nobody missed for one frame would ever
/// return within 500. Throws InputError for labels that name nobody or contradict each other.
std::vector<int> identify(const Take& take);

}  // namespace unseen::interactions
