// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/ground/tilted_floor.h"

#include <algorithm>
#include <cmath>

#include "core/linear.h"
#include "interactions/ground/upright.h"

namespace unseen::interactions {
namespace {

constexpr double kLeastTilt = 0.14, kMostTilt = 1.4;  // rad
constexpr double kLevelSd = 0.03, kSurely = 15;        // rad about the start; χ² by which a tilt must explain bodies better than that
constexpr double kTiltedHeight = 2.2, kTiltedHeightSd = 0.7;  // m, of tilted cameras

/// A body in the picture, for a focal length of one; each point is the middle of two joints.
struct Body {
  Vec2 ankle, hip, shoulder;
  int person, frame;
  double weight = 1;

  double length() const { return (shoulder - ankle).norm(); }
};

std::optional<Body> body_of(const Detection& d, const Camera& camera) {
  const auto middle = [&](Joint a, Joint b) -> Vec2 {
    const Vec2 pixel = 0.5 * (d.pixels.col(a) + d.pixels.col(b));
    return {(pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy};
  };
  for (const Joint joint : {right_shoulder, left_shoulder, right_hip, left_hip, right_ankle, left_ankle})
    if (d.confidence[joint] < kSeen) return std::nullopt;
  const Body body{middle(right_ankle, left_ankle), middle(right_hip, left_hip), middle(right_shoulder, left_shoulder), d.person, d.frame};
  return body.length() * camera.fy > 2 ? std::optional(body) : std::nullopt;
}

/// Frames in which a person stays say little more than one; the first that leaves starts the next stay. Bodies come by frame.
void weigh_stays(std::vector<Body>& bodies, int people, double fps) {
  constexpr double kStay = 0.2;  // of the body's length in the picture
  const double stance = std::max(1.0, kCorrelated * fps);
  std::vector<std::vector<Body*>> stays(static_cast<std::size_t>(people));
  const auto close = [&](std::vector<Body*>& stay) {
    for (Body* body : stay) body->weight = 1 / std::max(stance, std::sqrt(stance * static_cast<double>(stay.size())));
    stay.clear();
  };
  for (Body& body : bodies) {
    std::vector<Body*>& stay = stays[static_cast<std::size_t>(body.person)];
    if (!stay.empty() && ((body.ankle - stay.front()->ankle).norm() > kStay * body.length() || body.frame - stay.back()->frame > fps)) close(stay);
    stay.push_back(&body);
  }
  for (auto& stay : stays) close(stay);
}

/// Of more bodies than a fit needs, every n-th, which stands for those left out.
void thin(std::vector<Body>& bodies) {
  constexpr std::size_t kEnough = 5000;
  const std::size_t stride = (bodies.size() + kEnough - 1) / kEnough;
  std::vector<Body> kept;
  for (std::size_t i = 0; i < bodies.size(); i += stride) {
    kept.push_back(bodies[i]);
    kept.back().weight *= static_cast<double>(stride);
  }
  bodies = std::move(kept);
}

/// What is sought: log of the camera's height above ankles (m), its pitch (rad), log of each person's stature over the usual one.
using Unknowns = Eigen::VectorXd;

/// Where an upright body's hip and shoulder are seen beside where they should be, in standard deviations.
Eigen::Vector4d residuals(const Body& body, double log_height, double pitch, double log_stature) {
  const double c = std::cos(pitch), s = std::sin(pitch);
  const double depth = std::exp(log_height) / std::max(body.ankle.y() * c + s, 1e-3);
  const auto above = [&](double length) -> Vec2 {
    const double up = std::exp(log_stature) * length, z = std::max(depth - up * s, 0.1 * depth);
    return Vec2(depth * body.ankle.x(), depth * body.ankle.y() - up * c) / z;
  };
  Eigen::Vector4d r;
  r << above(kLeg) - body.hip, above(kLeg + kTorso) - body.shoulder;
  return r / (kPoseSd * body.length());
}

struct Fit {
  Unknowns x;
  Eigen::MatrixXd normal;
  double cost = INFINITY;
};

/// Levenberg–Marquardt with Cauchy weights.
Fit fit(const std::vector<Body>& bodies, const Unknowns& start, const Unknowns& usual, const Unknowns& sd, const Context& context) {
  const auto evaluate = [&](const Unknowns& x, Eigen::MatrixXd* normal, Unknowns* gradient) {
    const Unknowns off = (x - usual).cwiseQuotient(sd);
    double cost = off.squaredNorm();
    if (normal) {
      *normal = sd.cwiseAbs2().cwiseInverse().asDiagonal();
      *gradient = off.cwiseQuotient(sd);
    }
    for (const Body& body : bodies) {
      const Eigen::Index own = 2 + body.person;
      const Eigen::Vector4d r = residuals(body, x[0], x[1], x[own]);
      const double rough = r.squaredNorm() / (kRough * kRough);
      cost += body.weight * kRough * kRough * std::log1p(rough);
      if (!normal) continue;
      constexpr double kStep = 1e-5;
      Eigen::Matrix<double, 4, 3> j;
      j.col(0) = (residuals(body, x[0] + kStep, x[1], x[own]) - r) / kStep;
      j.col(1) = (residuals(body, x[0], x[1] + kStep, x[own]) - r) / kStep;
      j.col(2) = (residuals(body, x[0], x[1], x[own] + kStep) - r) / kStep;
      const double weight = body.weight / (1 + rough);
      const Eigen::Matrix3d jj = weight * j.transpose() * j;
      const Vec3 jr = weight * j.transpose() * r;
      const Eigen::Index at[3] = {0, 1, own};
      for (int a = 0; a < 3; ++a) {
        (*gradient)[at[a]] += jr[a];
        for (int b = 0; b < 3; ++b) (*normal)(at[a], at[b]) += jj(a, b);
      }
    }
    return cost;
  };
  Fit best{start, {}, evaluate(start, nullptr, nullptr)};
  Unknowns gradient;
  double damping = 1e-3;
  for (int round = 0; round < 50 && damping < 1e6; ++round) {
    context.check();
    evaluate(best.x, &best.normal, &gradient);
    Eigen::MatrixXd damped = best.normal;
    damped.diagonal() *= 1 + damping;
    const Unknowns next = best.x - solve_symmetric(damped, gradient);
    const double cost = std::abs(next[1]) < kMostTilt ? evaluate(next, nullptr, nullptr) : INFINITY;
    if (!(cost < best.cost)) {
      damping *= 10;
      continue;
    }
    const bool done = best.cost - cost < 1e-9 * cost;
    best.x = next;
    best.cost = cost;
    damping *= 0.1;
    if (done) break;
  }
  evaluate(best.x, &best.normal, &gradient);
  return best;
}

}  // namespace

std::optional<GroundStart> tilted_floor(const Take& take, const GroundStart& start, const Context& context) {
  std::vector<Body> bodies;
  for (const Detection& detection : take.detections)
    if (const auto body = detection.person >= 0 ? body_of(detection, take.camera) : std::nullopt) bodies.push_back(*body);
  if (bodies.empty()) return std::nullopt;
  weigh_stays(bodies, take.people, take.fps);
  thin(bodies);

  const Eigen::Index size = 2 + take.people;
  Unknowns usual = Unknowns::Zero(size), sd = Unknowns::Constant(size, kStatureSd);
  const double height = take.camera_height.value_or(kTiltedHeight);
  usual[0] = std::log(std::max(0.1, height - kAnkleHeight));
  sd[0] = take.camera_height ? kKnownSd : kTiltedHeightSd / kTiltedHeight;
  usual[1] = start.ground.pitch;
  sd[1] = kLevelSd;
  const Fit level = fit(bodies, usual, usual, sd, context);
  sd[1] = 10;  // any tilt
  Fit best;
  for (const double tilt : {start.ground.pitch, 0.35, 0.6, 0.9, 1.15}) {
    Unknowns from = usual;
    from[1] = tilt;
    if (Fit tried = fit(bodies, from, usual, sd, context); tried.cost < best.cost) best = std::move(tried);
  }
  if (!(best.x[1] > kLeastTilt) || (start.ground.pitch < kLeastTilt && level.cost - best.cost < kSurely)) return std::nullopt;
  GroundStart found = start;
  found.ground.pitch = best.x[1];
  found.ground.camera_height = take.camera_height.value_or(std::exp(best.x[0]) + kAnkleHeight);
  const double c = std::cos(best.x[1]);
  const Vec2 scale(std::exp(best.x[0]), 1 / (c * c));  // of (height, slope) by (log height, pitch)
  const Eigen::Matrix2d covariance = scale.asDiagonal() * best.normal.inverse().topLeftCorner<2, 2>() * scale.asDiagonal();
  found.information = covariance.inverse();
  return found;
}

}  // namespace unseen::interactions
