// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/synth/synth_body.h"

#include <algorithm>

namespace unseen::interactions {
namespace {

/// The joint between two bones from `root` to `end`, bent towards `pole`; `end` is moved where the bones cannot reach it.
Vec3 middle_joint(const Vec3& root, Vec3& end, double upper, double lower, const Vec3& pole) {
  const Vec3 line = end - root;
  const Vec3 along = line.norm() > 1e-6 ? Vec3(line.normalized()) : Vec3(-Vec3::UnitZ());
  const double distance = std::clamp(line.norm(), std::abs(upper - lower) + 0.02, (upper + lower) * 0.9999);
  end = root + distance * along;
  Vec3 across = pole - pole.dot(along) * along;
  if (across.norm() < 1e-6) across = any_orthogonal(along);
  const double share = (distance * distance + upper * upper - lower * lower) / (2.0 * distance);
  return root + share * along + std::sqrt(std::max(0.0, upper * upper - share * share)) * across.normalized();
}

/// Where an elbow points, seen from the chest: back if the hand hangs, down and out the higher it is.
Vec3 elbow_side(const Vec3& hand, int side) {
  const double up = 0.5 + 0.5 * hand.z() / std::max(hand.norm(), 1e-6);
  return {outward(side) * (0.4 + 0.5 * up), -0.9 + 0.6 * up, -0.2 - 0.8 * up};
}

}  // namespace

Body draw_body(Random& random) {
  Body b;
  b.height = random.uniform(1.50, 1.95);
  const double h = b.height, girth = random.uniform(0.85, 1.3);  // slim to stout
  const auto near = [&](double share) { return h * share * (1.0 + 0.025 * std::clamp(random.normal(), -2.0, 2.0)); };
  b.ankle = 0.04 * h + 0.03;  // the sole of a shoe and the joint above it
  b.shank = near(0.232);
  b.thigh = near(0.243);
  b.hip = near(0.066);
  b.trunk = near(0.285);
  b.shoulder = near(0.105);
  b.upper_arm = near(0.176);
  b.forearm = near(0.140);
  b.neck = Vec3(0, 0.02, 0.090) * (h / 1.7);
  b.head = Vec3(0, 0.07, 0.185) * (h / 1.7);  // the middle of the face
  b.trunk_radius = 0.075 * h * girth;
  b.limb_radius = 0.034 * h * girth;
  return b;
}

double heading(const Turn& turn) {
  const Vec3 right = turn * Vec3::UnitX();
  return std::atan2(right.y(), right.x());
}

Vec3 shoulder_of(const Body& body, const Posture& posture, int side) {
  return posture.pelvis + posture.chest * Vec3(outward(side) * body.shoulder, 0.0, body.trunk - 0.02);
}

Vec3 hanging_hand(const Body& body, const Posture& posture, int side, double swing, double bend) {
  const auto bone = [&](double out, double angle) { return Vec3(outward(side) * out, std::sin(angle), -std::cos(angle)).normalized(); };
  return shoulder_of(body, posture, side) + posture.chest * (body.upper_arm * bone(0.14, swing) + body.forearm * bone(0.04, swing + bend));
}

Posture standing(const Body& body, const Vec2& place, double heading) {
  Posture p;
  p.pelvis = Vec3(place.x(), place.y(), body.standing());
  p.hips = p.chest = p.head = about_z(heading);
  for (const int side : {kRight, kLeft}) {
    p.feet[side] = Vec3(place.x(), place.y(), body.ankle) + outward(side) * 1.05 * body.hip * rightward(heading);
    p.hands[side] = hanging_hand(body, p, side, 0.05, 0.25);
  }
  return p;
}

Pose pose_of(const Body& body, const Posture& posture) {
  Pose pose;
  pose.col(pelvis) = posture.pelvis;
  pose.col(thorax) = posture.pelvis + posture.chest * Vec3(0, 0, body.trunk);
  pose.col(neck) = pose.col(thorax) + posture.head * body.neck;
  pose.col(head) = pose.col(thorax) + posture.head * body.head;
  constexpr Joint legs[2][3] = {{right_hip, right_knee, right_ankle}, {left_hip, left_knee, left_ankle}};
  constexpr Joint arms[2][3] = {{right_shoulder, right_elbow, right_wrist}, {left_shoulder, left_elbow, left_wrist}};
  for (const int side : {kRight, kLeft}) {
    const Vec3 hip = posture.pelvis + posture.hips * Vec3(outward(side) * body.hip, 0, 0);
    Vec3 ankle = posture.feet[side];
    const Vec3 knee = middle_joint(hip, ankle, body.thigh, body.shank, posture.hips * Vec3(0.12 * outward(side), 1.0, 0.15));
    const Vec3 shoulder = shoulder_of(body, posture, side);
    Vec3 wrist = posture.hands[side];
    const Vec3 pole = posture.chest * elbow_side(posture.chest.inverse() * (wrist - shoulder), side);
    const Vec3 elbow = middle_joint(shoulder, wrist, body.upper_arm, body.forearm, pole);
    const Vec3 leg[] = {hip, knee, ankle}, arm[] = {shoulder, elbow, wrist};
    for (int k = 0; k < 3; ++k) {
      pose.col(legs[side][k]) = leg[k];
      pose.col(arms[side][k]) = arm[k];
    }
  }
  return pose;
}

Posture between(const Posture& a, const Posture& b, double share) {
  const auto mix = [&](const Vec3& u, const Vec3& v) { return Vec3(u + share * (v - u)); };
  Posture p;
  p.pelvis = mix(a.pelvis, b.pelvis);
  p.hips = a.hips.slerp(share, b.hips);
  p.chest = a.chest.slerp(share, b.chest);
  p.head = a.head.slerp(share, b.head);
  for (const int side : {kRight, kLeft}) {
    p.feet[side] = mix(a.feet[side], b.feet[side]);
    p.hands[side] = mix(a.hands[side], b.hands[side]);
  }
  return p;
}

}  // namespace unseen::interactions
