// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

namespace unseen::collision {

/// Frames that repeat the one before.
struct Repeats {
  std::vector<char> doubled;
  std::vector<char> converted;  ///< those of them that come at regular places, as conversion to a higher rate leaves them; empty = it is no conversion
  double frames_each = 1;       ///< then: frames of the file for each of the film
};

/// `change[k]` is the mean difference of frame k from frame k − 1: tiny against its neighbours' where it repeats that, or small at regular places. `brightness`: the
/// frames' means. `moved`: what of the change is more than compression makes, which tells where little moves.
Repeats find_repeats(const std::vector<double>& change, const std::vector<double>& brightness, const std::vector<double>& moved = {});

/// Spaces the frames of a conversion that are no repeats evenly, if the times were even; a repeat keeps the time of what it repeats. True if it did.
bool share_out_times(const Repeats& repeats, std::vector<double>& times);

}  // namespace unseen::collision
