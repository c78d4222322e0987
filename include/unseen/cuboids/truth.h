// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "unseen/core/geometry.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// A box of which the truth is known: all of it (generator), or its sizes only (measured with a ruler).
struct TrueCuboid {
  int id = -1;               ///< unique over supports and cuboids together
  Vec3 size = Vec3::Zero();  ///< m; without a pose in falling order
  std::optional<OrientedBox> box;
  double density = 300.0;    ///< kg/m³
  std::array<double, 6> hidden = {};  ///< share of each face that the camera does not see: −x, +x, −y, +y, −z, +z
  Vec3 seen = Vec3::Ones();  ///< share of each dimension that what the camera sees of it spans; below 0.9 = hidden
  std::vector<Vec3> points;  ///< what is visible of it, in the camera's coordinates; only without a pose
  std::string name;
};

/// What a frame really shows. World coordinates as in Completion; contacts are pairs with a kind only.
struct Truth {
  std::string family;  ///< of the generator, or the name of the frame
  bool stands = true;
  RigidTransform T_world_camera;
  std::vector<Support> supports;
  std::vector<TrueCuboid> cuboids;
  std::vector<Contact> contacts;
};

}  // namespace unseen::cuboids
