// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "unseen/core/context.h"

namespace unseen::collision {

/// Frames that repeat the one before: `change[k]` is the mean difference of frame k from frame k − 1, tiny against its neighbours'.
std::vector<char> doubled_frames(const std::vector<double>& change);

/// Times of the frames, s, the first at 0: frame / fps where the time stamps are even or useless, else the stamps themselves, or, with
/// `fps`, in its frame times. Warns of uneven stamps.
std::vector<double> frame_times(const std::vector<double>& stamps, double file_fps, std::optional<double> fps, const std::string& name,
                                Context& context);

}  // namespace unseen::collision
