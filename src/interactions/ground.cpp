// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/ground.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "interactions/sight.h"

namespace unseen::interactions {
namespace {

constexpr double kAnkleHeight = 0.13;         // m, of the joint that detectors mark
constexpr double kTorso = 0.44, kLeg = 0.77;  // m, shoulders to hips and hip to ankle of an adult of 1.7 m
constexpr double kUsualHeight = 1.2, kHeightSd = 0.5;        // m, of cameras that film people
constexpr double kUsualPitch = 0.05, kPitchSd = 0.06;        // rad
constexpr double kFloorSd = 0.05;                            // m, of an ankle about the floor

/// The lower ankle of someone upright: its depth along the camera's axis and how far below the axis it is, m.
struct Foot {
  double depth, below;
};

/// The lower leg in the picture if it stands upright: its length and the row of its ankle, px.
std::optional<Vec2> upright_leg(const Detection& d, Joint hip, Joint knee, Joint ankle, double torso) {
  constexpr double kThigh = 0.7, kShin = 0.55;  // of the torso; a thigh that is seen shorter is bent
  for (const Joint joint : {hip, knee, ankle})
    if (d.confidence[joint] < kSeen) return std::nullopt;
  if (d.pixels(1, knee) - d.pixels(1, hip) < kThigh * torso || d.pixels(1, ankle) - d.pixels(1, knee) < kShin * torso) return std::nullopt;
  const double length = (d.pixels.col(hip) - d.pixels.col(knee)).norm() + (d.pixels.col(knee) - d.pixels.col(ankle)).norm();
  return Vec2(length, d.pixels(1, ankle));
}

std::optional<Foot> lower_foot(const Detection& d, const Camera& camera) {
  for (const Joint joint : {right_shoulder, left_shoulder, right_hip, left_hip})
    if (d.confidence[joint] < kSeen) return std::nullopt;
  const double torso = 0.5 * (d.pixels.col(right_shoulder) + d.pixels.col(left_shoulder) - d.pixels.col(right_hip) - d.pixels.col(left_hip)).norm();
  if (!(torso > 1)) return std::nullopt;
  std::optional<Vec2> leg = upright_leg(d, right_hip, right_knee, right_ankle, torso);
  if (const auto other = upright_leg(d, left_hip, left_knee, left_ankle, torso); other && (!leg || other->y() > leg->y())) leg = other;
  if (!leg) return std::nullopt;
  const double depth = camera.fy * (kTorso + kLeg) / (torso + leg->x());
  return Foot{depth, (leg->y() - camera.cy) / camera.fy * depth};
}

/// The detection as a camera that is not rolled has it: turned about the principal point.
Detection levelled(Detection d, const Camera& camera, double roll) {
  const Vec2 middle(camera.cx, camera.cy);
  d.pixels = (Eigen::Rotation2Dd(roll).toRotationMatrix() * (d.pixels.colwise() - middle)).colwise() + middle;
  return d;
}

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

/// Least squares with Cauchy weights of below = height − slope · depth; the slope is drawn to `usual` by `sd`. The slope's prior counts for more
/// where there are many feet: their depths are wrong together when the person is not of usual size.
Vec2 fit_floor(const std::vector<Foot>& feet, double usual, double sd) {
  const double slope_weight = std::max(1.0, static_cast<double>(feet.size()) / 9.0) / (sd * sd);
  Vec2 fit(kUsualHeight, usual);
  std::vector<double> weights(feet.size(), 1.0);
  for (int round = 0; round < 30; ++round) {
    Eigen::Matrix2d normal = Eigen::Vector2d(1.0 / (kHeightSd * kHeightSd), slope_weight).asDiagonal();
    Vec2 right(kUsualHeight / (kHeightSd * kHeightSd), slope_weight * usual);
    for (std::size_t i = 0; i < feet.size(); ++i) {
      const Vec2 row(1.0, -feet[i].depth);
      const double weight = weights[i] / (kFloorSd * kFloorSd);
      normal += weight * row * row.transpose();
      right += weight * feet[i].below * row;
    }
    fit = normal.ldlt().solve(right);
    for (std::size_t i = 0; i < feet.size(); ++i) {
      const double off = (feet[i].below - fit.x() + fit.y() * feet[i].depth) / kFloorSd;
      weights[i] = 1.0 / (1.0 + off * off);
    }
  }
  return fit;
}

double median_depth(std::vector<Foot> feet) {
  const auto middle = feet.begin() + static_cast<std::ptrdiff_t>(feet.size() / 2);
  std::nth_element(feet.begin(), middle, feet.end(), [](const Foot& a, const Foot& b) { return a.depth < b.depth; });
  return middle->depth;
}

}  // namespace

GroundStart find_ground(const Take& take, Context& context) {
  GroundStart start;
  Ground& ground = start.ground;
  if (take.up) {
    ground.pitch = std::asin(std::clamp(-take.up->z(), -1.0, 1.0));
    ground.roll = std::atan2(-take.up->x(), -take.up->y());
  }
  std::vector<Foot> feet;
  for (const Detection& detection : take.detections)
    if (const auto foot = lower_foot(levelled(detection, take.camera, ground.roll), take.camera)) feet.push_back(*foot);
  start.feet = static_cast<int>(feet.size());
  if (!feet.empty()) start.depth = median_depth(feet);
  constexpr double kKnown = 1e-3;
  const Vec2 floor = take.up ? fit_floor(feet, std::tan(ground.pitch), kKnown) : fit_floor(feet, kUsualPitch, kPitchSd);
  ground.source = take.camera_height ? "given" : feet.empty() ? "assumed" : "feet";
  ground.pitch = std::atan(floor.y());
  ground.camera_height = take.camera_height.value_or(floor.x() * std::cos(ground.pitch) + kAnkleHeight);
  start.below = floor.x() - floor.y() * start.depth + kAnkleHeight;
  if (is_turned(take, ground.roll))
    context.warn(take.up ? "most people are not upright in the picture: \"up\" may be wrong" : "most people are not upright in the picture: if it is turned, say so by \"up\"");
  if (feet.empty() && !take.camera_height)
    context.warn(fmt::format("nobody is seen upright with feet on the floor: the camera's height is a guess, {:.1f} m", ground.camera_height));
  return start;
}

}  // namespace unseen::interactions
