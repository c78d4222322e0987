// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "unseen/collision/types.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// What tells that a region is a shadow: nothing but that it is darker than the background, as a grey body in a grey picture is; that it has the
/// background's colour too; or that the background's texture is seen in it.
enum class ShadowSign { light, color, texture };

/// Something that moves before the background, in one frame. Pixels of the decoded frame, not undistorted.
struct Region {
  int frame = 0;
  Vec2 centroid = Vec2::Zero();
  double area = 0;        ///< px²
  double diameter = 0;    ///< least extent, the width of a stadium of the same moments: what motion blur leaves alone
  double circle = 0;      ///< diameter of the bounding circle
  cv::Rect box;
  cv::Mat mask;           ///< 8 bit, of `box`
  Vec3 color = Vec3::Zero();  ///< mean sRGB, 0…255
  bool at_border = false;     ///< cut by the picture's (or the roi's) edge
  bool covered = false;       ///< cut by something before the scene
  bool clipped = false;       ///< the same, or cut by it in a corner only, which of a ball is next to nothing
  bool shadow = false;        ///< all of it could be the background with less light
  ShadowSign sign = ShadowSign::light;  ///< if it is
  double dimmed = 0;          ///< share that was cut off as a shadow for being darker than the background alone
};

/// A video's moving regions, with what was found out about the video itself.
struct Footage {
  int width = 0, height = 0;
  int turn = 0;  ///< degrees clockwise by which the file asked to be turned, and was
  double fps = 0;
  std::vector<double> times;  ///< of each decoded frame, s: frame / fps unless the spacing is known to be uneven
  std::vector<char> doubled;  ///< frames that repeat the one before
  std::vector<std::vector<Region>> regions;  ///< by frame
  std::vector<cv::Mat> shift;  ///< 2×3, frame to the first frame; empty if the camera stood still
  bool moving_camera = false;  ///< more than stabilisation can undo
};

/// Decodes the shot's video twice and finds what moves in it. Warnings about the file go into `context`. Throws InputError (no file,
/// no video stream, one frame, broken file).
Footage find_regions(const Shot& shot, Context& context);

}  // namespace unseen::collision
