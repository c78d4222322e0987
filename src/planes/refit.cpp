// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "planes/arrange.h"

namespace unseen::planes {
namespace {

constexpr int kIterations = 20;
constexpr double kFarthest = 1.5 * kPi / 180.0;  // rad: a refit that turns a frame farther went astray
constexpr double kFloor = 0.03 * kPi / 180.0;  // rad: no surface is known better than this

}  // namespace

std::array<TiltResidual, 2> tilt_residuals(const PlaneFit& fit, const Vec3& normal, double variance_u,
                                           double variance_v) {
  // Turning by w moves n by w × n, so its component along u by w·(n × u).
  return {TiltResidual{normal.cross(fit.u), normal.dot(fit.u), 1.0 / variance_u},
          TiltResidual{normal.cross(fit.v), normal.dot(fit.v), 1.0 / variance_v}};
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

namespace {

/// Normal equations of the turns, a 3×3 block a frame.
struct Turns {
  std::vector<Mat3> information;
  std::vector<Vec3> gradient;
  double largest = 0;  // weight
};

Turns turns_of(const Model& model) {
  Turns t{std::vector<Mat3>(model.frames.size(), Mat3::Zero()), std::vector<Vec3>(model.frames.size(), Vec3::Zero()), 0.0};
  for (const Surface& surface : model.surfaces) {
    const Patch& s = surface.support;
    for (const TiltResidual& r : tilt_residuals(s.fit, model.normal(surface), s.variance_u + kFloor * kFloor,
                                                s.variance_v + kFloor * kFloor)) {
      t.information[surface.frame] += r.weight * r.jacobian * r.jacobian.transpose();
      t.gradient[surface.frame] += r.weight * r.value * r.jacobian;
      t.largest = std::max(t.largest, r.weight);
    }
  }
  // What no surface determines stays where it is.
  for (Mat3& i : t.information) i.diagonal().array() += 1e-9 * t.largest;
  return t;
}

/// One step of Gauss–Newton with Lagrange multipliers: [H Jᵀ; J 0] [w; μ] = [−g; −c], over the frames that
/// constraints tie together; the others turn on their own.
std::vector<Vec3> step_of(const Model& model, const Turns& t) {
  std::vector<int> column(model.frames.size(), -1);
  int columns = 0;
  for (const Constraint& c : model.constraints)
    for (const int f : {c.a, c.b})
      if (column[f] < 0) {
        column[f] = columns;
        columns += 3;
      }
  const int total = columns + static_cast<int>(model.constraints.size());
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(total, total);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(total);
  for (std::size_t f = 0; f < model.frames.size(); ++f) {
    if (column[f] < 0) continue;
    system.block<3, 3>(column[f], column[f]) = t.information[f];
    right.segment<3>(column[f]) = -t.gradient[f];
  }
  for (std::size_t i = 0; i < model.constraints.size(); ++i) {
    const Constraint& c = model.constraints[i];
    const ConstraintResidual r = residual_of(c, model.frames[c.a].axes, model.frames[c.b].axes);
    const int row = columns + static_cast<int>(i);
    // Scaled so that multipliers are of the size of the turns.
    system.block<1, 3>(row, column[c.a]) = t.largest * r.jacobian.transpose();
    system.block<1, 3>(row, column[c.b]) = -t.largest * r.jacobian.transpose();
    right[row] = -t.largest * r.value;
  }
  system.topRightCorner(columns, total - columns) = system.bottomLeftCorner(total - columns, columns).transpose();
  const Eigen::VectorXd solution = total > 0 ? Eigen::VectorXd(system.partialPivLu().solve(right)) : right;
  std::vector<Vec3> step;
  for (std::size_t f = 0; f < model.frames.size(); ++f)
    step.push_back(column[f] >= 0 ? Vec3(solution.segment<3>(column[f]))
                                  : Vec3(-t.information[f].ldlt().solve(t.gradient[f])));
  return step;
}

/// The constrained frame that turned farthest, if any turned farther than relations may ask or if one of its
/// relations does not hold; else −1.
int failing_frame(const Model& model, const std::vector<OrientationFrame>& start) {
  double worst = 0;
  int culprit = -1;
  for (const Constraint& c : model.constraints) {
    const double residual = std::abs(residual_of(c, model.frames[c.a].axes, model.frames[c.b].axes).value);
    for (const int f : {c.a, c.b}) {
      const double turn = Eigen::AngleAxisd(Mat3(model.frames[f].axes * start[f].axes.transpose())).angle();
      if (residual < 1e-10 && turn < kFarthest) continue;
      const double badness = std::isfinite(turn + residual) ? turn + residual : 1e9 + f;
      if (badness <= worst) continue;
      worst = badness;
      culprit = f;
    }
  }
  return culprit;
}

}  // namespace

void refit(Model& model) {
  if (model.surfaces.empty()) return;
  const std::vector<OrientationFrame> start = model.frames;
  while (true) {
    for (int iteration = 0; iteration < kIterations; ++iteration) {
      const std::vector<Vec3> step = step_of(model, turns_of(model));
      double farthest = 0;
      for (std::size_t f = 0; f < model.frames.size(); ++f) {
        model.frames[f].axes = turned(model.frames[f].axes, step[f]);
        farthest = std::max(farthest, step[f].norm());
      }
      if (farthest < 1e-14 || !(farthest < kPi)) break;
    }
    const int culprit = failing_frame(model, start);
    if (culprit < 0) break;
    // Relations that cannot all hold at once: the frame that suffers most gives up its own.
    std::erase_if(model.constraints, [&](const Constraint& c) { return c.a == culprit || c.b == culprit; });
    model.frames = start;
  }
  for (Surface& s : model.surfaces) s.offset = model.normal(s).dot(s.support.moments.mean);
}

void update_support(Surface& surface, const Moments& moments, const Space& space) {
  if (moments.count < 3) return;
  Patch& s = surface.support;
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
