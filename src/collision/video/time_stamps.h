// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "unseen/core/context.h"

namespace unseen::collision {

inline constexpr double kUneven = 0.25;  ///< of a frame time

/// Whether unevenly spaced frames take as long as so many even ones would: Matroska states a duration only, which is no number of frames then.
bool lasts_as_announced(const std::vector<double>& stamps, int announced, double fps);

/// Times of the frames, s, the first at 0: frame / fps where the time stamps are even or useless, else the stamps themselves, or, with
/// `fps`, in its frame times. Warns of uneven stamps.
std::vector<double> frame_times(const std::vector<double>& stamps, double file_fps, std::optional<double> fps, const std::string& name,
                                Context& context);

}  // namespace unseen::collision
