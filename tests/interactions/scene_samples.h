// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdio>

#include "interactions/sample_files.h"
#include "unseen/interactions/types.h"

// A scene folder in i3DB's layout, written from a recording.
namespace unseen::interactions::test {

inline Json column(const Vec3& v) { return {Json::array({v.x()}), Json::array({v.y()}), Json::array({v.z()})}; }

inline Json box_file(const OrientedBox& world, const RigidTransform& T_camera_world) {
  const Mat3 axes = T_camera_world.rotation * world.axes;
  Json rows = Json::array();
  for (int r = 0; r < 3; ++r) rows.push_back({axes(r, 0), axes(r, 1), axes(r, 2)});
  return {{"axes", rows}, {"centroid", column(T_camera_world * world.center)}, {"part_id", 0}, {"scales", column(2.0 * world.half_size)}};
}

/// Each person's frames, and between them invalid ones, as i3DB has them: confidence 0, some pose.
inline Json person_file(const std::vector<RecordedFrame>& frames, const RigidTransform& T_camera_world) {
  Json poses = Json::object(), occluded = Json::object(), ids = Json::array(), values = Json::array();
  const auto add = [&](int frame, const Pose& pose, const std::array<bool, kJoints>& hidden, double confidence) {
    char key[8];
    std::snprintf(key, sizeof key, "%05d", frame);
    Json joints = Json::object(), flags = Json::array(), scores = Json::object();
    for (int j = 0; j < kJoints; ++j) {
      const Vec3 p = T_camera_world * Vec3(pose.col(j));
      joints[std::to_string(j)] = {p.x(), p.y(), p.z()};
      flags.push_back(hidden[static_cast<std::size_t>(j)] ? 1 : 0);
      scores[std::to_string(j)] = confidence;
    }
    poses[key] = joints;
    occluded[std::to_string(frame)] = flags;
    ids.push_back(frame);
    values.push_back(scores);
  };
  for (const RecordedFrame& f : frames) {
    add(f.frame, f.pose, f.occluded, 1.0);
    add(f.frame + 1, Pose::Constant(-7), {}, 0.0);
  }
  return {{"3d", poses}, {"confidence", {{"frame_ids", ids}, {"values", values}}}, {"confidence_normalized", false}, {"occluded", occluded}};
}

inline void write_scene(const Folder& folder, const Recording& r) {
  const RigidTransform T = r.T_world_camera.inverse();
  for (std::size_t p = 0; p < r.people.size(); ++p) {
    folder.write("gt/skel_" + std::string(1, static_cast<char>('a' + p)) + "_GT.json", person_file(r.people[p], T));
    std::string actions;
    for (const RecordedFrame& f : r.people[p])
      if (f.has_action) actions += std::to_string(f.frame) + "\t" + (f.action == Action::stand_up ? "standing(from sitting)" : kActions[static_cast<int>(f.action)]) + "\n";
    folder.write(p == 0 ? "gt/actions.txt" : "gt/actions-" + std::to_string(p) + ".txt", actions);
  }
  for (const Object& o : r.objects)
    for (const Part& part : o.parts)
      folder.write("gt/skel_a_GT_objects/0" + std::to_string(o.id) + "_" + o.category + "_" + part.name + ".json", box_file(part.box, T));
  folder.write("gt/interacted.json", Json(r.interacted));
  folder.write("gt/room.txt", r.room + "\n");
  folder.write("take.json", Json{{"fps", r.fps}});
}

/// Two people, a chair with a slanted back, a shelf on the wall; a camera 1.37 m high, pitched by 7° and rolled by 2°.
inline Recording sample_recording() {
  Recording r;
  r.room = "the attic";
  r.fps = 25;
  r.T_world_camera.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  r.T_world_camera.rotation = r.T_world_camera.rotation * Eigen::AngleAxisd(-0.12, Vec3::UnitX()).toRotationMatrix();
  r.T_world_camera.translation = Vec3(0, 0, 1.37);
  const Mat3 turned = Eigen::AngleAxisd(0.4, Vec3::UnitZ()).toRotationMatrix(), slanted = turned * Eigen::AngleAxisd(0.3, Vec3::UnitX()).toRotationMatrix();
  r.objects = {{0, "chair", {{"back", {Vec3(1, 4.3, 0.8), slanted, Vec3(0.25, 0.03, 0.3)}}, {"leg-1", {Vec3(1, 4, 0.2), turned, Vec3(0.02, 0.03, 0.2)}}, {"seat", {Vec3(1, 4, 0.42), turned, Vec3(0.25, 0.2, 0.02)}}}},
               {1, "shelf", {{"shelf", {Vec3(-1, 5, 1.5), Mat3::Identity(), Vec3(0.5, 0.2, 0.02)}}}},
               {2, "table", {{"leg", {Vec3(2, 3, 0.35), turned, Vec3(0.03, 0.03, 0.35)}}, {"top", {Vec3(2, 3, 0.72), turned, Vec3(0.5, 0.4, 0.02)}}}}};
  r.interacted = {0, 2};
  for (int person = 0; person < 2; ++person) {
    std::vector<RecordedFrame> frames;
    for (int f = 2; f < 40; f += 2) {
      RecordedFrame frame;
      frame.frame = f;
      for (int j = 0; j < kJoints; ++j) frame.pose.col(j) = Vec3(0.05 * f - person, 3 + 0.02 * j, 0.1 + 0.1 * ((j * 7 + f) % 16));
      frame.pose(2, right_ankle) = 0.1;
      frame.occluded[static_cast<std::size_t>((f + person) % kJoints)] = true;
      frame.action = f < 10 ? Action::walk : f < 20 ? Action::sit : Action::stand_up;
      frame.has_action = f < 30;
      frames.push_back(frame);
    }
    r.people.push_back(frames);
  }
  return r;
}

}  // namespace unseen::interactions::test
