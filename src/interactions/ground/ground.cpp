// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/ground/ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "interactions/ground/level_floor.h"
#include "interactions/ground/standing_floor.h"

namespace unseen::interactions {
namespace {

constexpr double kTilted =
    0.14;  // rad; above it bodies are foreshortened, and a level camera is no longer likely
constexpr double kUsualHeight = 1.5, kHeightSd = 0.4;  // m, of cameras that may be tilted, and as a logarithm
constexpr double kUsualPitch = 0.1, kPitchSd = 0.3;    // rad; weak, for the steep are not rare
constexpr double kRollSd = 0.03;                       // rad, of cameras that somebody set up straight
constexpr double kKnownSd = 1e-4;                      // of what the take gives
constexpr double kSteepest = 1.4;                      // rad; whose camera is steeper sees nobody upright
constexpr double kVertical = 1e-6;  // of `up` across the view, below which there is no roll

/// Are most bodies not nearly upright in the picture?
bool is_turned(const Take& take, double roll) {
  int upright = 0, turned = 0;
  for (const Detection& detection : take.detections) {
    if (detection.confidence[pelvis] < kSeen || detection.confidence[thorax] < kSeen) continue;
    const Detection d = levelled(detection, take.camera, roll);
    const Vec2 torso = d.pixels.col(thorax) - d.pixels.col(pelvis);
    ++(-torso.y() > std::abs(torso.x()) ? upright : turned);
  }
  return turned > upright;
}

/// Do most 3D poses, which are in the camera's axes, not stand along `up`?
bool most_lie(const Take& take, const Vec3& up) {
  const double upright_cosine = std::sqrt(0.5);
  int upright = 0, lying = 0;
  for (const Detection& d : take.detections) {
    if (!d.local || d.confidence[pelvis] < kSeen || d.confidence[thorax] < kSeen) continue;
    const Vec3 torso = d.local->col(thorax) - d.local->col(pelvis);
    if (torso.norm() > 0) ++(torso.dot(up) > upright_cosine * torso.norm() ? upright : lying);
  }
  return lying > upright;
}

/// Are most feet seen above the horizon, where no floor can be? `slope` is the tangent of the camera's pitch.
bool stand_above_horizon(const std::vector<Foot>& feet, double slope) {
  constexpr double kClearly = 0.05;  // a tangent
  const auto above = std::count_if(feet.begin(), feet.end(),
                                   [&](const Foot& foot) { return foot.below + slope < -kClearly; });
  return 2 * static_cast<std::size_t>(above) > feet.size();
}

/// A camera before anybody is seen, as far as the take does not tell its height.
FloorBelief any_camera(const Take& take) {
  const double above_ankles = std::max(0.1, take.camera_height.value_or(kUsualHeight) - kAnkleHeight);
  const Vec3 sd(take.camera_height ? kKnownSd : kHeightSd, kPitchSd, kRollSd);
  return {{std::log(above_ankles), kUsualPitch, 0}, sd.cwiseAbs2().asDiagonal()};
}

/// The floor that a search starts from; the rest is that of `start`.
GroundStart tilted(GroundStart start, const FloorBelief& floor, const Take& take) {
  const double above_ankles = std::exp(floor.mean[0]), cosine = std::cos(floor.mean[1]);
  start.ground.pitch = floor.mean[1];
  start.ground.camera_height = take.camera_height.value_or(above_ankles + kAnkleHeight);
  const Vec2 scale(above_ankles, 1 / (cosine * cosine));  // of (height, slope) by (log height, pitch)
  start.information =
      (scale.asDiagonal() * floor.covariance.topLeftCorner<2, 2>() * scale.asDiagonal()).inverse();
  return start;
}

/// Says so if upright bodies leave the pitch open, or all lean one way.
void warn_of_doubts(const FloorBelief& floor, Context& context) {
  constexpr double kUnsure = 0.09, kRolled = 0.044;  // rad: 5° and 2.5°
  constexpr double kClearly = 2;                     // sd
  const double pitch_sd = std::sqrt(floor.covariance(1, 1)), roll_sd = std::sqrt(floor.covariance(2, 2));
  if (pitch_sd > kUnsure)
    context.warn(
        fmt::format("the camera's pitch is uncertain by {:.0f}°: too few people are seen who stand or walk; "
                    "give \"up\" if you know it",
                    degrees(pitch_sd)));
  if (std::abs(floor.mean[2]) > std::max(kRolled, kClearly * roll_sd))
    context.warn(fmt::format(
        "by how people stand the camera seems to be rolled by {:.0f}°: if it is, say so by \"up\"",
        degrees(std::abs(floor.mean[2]))));
}

}  // namespace

GroundStart find_ground(const Take& take, Context& context) {
  GroundStart start;
  Ground& ground = start.ground;
  if (take.up) {
    ground.pitch = std::asin(std::clamp(-take.up->z(), -1.0, 1.0));
    ground.roll =
        std::hypot(take.up->x(), take.up->y()) > kVertical ? std::atan2(-take.up->x(), -take.up->y()) : 0.0;
  }
  const std::vector<Foot> feet = lower_feet(take, ground.roll);
  UsualCamera usual;
  if (take.up) {
    usual.slope = std::tan(std::clamp(ground.pitch, -kSteepest, kSteepest));
    usual.slope_sd = kKnownSd;
  }
  if (take.camera_height) {
    usual.height = std::max(0.1, (*take.camera_height - kAnkleHeight) / std::cos(ground.pitch));
    usual.height_sd = kKnownSd;
  }
  const LevelFloor floor = level_floor(feet, take.people, usual, take.fps);
  ground.source = take.camera_height ? "given" : feet.empty() ? "assumed" : "feet";
  if (!take.up) ground.pitch = std::atan(floor.slope);
  ground.camera_height = take.camera_height.value_or(floor.height * std::cos(ground.pitch) + kAnkleHeight);
  start.information = floor.information;
  if (!take.up && !feet.empty()) {
    const FloorBelief standing = standing_floor(take, any_camera(take), context);
    if (standing.mean[1] > kTilted) start = tilted(start, standing, take);
    warn_of_doubts(standing, context);
  }
  if (std::abs(ground.pitch) < kSteepest && is_turned(take, ground.roll))
    context.warn(take.up ? "most people are not upright in the picture: \"up\" may be wrong"
                         : "most people are not upright in the picture: if it is turned, say so by \"up\"");
  else if (take.up && stand_above_horizon(feet, usual.slope))
    context.warn("most feet are seen above the horizon: \"up\" may be wrong");
  else if (take.up && most_lie(take, *take.up))
    context.warn("most 3D poses do not stand upright: \"up\" may be wrong");
  if (feet.empty() && !take.camera_height)
    context.warn(
        fmt::format("nobody is seen upright with feet on the floor: the camera's height is a guess, {:.1f} m",
                    ground.camera_height));
  return start;
}

}  // namespace unseen::interactions
