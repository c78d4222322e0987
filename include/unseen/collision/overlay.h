// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "unseen/collision/types.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// A frame of the clip with the solution drawn over it.
struct OverlayPicture {
  double time = 0;  ///< s
  int width = 0, height = 0;
  std::string jpeg;
};

/// Draws the solution over the frames in which something flies, and half a second around: outlines of the bodies, the paths of their
/// centres so far, where they touch, the number of the frame; without a flight, circles around what was seen to move. Writes them as a video (MPEG-4; slowed down to 30 frames a second if the
/// shot has more than 60) unless `video` is empty, and gives at most 150 of them, 640 pixels wide, for the page. Nothing for a shot
/// without video or a result in which nothing moves. Throws InputError if the one cannot be read or the other not be written.
std::vector<OverlayPicture> write_overlay(const Shot& shot, const Reconstruction& reconstruction, const std::filesystem::path& video,
                                          Context& context);

}  // namespace unseen::collision
