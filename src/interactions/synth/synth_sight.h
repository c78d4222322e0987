// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "interactions/synth/synth_body.h"
#include "interactions/synth/synth_room.h"

namespace unseen::interactions {

/// The bodies in a frame, seen from one camera.
struct Figure {
  Pose pose;
  double trunk_radius = 0, limb_radius = 0;
};

/// Which joints of figure `who` the camera (at `eye`, world) does not see: because of furniture, or another's trunk, limbs or head.
std::array<bool, kJoints> hidden_joints(const Vec3& eye, const std::vector<Figure>& figures, std::size_t who, const std::vector<Object>& objects);

/// What a detector says of a joint over time: an error that lasts, where it is wrong.
struct DetectorOptions {
  double noise = 5;    ///< px
  double fps = 10;
  bool lifted = true;  ///< 3D poses, too
};

/// Detections of one person, by frame; frames in which next to nothing is seen have none.
std::vector<Detection> detect(const View& view, const std::vector<RecordedFrame>& frames, const DetectorOptions& options, Random& random);

}  // namespace unseen::interactions
