// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "planes/arrange.h"

namespace unseen::planes {
namespace {

constexpr double kFloor = 0.03 * kPi / 180.0;  // rad: no plane is known better than this

}  // namespace

std::array<TiltResidual, 2> tilt_residuals(const Patch& support, const Vec3& normal, double systematic) {
  const PlaneFit& fit = support.fit;
  const double floor = systematic * systematic + 1e-18;
  // Turning by w moves n by w × n, so its component along u by w·(n × u).
  return {TiltResidual{normal.cross(fit.u), normal.dot(fit.u), 1.0 / (support.variance_u + floor)},
          TiltResidual{normal.cross(fit.v), normal.dot(fit.v), 1.0 / (support.variance_v + floor)}};
}

ConstraintResidual residual_of(const Constraint& c, const Mat3& axes_a, const Mat3& axes_b) {
  const Vec3 u = axes_a * c.u, v = axes_b * c.v;
  return {u.cross(v), u.dot(v) - c.cosine};
}

Mat3 turned(const Mat3& axes, const Vec3& w) {
  Mat3 result = axes;
  if (const double angle = w.norm(); angle > 0) result = Eigen::AngleAxisd(angle, w / angle) * axes;
  result.col(0).normalize();
  result.col(1) = (result.col(1) - result.col(1).dot(result.col(0)) * result.col(0)).normalized();
  result.col(2) = result.col(0).cross(result.col(1));
  return result;
}

void refit(Model& model) {
  const int turns = 3 * static_cast<int>(model.frames.size());
  const int total = turns + static_cast<int>(model.constraints.size());
  for (int iteration = 0; iteration < 20 && turns > 0; ++iteration) {
    // Gauss–Newton with Lagrange multipliers: [H Jᵀ; J 0] [w; μ] = [−g; −c].
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(total, total);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(total);
    double largest = 0;
    for (const PlaneModel& plane : model.planes)
      for (const TiltResidual& r : tilt_residuals(plane.support, model.normal(plane), kFloor)) {
        const int at = 3 * plane.frame;
        system.block<3, 3>(at, at) += r.weight * r.jacobian * r.jacobian.transpose();
        right.segment<3>(at) -= r.weight * r.value * r.jacobian;
        largest = std::max(largest, r.weight);
      }
    // What no plane determines stays where it is.
    system.diagonal().head(turns).array() += 1e-9 * largest;
    for (std::size_t i = 0; i < model.constraints.size(); ++i) {
      const Constraint& c = model.constraints[i];
      const ConstraintResidual r = residual_of(c, model.frames[c.a].axes, model.frames[c.b].axes);
      const int row = turns + static_cast<int>(i);
      // Scaled so that multipliers are of the size of the turns.
      system.block<1, 3>(row, 3 * c.a) = largest * r.jacobian.transpose();
      system.block<1, 3>(row, 3 * c.b) = -largest * r.jacobian.transpose();
      right[row] = -largest * r.value;
    }
    system.topRightCorner(turns, total - turns) = system.bottomLeftCorner(total - turns, turns).transpose();
    const Eigen::VectorXd step = system.partialPivLu().solve(right);
    for (std::size_t f = 0; f < model.frames.size(); ++f)
      model.frames[f].axes = turned(model.frames[f].axes, step.segment<3>(3 * static_cast<int>(f)));
    if (step.head(turns).norm() < 1e-14) break;
  }
  for (PlaneModel& plane : model.planes) plane.offset = model.normal(plane).dot(plane.support.moments.mean);
}

void update_support(PlaneModel& plane, const Moments& moments, const Space& space) {
  if (moments.count < 3) return;
  Patch& s = plane.support;
  const auto plain = [](const PlaneFit& fit, double spread, double count) {
    return fit.rms * fit.rms / std::max(count * spread * spread, 1e-300);
  };
  const double inflate_u = s.variance_u / std::max(plain(s.fit, s.fit.spread_u, s.moments.count), 1e-300);
  const double inflate_v = s.variance_v / std::max(plain(s.fit, s.fit.spread_v, s.moments.count), 1e-300);
  s.moments = moments;
  s.fit = fit_plane(moments, space);
  s.variance_u = std::clamp(inflate_u, 1.0, 1e6) * plain(s.fit, s.fit.spread_u, moments.count);
  s.variance_v = space.is_2d() ? 0.0 : std::clamp(inflate_v, 1.0, 1e6) * plain(s.fit, s.fit.spread_v, moments.count);
}

}  // namespace unseen::planes
