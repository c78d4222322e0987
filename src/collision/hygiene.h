// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "unseen/core/context.h"

namespace unseen::collision {

/// Frames that repeat the one before.
struct Repeats {
  std::vector<char> doubled;
  double frames_each = 1;  ///< frames of the file for each of the film: more than 1 where repeats come at regular places, as conversion to a higher rate leaves them
};

/// `change[k]` is the mean difference of frame k from frame k − 1: tiny against its neighbours' where it repeats that, or small at regular places. `brightness`: the
/// frames' means.
Repeats find_repeats(const std::vector<double>& change, const std::vector<double>& brightness);

/// Spaces the frames that are no repeats evenly, if repeats come at regular places; a repeat keeps the time of what it repeats.
void share_out_times(const Repeats& repeats, std::vector<double>& times);

/// Times of the frames, s, the first at 0: frame / fps where the time stamps are even or useless, else the stamps themselves, or, with
/// `fps`, in its frame times. Warns of uneven stamps.
std::vector<double> frame_times(const std::vector<double>& stamps, double file_fps, std::optional<double> fps, const std::string& name,
                                Context& context);

}  // namespace unseen::collision
