// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/interactions/evaluate.h"

#include "interactions/evaluate/evaluate_parts.h"

namespace unseen::interactions {

Reconstruction in_world_of(const Recording& truth, Reconstruction result) {
  const RigidTransform T = truth.T_world_camera * result.T_world_camera.inverse();
  for (FoundObject& f : result.objects)
    for (Part& part : f.object.parts) part.box = {T * part.box.center, T.rotation * part.box.axes, part.box.half_size};
  for (Person& person : result.people)
    for (PersonFrame& f : person.frames) f.pose = (T.rotation * f.pose).colwise() + T.translation;
  return result;
}

Evaluation evaluate(const Reconstruction& result, const Recording& truth) {
  Evaluation e;
  const Reconstruction there = in_world_of(truth, result);
  score_objects(there.objects, truth, e);
  const std::vector<int> match = match_people(there.people, truth.people);
  score_poses(there.people, truth, match, e);
  score_actions(there.people, truth, match, e);
  if (truth.people.size() > 1) e.identity = identity_share(there.people, truth, match);
  score_consistency(result, truth, e);
  return e;
}

}  // namespace unseen::interactions
