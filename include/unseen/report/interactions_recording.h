// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <vector>

#include "unseen/interactions/types.h"

namespace unseen::report {

/// Reads the truth of a scene folder (docs/formats.md), as i3DB and `unseen synth interactions` have it, all in camera coordinates:
///   gt/skel_NAME_GT.json          one a person, sorted by name: "3d", "occluded", "confidence"; frames whose confidence is all 0 are left out
///   gt/*_objects/NN_label_part.json  boxes; NN is the object
///   gt/actions.txt                frame and action a line, of the first person; actions-1.txt is the second's, and so on
///   gt/interacted.json            optional: the ids of the objects that somebody uses
///   gt/room.txt, gt/licence.txt   optional: one line; without the first, the room is the folder's name
///   take.json                     optional: its "fps" (10 without it)
/// The world: up is the mean of the boxes' own up axes (the camera's −y if there is no box), the floor is where the boxes stand (0.1 m
/// below the lowest ankles if there is none), the origin is below the camera, which looks along +y. Throws InputError.
interactions::Recording read_recording(const std::filesystem::path& folder);

/// What the original authors' program wrote on a scene, `skel_output.json` and `skel_output_objects/` in `folder`, brought to the
/// world of the scene's truth; every NN_label with a seat, top or shelf is an object. For evaluation only: no windows, no evidence.
interactions::Reconstruction read_original_result(const std::filesystem::path& folder, const interactions::Recording& truth);

}  // namespace unseen::report
