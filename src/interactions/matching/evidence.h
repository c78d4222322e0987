// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>
#include <vector>

#include "unseen/interactions/types.h"

namespace unseen::interactions {

/// A scenelet that matches the take at a moment, with its objects in the world; it may have none, which is a vote too.
struct Evidence {
  int moment = 0;     ///< frame; votes of one moment share what it has to say
  double weight = 0;  ///< how well it matches, in any unit
  std::vector<Object> objects;
};

/// Where furniture stands (thesis Section 7.4). A moment's evidence for a cell, superclass and turn is the share of its votes' weight whose
/// object covers the cell; the probability is the mean of the `at_least` moments that say most (so many moments of a second, say, for one
/// may err), times exp(−n), n the number of `walked` positions within 0.15 m of the cell: nobody walks where furniture stands. So it is
/// what the matches themselves hold likely, neither more for a long stay nor less for a short one.
/// Turns count from +y, counter-clockwise, and are where an object's front looks: away from its back; without a back they are all that its
/// largest part's shape allows, two, or four if that is nearly square. `walked`: the pelvis on the ground, of upright people only.
EvidenceMap gather(std::span<const Evidence> votes, std::span<const Vec2> walked, int at_least);

}  // namespace unseen::interactions
