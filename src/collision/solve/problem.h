// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "collision/orientations/orientations.h"
#include "collision/solve/contact.h"
#include "collision/solve/flight.h"
#include "collision/solve/mass_properties.h"
#include "collision/solve/terms.h"
#include "unseen/collision/types.h"

namespace unseen::collision {

/// Share of a body's projected size by which blur, shade and shadow shift the centroids of its regions, alike for a whole flight.
constexpr double kLopsided = 0.01;

/// A body's centre in one frame, as an observation of the solver.
struct PointObservation {
  int body = 0;
  bool after = false;      ///< the impact
  int frame = 0;
  double time = 0;         ///< s
  Vec2 pixel = Vec2::Zero();
  double depth = 0;        ///< m, from the projected size; 0 = unknown
  double depth_sigma = 0;  ///< share of the depth; the common error of a flight's sizes is spread over its frames
  double row = 0;          ///< share of a rolling shutter's readout, −½ to ½, after which its row was read
};

/// How a body's distance changes along a flight, by its projected sizes.
struct SizeTrend {
  int body = 0;
  bool after = false;           ///< the impact
  double begin = 0, end = 0;    ///< s, of the flight's sightings
  double change = 0;            ///< logarithm of the distance at the end over that at the beginning
  double sigma = 0;
};

/// An orientation as an observation; `q` maps the principal axes to the camera.
struct OrientationObservation {
  int body = 0;
  bool after = false;
  double time = 0;  ///< s
  Quat q = Quat::Identity();
};

/// Another impact of a ball with the plane that it meets in this one: its centre is as high there.
struct OtherContact {
  bool after = false;  ///< this impact
  double time = 0;     ///< s
};

/// One impact of two bodies, or of one with something fixed, as the solver sees it. Camera coordinates, SI units.
struct Problem {
  Camera camera;
  bool focal_assumed = false;          ///< the focal length is a guess
  double gravity = 9.81;               ///< m/s²
  Vec3 down = Vec3::UnitY();           ///< expected; unit
  double down_sigma = 0.05;            ///< rad
  std::array<Solid, 2> solids;
  bool fixed = false;                  ///< the second body never moves
  std::optional<Vec3> fixed_normal;    ///< of the fixed body, towards the first
  bool level = false;                  ///< the fixed body is a level floor: its normal is up by the state's own vertical
  bool plumb = false;                  ///< the fixed body is a wall: its normal, or the impulse where that is not known, is about level
  std::optional<double> fixed_offset;  ///< of its plane along the normal, m, if known
  std::vector<OtherContact> other_contacts;  ///< with the same plane, before and after this impact
  std::optional<double> mass_ratio;    ///< known
  std::optional<double> restitution;   ///< known
  std::array<double, 2> drag = {0, 0};  ///< 1/m
  bool planar = false;                 ///< gravity-free, all in one plane parallel to the image
  std::array<bool, 2> rests = {false, false};  ///< the body lies still on something until it is hit, which pushes no further then
  std::vector<PointObservation> points;
  std::vector<SizeTrend> trends;
  std::vector<OrientationObservation> orientations;
  double pixel_sigma = 1.0;            ///< px
  double noise_power = 2.0;            ///< centres are off by x with likelihood exp(−|x/α|^power): 2 is the normal distribution, more is flatter
  bool filmed = false;                 ///< centres are centroids of regions: off by kLopsided
  double orientation_sigma = 0.087;    ///< rad
  bool scattered = true;               ///< each orientation was seen on its own, so that their scatter tells their noise
  bool friction = true;
  Terms terms;
  double slowing = 0;  ///< m/s², by friction of what all slide on, where it is planar

  Resistance resistance(int body) const { return {drag[body], slowing}; }
  double inverse_mass(double ratio) const { return fixed ? 0.0 : 1.0 / ratio; }
  /// Whether a body is in free flight before, or after, the impact.
  bool flies(int body, bool after) const { return after || !rests[body]; }
  /// Whether a body's turning is known from any observation.
  bool turns(int body) const;
  /// Whether a body's shape is known, and how it is turned as far as that matters.
  bool has_pose(int body) const { return solids[body].is_sphere() || (solids[body].known_shape && turns(body)); }
  /// Of the fixed body, towards the first; nothing if not known.
  std::optional<Vec3> normal_of_fixed(const Vec3& down) const { return level ? std::optional(Vec3(-down)) : fixed_normal; }
  /// Whether the impact is one of the centres: nothing tells how the bodies turn, nor where they touch.
  bool is_of_centres() const { return !turns(0) && !turns(1) && !(has_pose(0) && (fixed ? level || fixed_normal : has_pose(1))); }
  /// Whether two shapes meet that are both known.
  bool touches() const { return !fixed && has_pose(0) && has_pose(1); }
};

/// The unknowns. Momenta are per mass of their own body. The contact point and the impulse are those of the impact.
struct State {
  double time = 0;                 ///< of the impact, s
  Vec3 down = Vec3::UnitY();
  std::array<Vec3, 2> p, v, h;     ///< at the impact; v and h just before it
  std::array<Quat, 2> q;
  Vec3 x = Vec3::Zero();           ///< contact point
  Vec3 impulse = Vec3::Zero();     ///< on the first body, of mass 1
  double mass_ratio = 1.0;
  std::array<Vec3, 2> v_after, h_after;  ///< free unknowns of the soft form; functions of the others in the exact one
  std::optional<ContactLaw> law;   ///< of the contact's normal, from the second body to the first; none = along the impulse

  State() : q{Quat::Identity(), Quat::Identity()} {
    for (auto* pair : {&p, &v, &h, &v_after, &h_after}) pair->fill(Vec3::Zero());
  }
};

}  // namespace unseen::collision
