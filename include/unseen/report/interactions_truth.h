// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <vector>

#include "unseen/core/options.h"
#include "unseen/interactions/synth.h"

namespace unseen::report {

struct SceneFile {
  std::string path;  ///< inside the scene's folder, with slashes
  std::string text;
};

/// A simulated take as the files of a scene folder:
///   take.json                        the TAKE.json: camera, fps, "joints": "joints", "format": "openpose", people, and "lifted": "lifted.json"
///   joints/NNNNNN_keypoints.json     OpenPose BODY_25, one a frame; thorax ↦ Neck, head ↦ Nose, pelvis ↦ MidHip; the joint "neck" has no place there
///   lifted.json                      if there are 3D poses: {"frames": [{"frame", "people": [16 × [x,y,z] or null]}]}, people as in the joints' file
///   gt/skel_NAME_GT.json             the truth as i3DB has it, in camera coordinates; skel_NAME-K_GT.json for several people
///   gt/skel_NAME_GT_objects/NN_category_part.json  boxes; columns of "axes" are a box's axes, "scales" its full extents
///   gt/actions.txt, gt/actions-K.txt frame and action of the first person, of person K (from 1) after it
///   gt/interacted.json               ids of the objects that somebody uses
///   gt/room.txt, gt/licence.txt      one line each
///   synth.json                       the options that it was made with
std::vector<SceneFile> interactions_scene_files(const interactions::SynthTake& synth, const OptionTable& options);

}  // namespace unseen::report
