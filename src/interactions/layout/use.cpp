// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/layout/use.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "interactions/matching/matching.h"

namespace unseen::interactions {
namespace {

/// How far a point is from a box, along the box's axes, m: negative inside.
Vec3 beyond(const OrientedBox& box, const Vec3& point) { return (box.axes.transpose() * (point - box.center)).cwiseAbs() - box.half_size; }

/// Horizontal distance to the box's footprint; its last axis is up.
double across(const OrientedBox& box, const Vec3& point) { return beyond(box, point).head<2>().cwiseMax(0.0).norm(); }

double above(const OrientedBox& box, const Vec3& point) { return point.z() - (box.center.z() + box.half_size.z()); }

bool starts_with(const std::string& text, const char* start) { return text.rfind(start, 0) == 0; }

bool sits_on(const Pose& pose, const OrientedBox& seat) {
  const Vec3 hips = pose.col(pelvis);
  return across(seat, hips) < 0.15 && above(seat, hips) > -0.25 && above(seat, hips) < 0.35;
}

constexpr std::array<std::pair<Joint, Joint>, 2> kHands = {{{right_wrist, right_hip}, {left_wrist, left_hip}}};

/// Whether a hand is put out: those of who just stands beside a table or a shelf hang near it, too.
bool is_put_out(const Vec3& hand, const Vec3& hip) {
  constexpr double kHanging = 0.25;  // m, across the floor
  return (hand - hip).head<2>().norm() > kHanging;
}

bool hand_over(const Pose& pose, const OrientedBox& top) {
  constexpr double kStanding = 0.7;  // m, of the pelvis: who sits has the hands on his lap or on the table
  return std::any_of(kHands.begin(), kHands.end(), [&](const auto& side) {
    const Vec3 hand = pose.col(side.first);
    return across(top, hand) < 0.1 && above(top, hand) > -0.15 && above(top, hand) < 0.35 &&
           (pose(2, pelvis) < kStanding || is_put_out(hand, pose.col(side.second)));
  });
}

bool hand_at(const Pose& pose, const OrientedBox& shelf) {
  return std::any_of(kHands.begin(), kHands.end(), [&](const auto& side) {
    const Vec3 hand = pose.col(side.first);
    return beyond(shelf, hand).cwiseMax(0.0).norm() < 0.3 && is_put_out(hand, pose.col(side.second));
  });
}

}  // namespace

bool uses(const Pose& pose, const Object& object) {
  for (const Part& part : object.parts) {
    if (starts_with(part.name, "seat") && sits_on(pose, part.box)) return true;
    if (starts_with(part.name, "top") && hand_over(pose, part.box)) return true;
    if (starts_with(part.name, "shelf") && hand_at(pose, part.box)) return true;
  }
  return false;
}

std::vector<bool> used_objects(const Scenelet& scenelet) {
  constexpr double kAround = 0.4;   // s
  constexpr double kSlowest = 0.5;  // m/s: who walks by a table or a shelf does not use it
  const auto before = pose_at(scenelet, -kAround), after = pose_at(scenelet, kAround);
  const bool walks = before && after && (after->col(pelvis) - before->col(pelvis)).head<2>().norm() > 2 * kAround * kSlowest;
  std::vector<bool> used(scenelet.objects.size(), false);
  for (const double offset : {-kAround, 0.0, kAround})
    if (const auto pose = pose_at(scenelet, offset))
      for (std::size_t i = 0; i < used.size(); ++i)
        if (!walks || scenelet.objects[i].superclass() == Superclass::sit) used[i] = used[i] || uses(*pose, scenelet.objects[i]);
  return used;
}

}  // namespace unseen::interactions
