// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "collision/synth/synth_motion.h"
#include "unseen/collision/synth.h"

namespace unseen::collision {

/// One draw of a scene: its first contact, from which everything before and after follows. World coordinates.
struct SynthPlan {
  std::vector<Body> bodies;             ///< as in Shot; the second may be fixed, and then nothing but the floor
  std::vector<SynthMover> movers;       ///< of the bodies that move
  std::vector<SynthState> states;       ///< of the movers at `time`, just before the contact
  std::optional<SynthHit> hit;          ///< the contact's point and normal; none = no collision
  double time = 0;                      ///< of the contact, s
  int frames = 0;                       ///< of the shot; the simulation may end before
  Vec3 gravity = Vec3(0, 0, -9.81);     ///< m/s²
  std::optional<Plane> floor;           ///< what bodies bounce off, beside each other
  double restitution = 0, floor_restitution = 0;
  double least_approach = 1;            ///< normal speed of the first contact, m/s
  double least_spin = 0, most_spin = 30;  ///< of the faster body after the first contact, rad/s
  std::size_t least_impacts = 0;        ///< of those that count, in the shot
  bool once = false;                    ///< a second contact ends the shot
  double least_after = 0;               ///< s of flight after the first contact
  Camera camera;
  RigidTransform T_world_camera;
  bool watched = true;                  ///< bodies must stay in the picture and be seen apart before and after
};

/// Draws bodies, contact, velocities and camera of `options.scene`.
SynthPlan draw_plan(const SynthOptions& options, Random& random);

/// The plan's motion before and after: frames and impacts of `truth`, which is otherwise filled by the caller. False if bodies pass
/// through each other, or if the shot is not what the plan asks for.
bool carry_out(const SynthPlan& plan, const SynthOptions& options, Truth& truth);

/// Columns of the picture, from the first to before the last, that a curtain takes which hides an impact at `contact` (camera coordinates).
std::array<int, 2> curtain_columns(const std::vector<SynthMover>& movers, const Vec3& contact, const Camera& camera);

/// Whether the bodies are seen well: in the picture for most of the time about the first impact, apart on both sides of it, and each for
/// some time beside the curtain if there is one.
bool well_seen(const SynthPlan& plan, const SynthOptions& options, const Truth& truth);

/// Sightings (pixel: projected centre of mass; radius: that of a disc with the silhouette's area) and orientations, with noise.
void observe(const Truth& truth, const SynthOptions& options, Shot& shot);

/// Convex hull of what a body covers in the picture, px, in order; a sphere's is a polygon of its outline.
std::vector<Vec2> silhouette(const SynthBody& body, const SynthPose& pose, const Camera& camera, const RigidTransform& T_world_camera);

}  // namespace unseen::collision
