// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/ground/ground.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/linear.h"
#include "interactions/ground/tilted_floor.h"
#include "interactions/ground/upright.h"

namespace unseen::interactions {
namespace {

constexpr double kUsualHeight = 1.3, kHeightSd = 0.4;         // m, of cameras that film people
constexpr double kUsualPitch = 0.06, kPitchSd = 0.06;         // rad
constexpr double kSteepest = 1.4;                             // rad; whose camera is steeper sees nobody upright
constexpr double kVertical = 1e-6;                            // of `up` across the view, below which there is no roll

/// The lower ankle of someone upright: how far below the camera's axis it is seen (a tangent), and the inverse of its depth by the length of the body, 1/m.
struct Foot {
  double below, inverse_depth;
  int person;
};

std::optional<Foot> lower_foot(const Detection& d, const Camera& camera) {
  const auto body = upright_body(d);
  if (!body) return std::nullopt;
  return Foot{(body->ankle - camera.cy) / camera.fy, (body->torso + body->leg) / camera.fy / (kTorso + kLeg), d.person};
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
  const auto above = std::count_if(feet.begin(), feet.end(), [&](const Foot& foot) { return foot.below + slope < -kClearly; });
  return 2 * static_cast<std::size_t>(above) > feet.size();
}

/// What cameras are like before anybody is seen: means and standard deviations.
struct Usual {
  double height = kUsualHeight, height_sd = kHeightSd;  ///< m, above ankles
  double slope = kUsualPitch, slope_sd = kPitchSd;      ///< tangent of the pitch
};

struct Floor {
  double height = 0, slope = 0;
  Eigen::Matrix2d information;  ///< of both
};

/// An ankle that is seen at the tangent t on a floor h below has the inverse depth (t + slope) / h: a line over t, which is exact beside the
/// lengths that inverse depths are read from. Least squares with Cauchy weights for (1/h, slope/h) and each person's stature.
Floor fit_floor(const std::vector<Foot>& feet, int people, const Usual& usual, double fps) {
  constexpr double kLeastInverse = 1e-3;  // 1/m
  const double inverse = 1 / usual.height, stance = std::max(1.0, kCorrelated * fps);
  const auto count = static_cast<Eigen::Index>(feet.size()), size = static_cast<Eigen::Index>(2 + people);

  Eigen::MatrixXd prior = Eigen::MatrixXd::Zero(size, size);  // rows that are 1 a standard deviation, like those of feet
  Eigen::VectorXd prior_right = Eigen::VectorXd::Zero(size);
  prior(0, 0) = usual.height * usual.height / usual.height_sd;
  prior_right[0] = usual.height / usual.height_sd;
  prior.row(1).head<2>() = Vec2(-usual.slope, 1) / (usual.slope_sd * inverse);
  prior.diagonal().tail(people).setConstant(1 / kStatureSd);

  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(count, size);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Foot& foot = feet[static_cast<std::size_t>(i)];
    rows.row(i).head<2>() = Vec2(foot.below, 1) / (kPoseSd * foot.inverse_depth);
    rows(i, 2 + foot.person) = 1 / kPoseSd;  // who is taller than usual seems nearer
  }
  const Eigen::VectorXd right = Eigen::VectorXd::Constant(count, 1 / kPoseSd);

  Eigen::VectorXd weights = Eigen::VectorXd::Ones(count), solution;
  Eigen::MatrixXd normal;
  for (int round = 0; round < 30; ++round) {
    const Eigen::MatrixXd weighted = rows.transpose() * (weights / stance).asDiagonal();
    normal = prior.transpose() * prior + weighted * rows;
    solution = solve_symmetric(normal, prior.transpose() * prior_right + weighted * right);
    weights = 1 / (1 + ((rows * solution - right) / kRough).array().square());
  }
  Floor floor;
  floor.height = 1 / std::max(solution[0], kLeastInverse);
  floor.slope = solution[1] * floor.height;
  Eigen::Matrix2d jacobian;  // of (height, slope) by (1/height, slope/height)
  jacobian << -floor.height * floor.height, 0, -floor.slope * floor.height, floor.height;
  floor.information = (jacobian * normal.inverse().topLeftCorner<2, 2>() * jacobian.transpose()).inverse();
  return floor;
}

}  // namespace

GroundStart find_ground(const Take& take, Context& context) {
  GroundStart start;
  Ground& ground = start.ground;
  if (take.up) {
    ground.pitch = std::asin(std::clamp(-take.up->z(), -1.0, 1.0));
    ground.roll = std::hypot(take.up->x(), take.up->y()) > kVertical ? std::atan2(-take.up->x(), -take.up->y()) : 0.0;
  }
  std::vector<Foot> feet;
  for (const Detection& detection : take.detections)
    if (const auto foot = detection.person >= 0 ? lower_foot(levelled(detection, take.camera, ground.roll), take.camera) : std::nullopt) feet.push_back(*foot);
  Usual usual;
  if (take.up) {
    usual.slope = std::tan(std::clamp(ground.pitch, -kSteepest, kSteepest));
    usual.slope_sd = kKnownSd;
  }
  if (take.camera_height) {
    usual.height = std::max(0.1, (*take.camera_height - kAnkleHeight) / std::cos(ground.pitch));
    usual.height_sd = kKnownSd;
  }
  const Floor floor = fit_floor(feet, take.people, usual, take.fps);
  ground.source = take.camera_height ? "given" : feet.empty() ? "assumed" : "feet";
  if (!take.up) ground.pitch = std::atan(floor.slope);
  ground.camera_height = take.camera_height.value_or(floor.height * std::cos(ground.pitch) + kAnkleHeight);
  start.information = floor.information;
  if (!take.up && !feet.empty())  // the seated alone would look like the foreshortened
    if (const auto tilted = tilted_floor(take, start, context)) start = *tilted;
  if (std::abs(ground.pitch) < kSteepest && is_turned(take, ground.roll))
    context.warn(take.up ? "most people are not upright in the picture: \"up\" may be wrong" : "most people are not upright in the picture: if it is turned, say so by \"up\"");
  else if (take.up && stand_above_horizon(feet, usual.slope))
    context.warn("most feet are seen above the horizon: \"up\" may be wrong");
  else if (take.up && most_lie(take, *take.up))
    context.warn("most 3D poses do not stand upright: \"up\" may be wrong");
  if (feet.empty() && !take.camera_height)
    context.warn(fmt::format("nobody is seen upright with feet on the floor: the camera's height is a guess, {:.1f} m", ground.camera_height));
  return start;
}

}  // namespace unseen::interactions
