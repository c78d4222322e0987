// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
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
  std::vector<int> labels;            ///< values of the label image that mark it; empty with a pose
  std::string name;
};

/// Which object each pixel shows, for truth without poses.
struct LabelImage {
  int width = 0, height = 0;
  std::vector<std::int32_t> labels;
};

/// What a frame really shows. World coordinates as in Completion; contacts are pairs with a kind only.
struct Truth {
  std::string family;  ///< of the generator, or the name of the frame
  bool stands = true;
  RigidTransform T_world_camera;
  std::vector<Support> supports;
  std::vector<TrueCuboid> cuboids;
  std::vector<Contact> contacts;
  LabelImage image;  ///< empty if all cuboids have poses
};

}  // namespace unseen::cuboids
