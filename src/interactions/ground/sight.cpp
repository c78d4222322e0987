// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/ground/sight.h"

#include <algorithm>
#include <map>

#include "interactions/ground/upright.h"
#include "unseen/core/level.h"

namespace unseen::interactions {
namespace {

/// An upright torso of usual length tells the depth; foreshortened it looks farther away than it is.
double depth_of(const Detection& d, const Camera& camera) {
  for (const Joint joint : {right_shoulder, left_shoulder, right_hip, left_hip})
    if (d.confidence[joint] < kSeen) return 0;
  const Vec2 torso = 0.5 * (d.pixels.col(right_shoulder) + d.pixels.col(left_shoulder) - d.pixels.col(right_hip) - d.pixels.col(left_hip));
  return torso.norm() > 1 ? kTorso * camera.fy / torso.norm() : 0;
}

/// Distance of a pixel to the line from a to b.
double distance_to_line(const Vec2& pixel, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double t = along.squaredNorm() > 0 ? std::clamp((pixel - a).dot(along) / along.squaredNorm(), 0.0, 1.0) : 0.0;
  return (a + t * along - pixel).norm();
}

/// Whether a pixel lies on the body of a person.
bool is_on(const Detection& person, double depth, const Camera& camera, const Vec2& pixel) {
  constexpr double kThick = 0.15;  // m, around bones
  return std::any_of(kBones.begin(), kBones.end(), [&](const auto& bone) {
    return person.confidence[bone[0]] >= kSeen && person.confidence[bone[1]] >= kSeen &&
           distance_to_line(pixel, person.pixels.col(bone[0]), person.pixels.col(bone[1])) * depth < kThick * camera.fy;
  });
}

/// Which joints somebody nearer to the camera may hide.
std::array<bool, kJoints> behind_others(const Detection& detection, double depth, const std::vector<const Detection*>& in_frame, const Camera& camera) {
  std::array<bool, kJoints> behind = {};
  for (const Detection* other : in_frame) {
    const double nearer = other->person == detection.person ? 0 : depth_of(*other, camera);
    if (nearer == 0 || (depth > 0 && depth < nearer)) continue;
    for (int k = 0; k < kJoints; ++k)
      behind[static_cast<std::size_t>(k)] |= detection.confidence[k] > 0 && detection.confidence[k] < 0.5 && is_on(*other, nearer, camera, detection.pixels.col(k));
  }
  return behind;
}

}  // namespace

View view_of(const Camera& camera, const Ground& ground) {
  const double c = std::cos(ground.pitch);
  const Vec3 up(-c * std::sin(ground.roll), -c * std::cos(ground.roll), -std::sin(ground.pitch));
  return {camera, {level_rotation(up), Vec3(0, 0, ground.camera_height)}};
}

std::vector<Sight> sights_of(const Take& take, int person, const View& view) {
  std::map<int, std::vector<const Detection*>> frames;
  for (const Detection& detection : take.detections) frames[detection.frame].push_back(&detection);
  std::vector<Sight> sights;
  for (const Detection& detection : take.detections) {
    if (detection.person != person) continue;
    Sight sight;
    sight.frame = detection.frame;
    sight.pixels = detection.pixels;
    sight.confidence = detection.confidence;
    sight.depth = depth_of(detection, view.camera);
    sight.behind_others = behind_others(detection, sight.depth, frames[detection.frame], view.camera);
    for (int k = 0; k < kJoints; ++k) {
      const bool seen = detection.confidence[k] >= kSeen;
      sight.rays[k] = seen ? view.ray(detection.pixels.col(k)) : Vec3::UnitY();
      sight.information[k] = seen ? Mat3(detection.confidence[k] * (Mat3::Identity() - sight.rays[k] * sight.rays[k].transpose())) : Mat3(Mat3::Zero());
    }
    if (detection.local) sight.local = view.T_world_camera.rotation * *detection.local;
    sights.push_back(std::move(sight));
  }
  return sights;
}

}  // namespace unseen::interactions
