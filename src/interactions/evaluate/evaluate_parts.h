// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "unseen/interactions/evaluate.h"

// The stages of `evaluate`, which take the result in the truth's world.
namespace unseen::interactions {

/// The result with everything in it brought to the truth's world.
Reconstruction in_world_of(const Recording& truth, Reconstruction result);

/// Objects found, not found and false; fills `objects` to `median_distance`.
void score_objects(const std::vector<FoundObject>& found, const Recording& truth, Evaluation& e);

/// The found person of every true one, −1 without one: one-to-one, by the mean distance of the pelvises in the frames that both have.
std::vector<int> match_people(const std::vector<Person>& found, const std::vector<std::vector<RecordedFrame>>& truth);

/// A person's pose in a frame: as found, or between the nearest frames that have one (held at both ends).
Pose pose_at(const Person& person, int frame);
/// The person's own frame of that number; nothing if there is none.
const PersonFrame* frame_at(const Person& person, int frame);

/// Fills `occluded` and `all`. `match` as by match_people().
void score_poses(const std::vector<Person>& found, const Recording& truth, const std::vector<int>& match, Evaluation& e);

/// Fills `action_accuracy` and `confusion`.
void score_actions(const std::vector<Person>& found, const Recording& truth, const std::vector<int>& match, Evaluation& e);

/// Of the frames in which a true person is seen (four joints at least), the share in which the best one-to-one assignment of that frame alone,
/// in the picture, is `match`: a depth that is off does not make anybody another one.
double identity_share(const std::vector<Person>& found, const Recording& truth, const std::vector<int>& match);

/// Fills `inside_objects` to `overlapping`. `result` is as it was, on its own floor.
void score_consistency(const Reconstruction& result, const Recording& truth, Evaluation& e);

}  // namespace unseen::interactions
