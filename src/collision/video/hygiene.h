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
  std::vector<char> converted;  ///< those of them that come at regular places, as conversion to a higher rate leaves them; empty = it is no conversion
  double frames_each = 1;       ///< then: frames of the file for each of the film
};

/// `change[k]` is the mean difference of frame k from frame k − 1: tiny against its neighbours' where it repeats that, or small at regular places. `brightness`: the
/// frames' means. `moved`: what of the change is more than compression makes, which tells where little moves.
Repeats find_repeats(const std::vector<double>& change, const std::vector<double>& brightness, const std::vector<double>& moved = {});

/// Spaces the frames of a conversion that are no repeats evenly, if the times were even; a repeat keeps the time of what it repeats. True if it did.
bool share_out_times(const Repeats& repeats, std::vector<double>& times);

/// Whether unevenly spaced frames take as long as so many even ones would: Matroska states a duration only, which is no number of frames then.
bool lasts_as_announced(const std::vector<double>& stamps, int announced, double fps);

/// Times of the frames, s, the first at 0: frame / fps where the time stamps are even or useless, else the stamps themselves, or, with
/// `fps`, in its frame times. Warns of uneven stamps.
std::vector<double> frame_times(const std::vector<double>& stamps, double file_fps, std::optional<double> fps, const std::string& name,
                                Context& context);

}  // namespace unseen::collision
