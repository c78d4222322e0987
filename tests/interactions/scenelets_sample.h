// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cmath>
#include <string>

#include "unseen/core/random.h"
#include "unseen/interactions/types.h"

namespace unseen::interactions {

/// Somebody who stands at the origin and faces +y; `sink` in [0,1] bends the knees until the thighs are level.
inline Pose simple_pose(double sink) {
  Pose p;
  const double pelvis_height = 0.95 - 0.45 * sink, knee = 0.4 * sink;
  for (const double side : {1.0, -1.0}) {
    const bool right = side > 0;
    p.col(right ? right_ankle : left_ankle) = Vec3(0.1 * side, knee, 0.1);
    p.col(right ? right_knee : left_knee) = Vec3(0.1 * side, knee, 0.5);
    p.col(right ? right_hip : left_hip) = Vec3(0.1 * side, 0, pelvis_height);
    p.col(right ? right_shoulder : left_shoulder) = Vec3(0.2 * side, 0, pelvis_height + 0.5);
    p.col(right ? right_elbow : left_elbow) = Vec3(0.25 * side, 0, pelvis_height + 0.2);
    p.col(right ? right_wrist : left_wrist) = Vec3(0.25 * side, 0.25 * sink, pelvis_height);
  }
  p.col(pelvis) = Vec3(0, 0, pelvis_height);
  p.col(thorax) = Vec3(0, 0, pelvis_height + 0.5);
  p.col(neck) = Vec3(0, 0, pelvis_height + 0.55);
  p.col(head) = Vec3(0, 0, pelvis_height + 0.7);
  return p;
}

inline Object box_object(int id, const std::string& category, const std::string& part, const Vec3& center, const Vec3& size, double yaw = 0) {
  const Mat3 axes = Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix();
  return {id, category, {{part, {center, axes, size / 2}}}};
}

/// Walks along +x at 1 m/s, `seconds` long, sits down within a second on a chair, sits for `still` seconds. A table stands beside the way.
inline Recording simple_recording(double seconds, double still, double fps = 10, const std::string& name = "walk and sit") {
  Recording r;
  r.name = name;
  r.room = "a room";
  r.licence = "CC0";
  r.fps = fps;
  r.people.resize(1);
  const int walking = static_cast<int>(seconds * fps), sinking = static_cast<int>(fps), sitting = static_cast<int>(still * fps);
  for (int i = 0; i < walking + sinking + sitting; ++i) {
    RecordedFrame f;
    f.frame = i;
    f.has_action = true;
    f.action = i < walking ? Action::walk : Action::sit;
    const double x = std::min(i, walking) / fps, sink = std::clamp((i - walking) / static_cast<double>(sinking), 0.0, 1.0);
    Pose pose = simple_pose(sink);
    const double swing = i < walking ? 0.3 * std::sin(2 * kPi * i / fps) : 0.0;
    pose.row(1)[right_ankle] += swing;
    pose.row(1)[left_ankle] -= swing;
    f.pose = Placement{{x, 0, 0}, i < walking ? -kPi / 2 : -kPi / 2 - kPi * sink} * pose;
    r.people[0].push_back(f);
  }
  r.objects = {box_object(0, "chair", "seat", Vec3(seconds, 0, 0.45), Vec3(0.5, 0.5, 0.1)),
               box_object(1, "table", "top", Vec3(seconds / 2, 0.9, 0.7), Vec3(1.0, 0.6, 0.05), 0.3)};
  return r;
}

}  // namespace unseen::interactions
