// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>

#include "unseen/core/random.h"
#include "unseen/interactions/skeleton.h"

namespace unseen::interactions {

using Turn = Eigen::Quaterniond;

/// Right and left of a body, as indices.
enum Side { kRight, kLeft };
inline double outward(int side) { return side == kRight ? 1.0 : -1.0; }

/// Share of a leg's length over which it is stretched at most: knees are never quite straight.
inline constexpr double kStraight = 0.993;

/// Lengths between the centres of a person's joints, m. Shares of the height are those of Drillis and Contini (1966), as in Winter,
/// Biomechanics and Motor Control of Human Movement, with breadths between joint centres instead of over the skin.
struct Body {
  double height;  ///< in shoes
  double ankle;   ///< height of the joint above the floor
  double shank, thigh, hip, trunk, shoulder, upper_arm, forearm;  ///< hip, shoulder: half the breadth
  double trunk_radius, limb_radius;
  Vec3 neck, head;  ///< from the thorax, x right, y forward, z up

  double leg() const { return shank + thigh; }
  double arm() const { return upper_arm + forearm; }
  double standing() const { return ankle + kStraight * leg(); }  ///< height of the pelvis
};
Body draw_body(Random& random);

/// What a body does at a moment: where its pelvis, ankles and wrists are (world, m), and how hips, chest and head are turned
/// (from x right, y forward, z up to the world). Knees and elbows follow.
struct Posture {
  Vec3 pelvis = Vec3::Zero();
  Turn hips = Turn::Identity(), chest = Turn::Identity(), head = Turn::Identity();
  std::array<Vec3, 2> feet = {Vec3::Zero(), Vec3::Zero()}, hands = {Vec3::Zero(), Vec3::Zero()};
};

inline Turn about_x(double angle) { return Turn(Eigen::AngleAxisd(angle, Vec3::UnitX())); }
inline Turn about_y(double angle) { return Turn(Eigen::AngleAxisd(angle, Vec3::UnitY())); }
inline Turn about_z(double angle) { return Turn(Eigen::AngleAxisd(angle, Vec3::UnitZ())); }
/// The heading of turned hips, rad counter-clockwise from +y.
double heading(const Turn& turn);
/// Where a heading points, on the ground.
inline Vec3 ahead(double heading) { return {-std::sin(heading), std::cos(heading), 0.0}; }
inline Vec3 rightward(double heading) { return {std::cos(heading), std::sin(heading), 0.0}; }

/// Upright with hanging arms, weight on both feet.
Posture standing(const Body& body, const Vec2& place, double heading);

Vec3 shoulder_of(const Body& body, const Posture& posture, int side);
/// Where the wrist of an arm is that hangs from its shoulder, swung forward by `swing`, with a bent elbow.
Vec3 hanging_hand(const Body& body, const Posture& posture, int side, double swing, double bend);

/// The joints. Ankles and wrists that are out of reach come as near as limbs allow: limb lengths always hold.
Pose pose_of(const Body& body, const Posture& posture);

/// Between two postures, the turns along great arcs; share in [0,1].
Posture between(const Posture& a, const Posture& b, double share);

}  // namespace unseen::interactions
