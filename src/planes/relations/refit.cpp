// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/linear.h"
#include "planes/arrange.h"

namespace unseen::planes {
namespace {

constexpr int kIterations = 40;
constexpr double kFarthest = 1.5 * kPi / 180.0;  // rad: a refit that turns a frame farther went astray
constexpr double kEnough = 0.5;  // share of a support's points that may stand for it
constexpr double kLoose = 3.0 * kPi / 180.0;  // rad: damping of a step
constexpr double kRedundant = 1e-11;  // share of a relation's own gradient that others do not explain
constexpr double kFloor = 0.01 * kPi / 180.0;  // rad: no surface is known better than this
constexpr double kOdd = 2.0;        // standard deviations: tilts beyond it count less (Huber 1964)

}  // namespace

std::pair<double, double> tilt_variances(const Patch& support) {
  const auto known = [&](double variance, double spread) { return kFloor * kFloor + tilt_noise(support.moments, support.fit, variance, spread); };
  return {known(support.variance_u, support.fit.spread_u), support.variance_v > 0.0 ? known(support.variance_v, support.fit.spread_v) : kFloor * kFloor};
}

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
};

/// `variances`: of the tilts of each surface.
Turns turns_of(const Model& model, const std::vector<std::pair<double, double>>& variances) {
  // Levenberg's damping: what no surface determines does not turn far in one step.
  Turns t{std::vector<Mat3>(model.frames.size(), Mat3::Identity() / (kLoose * kLoose)),
          std::vector<Vec3>(model.frames.size(), Vec3::Zero())};
  for (std::size_t i = 0; i < model.surfaces.size(); ++i) {
    const Surface& surface = model.surfaces[i];
    for (const TiltResidual& r : tilt_residuals(surface.support.fit, model.normal(surface), variances[i].first, variances[i].second)) {
      const double weight = r.weight / std::max(1.0, std::abs(r.value) * std::sqrt(r.weight) / kOdd);
      t.information[surface.frame] += weight * r.jacobian * r.jacobian.transpose();
      t.gradient[surface.frame] += weight * r.value * r.jacobian;
    }
  }
  return t;
}

/// One step of Gauss–Newton with Lagrange multipliers, [H Jᵀ; J 0] [w; μ] = [−g; −c]. H has a block a frame, so
/// that J H⁻¹ Jᵀ μ = c − J H⁻¹ g remains to be solved; relations that follow from others make it singular.
std::vector<Vec3> step_of(const Model& model, const Turns& t) {
  std::vector<Mat3> inverse;
  std::vector<Vec3> step;
  for (std::size_t f = 0; f < model.frames.size(); ++f) {
    inverse.push_back(t.information[f].inverse());
    step.push_back(-(inverse[f] * t.gradient[f]));
  }
  const int count = static_cast<int>(model.constraints.size());
  if (count == 0) return step;
  std::vector<std::vector<std::pair<int, Vec3>>> of_frame(model.frames.size());  // constraint, its gradient
  Eigen::VectorXd right(count), scale(count);
  for (int i = 0; i < count; ++i) {
    const Constraint& c = model.constraints[i];
    const ConstraintResidual r = residual_of(c, model.frames[c.a].axes, model.frames[c.b].axes);
    of_frame[c.a].emplace_back(i, r.jacobian);
    of_frame[c.b].emplace_back(i, -r.jacobian);
    right[i] = r.value + r.jacobian.dot(step[c.a] - step[c.b]);
    scale[i] = 1.0 / std::sqrt(r.jacobian.dot((inverse[c.a] + inverse[c.b]) * r.jacobian));
  }
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(count, count);
  for (std::size_t f = 0; f < of_frame.size(); ++f)
    for (const auto& [i, u] : of_frame[f])
      for (const auto& [k, v] : of_frame[f]) system(i, k) += scale[i] * u.dot(inverse[f] * v) * scale[k];
  const Eigen::VectorXd multiplier = scale.cwiseProduct(least_norm(system, scale.cwiseProduct(right), kRedundant));
  for (std::size_t f = 0; f < of_frame.size(); ++f)
    for (const auto& [i, u] : of_frame[f]) step[f] -= inverse[f] * u * multiplier[i];
  return step;
}

/// The constrained frame whose planes turned farthest, if any turned farther than relations may ask or if one
/// of its relations does not hold; else −1.
int failing_frame(const Model& model, const std::vector<OrientationFrame>& start) {
  std::vector<double> turn(model.frames.size(), 0.0);
  for (const Surface& s : model.surfaces) {
    const Mat3 back = start[s.frame].axes * model.frames[s.frame].axes.transpose();
    const double angle = line_angle(model.normal(s), back * model.normal(s));
    turn[s.frame] = std::isfinite(angle) ? std::max(turn[s.frame], angle) : kPi;
  }
  double worst = 0;
  int culprit = -1;
  for (const Constraint& c : model.constraints) {
    const double residual = std::abs(residual_of(c, model.frames[c.a].axes, model.frames[c.b].axes).value);
    for (const int f : {c.a, c.b}) {
      if (residual < 1e-10 && turn[f] < kFarthest) continue;
      const double badness = std::isfinite(residual) ? turn[f] + residual : kPi + 1.0;
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
  std::vector<std::pair<double, double>> variances;
  for (const Surface& s : model.surfaces) variances.push_back(tilt_variances(s.support));
  while (true) {
    for (int iteration = 0; iteration < kIterations; ++iteration) {
      const std::vector<Vec3> step = step_of(model, turns_of(model, variances));
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

void update_support(Surface& surface, const Moments& moments, const Space& space, double least_noise) {
  Patch& s = surface.support;
  if (moments.count < kEnough * s.moments.count) return;
  const auto plain = [&](const PlaneFit& fit, double spread, double count) {
    return std::pow(std::max(fit.rms, least_noise), 2) / std::max(count * spread * spread, 1e-300);
  };
  const double inflate_u = s.variance_u / std::max(plain(s.fit, s.fit.spread_u, s.moments.count), 1e-300);
  const double inflate_v = s.variance_v / std::max(plain(s.fit, s.fit.spread_v, s.moments.count), 1e-300);
  s.moments = moments;
  s.fit = fit_plane(moments, space);
  s.variance_u = std::clamp(inflate_u, 1.0, 1e6) * plain(s.fit, s.fit.spread_u, moments.count);
  s.variance_v = space.is_2d() ? 0.0 : std::clamp(inflate_v, 1.0, 1e6) * plain(s.fit, s.fit.spread_v, moments.count);
}

}  // namespace unseen::planes
