// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "unseen/core/geometry.h"
#include "unseen/core/summary.h"

namespace unseen::cuboids {

enum class SupportKind { ground, desk, wall, ceiling };
inline constexpr const char* kSupportKinds[] = {"ground", "desk", "wall", "ceiling"};

/// A static body of infinite mass that fills the half space behind its plane.
struct Support {
  int id = -1;  ///< unique over supports and cuboids together
  SupportKind kind = SupportKind::ground;
  Plane plane;                ///< world; the normal points to the side where things are
  std::vector<Vec3> outline;  ///< convex outline of what was seen of it, counter-clockwise; empty = without end
};

/// A box of the scene.
struct Cuboid {
  int id = -1;
  OrientedBox box;      ///< completed
  OrientedBox initial;  ///< as fitted to what was seen
  std::size_t visible_points = 0;
  double density = 300.0;  ///< kg/m³
  std::string label;       ///< of the mask or stroke it came from, or empty
  std::optional<Vec2> tint;    ///< of what was seen of it, if that is of one plain colour: a and b of CIELAB under a light of one strength
  int stack = -1, level = -1;  ///< boxes on different levels of the stack with this number were seen to be different ones; −1 = in none
  int object = -1;         ///< boxes with the same number are pieces of one thing, and rigid together; −1 = a thing of its own
  bool by_symmetry = false;  ///< wholly unseen, completed by symmetry (thesis Section 4.4.1)

  double mass() const { return density * box.volume(); }
  /// Whether it holds a part that nobody saw, by more than a percent of its volume.
  bool is_completed() const { return by_symmetry || box.volume() > 1.01 * initial.volume(); }
};

enum class ContactKind { touching, fixed };
inline constexpr const char* kContactKinds[] = {"touching", "fixed"};

/// How two bodies meet. `a` and `b` are ids of supports or cuboids; a is the support, if one is.
struct Contact {
  int a = -1, b = -1;
  ContactKind kind = ContactKind::touching;
  Vec3 direction = Vec3::UnitZ();  ///< unit, from a to b
  std::vector<Vec3> points;        ///< 1 (point), 2 (edge) or 3 to 8 points of the interface (touching)
  std::vector<Vec3> forces;        ///< N, on b, one a point; empty if fixed
};

/// How surely it stands.
struct Stability {
  double residual = 0;         ///< largest over bodies of |force|/weight and |torque|/(weight · half size)
  bool stable = false;         ///< all but those that nothing can support, which count as held
  double margin = 0;           ///< largest horizontal acceleration that it bears, in g, worst of 16 directions
  double friction_needed = 0;  ///< smallest μ with which it still stands
};

struct SearchReport {
  std::size_t nodes = 0, pruned = 0;
  bool optimal = false;
};

/// A scene in static equilibrium. World coordinates: z up, z = 0 on the ground support, the origin below the camera.
struct Completion {
  RigidTransform T_world_camera;
  double depth_noise = 0;  ///< m: σ of the depth at 1 m, as given or measured; 0 without a frame
  std::vector<Support> supports;
  std::vector<Cuboid> cuboids;
  std::vector<Contact> contacts;
  Stability stability;
  int fixed_contacts = 0;
  double extended_volume = 0;    ///< m³
  std::vector<int> unsupported;  ///< ids of cuboids that nothing can support
  std::vector<int> held_outside;  ///< ids of cuboids that the picture cuts off, and that only something outside it can hold
  std::vector<int> may_move;  ///< ids of cuboids that stand within the tolerance of their contacts only, or fall at a slight push
  SearchReport search;
  Summary summary;

  /// Nothing in the scene holds a cuboid up.
  bool hangs(int id) const { return std::count(unsupported.begin(), unsupported.end(), id) + std::count(held_outside.begin(), held_outside.end(), id) > 0; }
};

}  // namespace unseen::cuboids
