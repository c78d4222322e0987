// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/solve/contact.h"
#include "unseen/collision/stage.h"

namespace unseen::collision {

/// A body's motion at one time: flight through `p` with `v`, turning with the angular momentum `h` of unit mass. `q` maps principal axes
/// to the world.
struct StageState {
  double time = 0;
  Vec3 p = Vec3::Zero(), v = Vec3::Zero(), h = Vec3::Zero();
  Quat q = Quat::Identity();
};

/// An actor as the simulation needs it.
struct CastActor {
  Actor actor;
  int collision = 0, body = 0;
  bool mass_known = false;  ///< else its collision's first body is taken to have 1 kg
  Solid solid;
  StageState impact;  ///< just before its collision's first impact
};

/// What holds between two that have an estimate of their own.
struct CastPair {
  int a = 0, b = 0;  ///< actors; b = −1 − w for a wall
  double restitution = 0, friction = 0;
  double time = 0;   ///< s: when they shall collide
  int meeting = -1;  ///< −1: a collision's own
  Vec3 rub = Vec3::Zero();  ///< direction of the estimated impulse across the normal; 0 = against the sliding
};

/// Everything that a simulation starts from.
struct Cast {
  std::vector<CastActor> actors;
  std::vector<Wall> walls;
  std::vector<CastPair> pairs;
  std::vector<Placement> placements;
  double gravity = 9.81;
};

/// Puts every collision where the plan says, its bodies so that they touch at the impact. Throws InputError.
Cast cast_of(const StagePlan& plan, Context& context);

/// Where a free flight goes; either way in time.
StageState flown(const CastActor& actor, const StageState& from, double gravity, double time);

/// Places a collision anew.
void place(Cast& cast, const StagePlan& plan, int collision, const Vec3& translate, double turn);

/// The actor of a plan's body.
int actor_of(const Cast& cast, const StagedBody& body);

/// "one.ball and two.floor"
std::string pair_name(const Cast& cast, int a, int b);

/// Turns and moves a collision for each meeting, in their order. Throws InputError if it finds no place.
void arrange_meetings(Cast& cast, const StagePlan& plan, Context& context);

/// What was asked for and did not happen within a frame, or was disturbed, a line each. With `until` only what is due by then.
std::vector<std::string> missed(const Cast& cast, const std::vector<StagedImpact>& impacts, double tolerance, double until);

}  // namespace unseen::collision
