// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/ground/upright.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace unseen::interactions {
namespace {

/// Frames in which a person stays say little more than one; the first that leaves starts the next stay.
/// Bodies come by frame.
void weigh_stays(std::vector<Upright>& bodies, int people, double fps) {
  constexpr double kStay = 0.2;  // of the body's length in the picture
  const double stance = std::max(1.0, kCorrelated * fps);
  std::vector<std::vector<Upright*>> stays(static_cast<std::size_t>(people));
  const auto close = [&](std::vector<Upright*>& stay) {
    for (Upright* body : stay)
      body->weight = 1 / std::max(stance, std::sqrt(stance * static_cast<double>(stay.size())));
    stay.clear();
  };
  for (Upright& body : bodies) {
    std::vector<Upright*>& stay = stays[static_cast<std::size_t>(body.person)];
    if (!stay.empty() && ((body.ankle - stay.front()->ankle).norm() > kStay * body.length() ||
                          body.frame - stay.back()->frame > fps))
      close(stay);
    stay.push_back(&body);
  }
  for (auto& stay : stays) close(stay);
}

/// Of more bodies than a fit needs, every n-th, which stands for those left out.
void thin(std::vector<Upright>& bodies) {
  constexpr std::size_t kEnough = 5000;
  const std::size_t stride = (bodies.size() + kEnough - 1) / kEnough;
  std::vector<Upright> kept;
  for (std::size_t i = 0; i < bodies.size(); i += stride) {
    kept.push_back(bodies[i]);
    kept.back().weight *= static_cast<double>(stride);
  }
  bodies = std::move(kept);
}

/// The body whose legs are those that are stretched, or both if both feet are seen.
Upright body_of(const Detection& d, const Camera& camera, bool both, bool right) {
  const auto point = [&](Joint Leg::*part) -> Vec2 {
    const Vec2 of_right = d.pixels.col(kLegs[0].*part), of_left = d.pixels.col(kLegs[1].*part);
    const Vec2 pixel = both ? Vec2(0.5 * (of_right + of_left)) : right ? of_right : of_left;
    return {(pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy};
  };
  return {point(&Leg::ankle), point(&Leg::hip), point(&Leg::shoulder), d.person, d.frame};
}

/// How long the legs of somebody upright look who is seen here: from above they are farther away than the
/// torso.
LegShares leg_shares(const Upright& body, const FloorBelief& camera) {
  constexpr double kKnee = 0.4;  // m above the ankle
  const double s = std::sin(camera.mean[1]), c = std::cos(camera.mean[1]);
  const double depth = std::exp(camera.mean[0]) / std::max(c * body.ankle.y() + s, 1e-3);
  const auto row = [&](double up) {
    return (depth * body.ankle.y() - up * c) / std::max(depth - up * s, 0.1 * depth);
  };
  const double ankle = row(0), knee = row(kKnee), hip = row(kLeg), torso = hip - row(kLeg + kTorso);
  return {(knee - hip) / torso, (ankle - knee) / torso};
}

/// Nothing if the torso is not seen, or no leg as it should be.
std::optional<Upright> upright_body(const Detection& d, const Camera& camera, const FloorBelief* seen_by) {
  constexpr double kLeast = 2;  // px of a body that tells anything
  const double torso = torso_length(d);
  if (!(torso > 0)) return std::nullopt;
  const bool both = std::min(d.confidence[right_ankle], d.confidence[left_ankle]) >= kSeen;
  const auto stretched = [&](bool right) {
    const LegShares shares = seen_by ? leg_shares(body_of(d, camera, both, right), *seen_by) : LegShares();
    return is_stretched(d, kLegs[right ? 0 : 1], torso, shares);
  };
  const bool right = stretched(true), enough = right || stretched(false) || (both && !seen_by);
  const Upright body = body_of(d, camera, both, right);
  return enough && body.length() * camera.fy > kLeast ? std::optional(body) : std::nullopt;
}

}  // namespace

double torso_length(const Detection& d) {
  for (const Joint joint : {right_shoulder, left_shoulder, right_hip, left_hip})
    if (d.confidence[joint] < kSeen) return 0;
  return 0.5 * (d.pixels.col(right_shoulder) + d.pixels.col(left_shoulder) - d.pixels.col(right_hip) -
                d.pixels.col(left_hip))
                   .norm();
}

bool is_stretched(const Detection& d, const Leg& leg, double torso, const LegShares& upright) {
  constexpr double kThigh = 0.7 / 0.84,
                   kShin = 0.55 / 0.91;  // of an upright one; what is seen shorter is bent
  constexpr double kLeast = 1;           // px of a torso that tells anything
  for (const Joint joint : {leg.hip, leg.knee, leg.ankle})
    if (d.confidence[joint] < kSeen) return false;
  return torso > kLeast && d.pixels(1, leg.knee) - d.pixels(1, leg.hip) >= kThigh * upright.thigh * torso &&
         d.pixels(1, leg.ankle) - d.pixels(1, leg.knee) >= kShin * upright.shin * torso;
}

Detection levelled(Detection d, const Camera& camera, double roll) {
  const Vec2 middle(camera.cx, camera.cy);
  d.pixels = (Eigen::Rotation2Dd(roll).toRotationMatrix() * (d.pixels.colwise() - middle)).colwise() + middle;
  return d;
}

std::vector<Upright> upright_bodies(const Take& take, const FloorBelief* seen_by) {
  std::vector<Upright> bodies;
  for (const Detection& detection : take.detections)
    if (const auto body =
            detection.person >= 0 ? upright_body(detection, take.camera, seen_by) : std::nullopt)
      bodies.push_back(*body);
  weigh_stays(bodies, take.people, take.fps);
  thin(bodies);
  return bodies;
}

}  // namespace unseen::interactions
