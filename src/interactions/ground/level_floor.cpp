// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/ground/level_floor.h"

#include <algorithm>
#include <cmath>

#include "core/linear.h"

namespace unseen::interactions {
namespace {

constexpr double kLengthSd =
    0.05;  // of a body's length in the picture, as a share: who leans or takes a step

std::optional<Foot> lower_foot(const Detection& d, const Camera& camera) {
  const double torso = torso_length(d);
  std::optional<Vec2> lower;  // length of the leg and its ankle's row, px
  for (const Leg& leg : kLegs) {
    if (!is_stretched(d, leg, torso) || (lower && d.pixels(1, leg.ankle) <= lower->y())) continue;
    const double length = (d.pixels.col(leg.hip) - d.pixels.col(leg.knee)).norm() +
                          (d.pixels.col(leg.knee) - d.pixels.col(leg.ankle)).norm();
    lower = Vec2(length, d.pixels(1, leg.ankle));
  }
  if (!lower) return std::nullopt;
  return Foot{(lower->y() - camera.cy) / camera.fy, (torso + lower->x()) / camera.fy / (kTorso + kLeg),
              d.person};
}

}  // namespace

std::vector<Foot> lower_feet(const Take& take, double roll) {
  std::vector<Foot> feet;
  for (const Detection& detection : take.detections)
    if (const auto foot = detection.person >= 0
                              ? lower_foot(levelled(detection, take.camera, roll), take.camera)
                              : std::nullopt)
      feet.push_back(*foot);
  return feet;
}

/// An ankle that is seen at the tangent t on a floor h below has the inverse depth (t + slope) / h: a line
/// over t, which is exact beside the lengths that inverse depths are read from. Least squares with Cauchy
/// weights for (1/h, slope/h) and each person's stature.
LevelFloor level_floor(const std::vector<Foot>& feet, int people, const UsualCamera& usual, double fps) {
  constexpr double kLeastInverse = 1e-3;  // 1/m
  const double inverse = 1 / usual.height, stance = std::max(1.0, kCorrelated * fps);
  const auto count = static_cast<Eigen::Index>(feet.size()), size = static_cast<Eigen::Index>(2 + people);

  Eigen::MatrixXd prior =
      Eigen::MatrixXd::Zero(size, size);  // rows that are 1 a standard deviation, like those of feet
  Eigen::VectorXd prior_right = Eigen::VectorXd::Zero(size);
  prior(0, 0) = usual.height * usual.height / usual.height_sd;
  prior_right[0] = usual.height / usual.height_sd;
  prior.row(1).head<2>() = Vec2(-usual.slope, 1) / (usual.slope_sd * inverse);
  prior.diagonal().tail(people).setConstant(1 / kStatureSd);

  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(count, size);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Foot& foot = feet[static_cast<std::size_t>(i)];
    rows.row(i).head<2>() = Vec2(foot.below, 1) / (kLengthSd * foot.inverse_depth);
    rows(i, 2 + foot.person) = 1 / kLengthSd;  // who is taller than usual seems nearer
  }
  const Eigen::VectorXd right = Eigen::VectorXd::Constant(count, 1 / kLengthSd);

  Eigen::VectorXd weights = Eigen::VectorXd::Ones(count), solution;
  Eigen::MatrixXd normal;
  for (int round = 0; round < 30; ++round) {
    const Eigen::MatrixXd weighted = rows.transpose() * (weights / stance).asDiagonal();
    normal = prior.transpose() * prior + weighted * rows;
    solution = solve_symmetric(normal, prior.transpose() * prior_right + weighted * right);
    weights = 1 / (1 + ((rows * solution - right) / kRough).array().square());
  }
  LevelFloor floor;
  floor.height = 1 / std::max(solution[0], kLeastInverse);
  floor.slope = solution[1] * floor.height;
  Eigen::Matrix2d jacobian;  // of (height, slope) by (1/height, slope/height)
  jacobian << -floor.height * floor.height, 0, -floor.slope * floor.height, floor.height;
  floor.information = (jacobian * normal.inverse().topLeftCorner<2, 2>() * jacobian.transpose()).inverse();
  return floor;
}

}  // namespace unseen::interactions
