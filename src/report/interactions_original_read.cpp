// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "report/i3db_parts.h"
#include "unseen/report/interactions_recording.h"

namespace unseen::report {

using namespace interactions;

Reconstruction read_original_result(const std::filesystem::path& folder, const Recording& truth) {
  const std::filesystem::path file = folder / "skel_output.json";
  const nlohmann::json parsed = parse_joint_file(file, "the original method's skel_output.json");
  Reconstruction r;
  r.T_world_camera = truth.T_world_camera;
  r.fps = truth.fps;
  Person person;
  for (const auto& [frame, pose] : read_i3db_poses(JsonField(parsed, file.string())["3d"])) {
    PersonFrame f;
    f.frame = frame;
    f.pose = (r.T_world_camera.rotation * pose).colwise() + r.T_world_camera.translation;
    person.frames.push_back(f);
  }
  person.likelihood.assign(person.frames.size(), 0.0);
  r.people.push_back(std::move(person));
  for (Object& object : read_i3db_objects(folder / "skel_output_objects")) {
    // It spreads one object's boxes over several numbers; legs and backs on their own are no objects.
    if (std::none_of(object.parts.begin(), object.parts.end(), is_main)) continue;
    for (Part& part : object.parts) part.box = upright(r.T_world_camera, part.box);
    object.id = static_cast<int>(r.objects.size());  // a number of its own: the file's stands for several categories
    r.objects.push_back({std::move(object), 1.0, {}});
  }
  return r;
}

}  // namespace unseen::report
