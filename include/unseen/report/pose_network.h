// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>

#include "unseen/core/context.h"
#include "unseen/core/options.h"
#include "unseen/interactions/types.h"

namespace unseen::report {

/// How a picture becomes the input of a network.
struct PoseNetworkOptions {
  int height = 368;            ///< px of the input
  int width = 0;               ///< px; 0: as the video's sides are to each other, rounded up to a multiple of 8
  double scale = 1.0 / 255.0;  ///< of colours, which are 0…255
  double mean = 0;             ///< of colours, subtracted first
  bool rgb = false;            ///< red comes first; else blue
  double hfov_deg = 60;        ///< horizontal field of view of the video's camera
};

/// The one description of these options; the table points into `options`.
OptionTable describe(PoseNetworkOptions& options);

/// Joints of the one person that a network sees in a video. The network is the user's: ONNX, or Caffe with its .prototxt beside it under
/// the same name; OpenCV runs it. Input: 1 × 3 × height × width. Output: heat maps, 1 × C × rows × columns, that cover the input; by C:
///   16, 17       our joints in their order (and background)
///   18, 19, 57   COCO-18 of OpenPose (background, part affinities)
///   25, 26, 78   BODY_25 of OpenPose (the same)
/// A joint is at the peak of its map, its confidence the map's value there, in [0,1]. Throws InputError for a network or video that cannot be
/// read or is of none of these forms, and for a video in which nobody is.
interactions::Take detect_poses(const std::filesystem::path& model, const std::filesystem::path& video, const PoseNetworkOptions& options,
                                Context& context);

}  // namespace unseen::report
