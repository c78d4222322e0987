// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/orientations/pose_cost.h"

#include <Eigen/Cholesky>

namespace unseen::collision {
namespace {

constexpr double kOutlineNoise = 0.7;      // px
constexpr double kOutlineShare = 0.006;    // of the radius
constexpr double kIndependent = 10.0;      // directions: errors of neighbouring ones go together
constexpr double kShift = 0.015, kSize = 0.02, kBorder = 0.01;  // of the radius
constexpr double kBorderNoise = 0.7;       // px
constexpr double kOpen = 0.25;             // of a frame: half the exposure
constexpr double kSpoiled = 40.0;          // χ² of a frame from where on it counts less

}  // namespace

SpinBody spin_body(const Body& body, const std::string& source) {
  SpinBody result;
  result.solid = solid_of(body, source);
  const auto& vertices = result.solid.hull.vertices;
  result.corners.resize(3, static_cast<Eigen::Index>(vertices.size()));
  for (std::size_t i = 0; i < vertices.size(); ++i) result.corners.col(static_cast<Eigen::Index>(i)) = vertices[i];
  result.symmetry = symmetry_of(vertices);
  result.nearly_alike = near_turns(vertices, result.symmetry);
  return result;
}

void set_whitening(Look& look, const Vec2& motion) {
  const auto& directions = support_directions();
  const double noise = std::hypot(kOutlineNoise, kOutlineShare * look.radius);
  Eigen::Matrix<double, kDirections, 5> slack;
  slack.leftCols<2>() = std::hypot(1.0, kShift * look.radius) * directions;
  slack.col(2) = kSize * look.seen;
  slack.col(3).setConstant(std::hypot(kBorderNoise, kBorder * look.radius));
  slack.col(4) = kOpen * (directions * motion).cwiseAbs();
  const Eigen::Matrix<double, kDirections, kDirections> covariance =
      slack * slack.transpose() + Support::Constant(noise * noise * kDirections / kIndependent).asDiagonal().toDenseMatrix();
  look.whitening.setIdentity();
  covariance.llt().matrixL().solveInPlace(look.whitening);
}

Support silhouette_residual(const SpinBody& body, const Camera& camera, const Look& look, const Quat& q) {
  const Support difference = support_of(projected(body.corners, q, look.center, camera), look.pixel) - look.seen;
  return look.whitening.triangularView<Eigen::Lower>() * difference;
}

double frame_weight(double square) { return 1.0 / (1.0 + square / kSpoiled); }
double frame_loss(double square) { return kSpoiled * std::log1p(square / kSpoiled); }

}  // namespace unseen::collision
