// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "unseen/collision/types.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// A reconstructed collision at its place in a new shot.
struct StagedCollision {
  std::string name;
  std::string file;  ///< its result.json
  Shot shot;  ///< of which bodies and gravity count
  Reconstruction result;
  std::array<std::optional<Body>, 2> swaps;  ///< other shapes for its bodies; the mass stays
  double time = 0;                   ///< s: when its first impact happens in the new shot
  Vec3 translate = Vec3::Zero();     ///< m, from where it was filmed
  double turn = 0;                   ///< rad, about the vertical through its contact point
  std::optional<double> mass;        ///< kg, of its first body; else as the shot says, else 1
};

/// A body of a shot's collision.
struct StagedBody {
  int collision = 0;  ///< index into StagePlan::collisions
  int body = 0;       ///< 0 or 1
};

/// Two bodies of different collisions that shall collide too, after their own impacts. The collision of one of them is turned and
/// moved for it.
struct StagedMeeting {
  std::array<StagedBody, 2> bodies;
  double time = 0;                    ///< s
  std::optional<double> restitution;  ///< else the geometric mean of what the two showed in their own collisions
};

/// What a new shot is made of.
struct StagePlan {
  std::string name;  ///< the list, for messages
  std::vector<StagedCollision> collisions;
  std::vector<StagedMeeting> meetings;
  double fps = 60;               ///< frames/s
  double duration = 1;           ///< s
  double gravity = 9.81;         ///< m/s²
  std::optional<double> floor;   ///< m, height of a floor that throws each body back as its own collision did
};

/// Something that takes part in the new shot.
struct Actor {
  std::string name;  ///< "one.ball"
  Body body;
  double mass = 1;      ///< kg
  Vec3 inertia = Vec3::Zero();  ///< principal, of unit mass, m²
  double restitution = 0;  ///< √c of its own collision: the product of two is that of the pair
  double friction = 0;     ///< likewise √μ
};

/// A plane that throws bodies back: what is fixed in a collision (for its own body alone), or the floor.
struct Wall {
  std::string name;
  Plane plane;
  int collision = -1;  ///< whose; −1 = the floor
};

/// A collision that the simulation brought about.
struct StagedImpact {
  double time = 0;                     ///< s
  std::array<int, 2> between = {0, 0};  ///< actors; the second is −1 − w for wall w
  double restitution = 0;              ///< measured: −(relative normal velocity after) / (before) at the contact point
  double expected = 0;                 ///< what was put in
  double approach = 0;                 ///< m/s, normal
  Vec3 contact_point = Vec3::Zero();
  Vec3 normal = Vec3::UnitZ();         ///< unit, from the second to the first
};

/// All bodies at one time; `k` in kg m²/s.
struct StagedFrame {
  double time = 0;
  std::vector<BodyState> bodies;
};

/// Where a collision came to lie: what was asked for, or what a meeting needed.
struct Placement {
  std::string name, file;  ///< of the StagedCollision
  double time = 0;  ///< s
  Vec3 translate = Vec3::Zero();
  double turn = 0;  ///< rad
  RigidTransform T_new_filmed;  ///< maps the world of its result to the new shot's
};

/// The new shot. World: z up.
struct StagedShot {
  double fps = 0, gravity = 0;
  Camera camera;                  ///< that of the first collision, and where it came to stand
  RigidTransform T_world_camera;
  std::vector<Actor> actors;
  std::vector<Wall> walls;
  std::vector<Placement> placements;  ///< of each collision
  std::vector<StagedFrame> frames;    ///< at each frame, and at each impact
  std::vector<StagedImpact> impacts;  ///< by time; what touches slower than 5 cm/s is left out
  Summary summary;                    ///< infeasible: an impact that was asked for did not happen
};

/// Combines reconstructed collisions into a new shot (thesis Section 5.4.4): each body flies to its impact as it was reconstructed, and
/// Bullet carries the shot forward with the estimated restitution, mass ratio and friction of each pair. Throws InputError for a
/// result without collision, for meetings that cannot be, and for a mesh that is not closed.
StagedShot stage(const StagePlan& plan, Context& context);

}  // namespace unseen::collision
