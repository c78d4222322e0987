// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <vector>

#include "unseen/core/context.h"
#include "unseen/core/mesh.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// A rigid block: a convex mesh with outward faces, and its name in the file.
struct Block {
  std::string name;
  TriangleMesh mesh;
  double density = 300.0;  ///< kg/m³
};

struct CheckOptions {
  std::vector<std::string> supports;  ///< names of the blocks that do not move
  Vec3 up = Vec3::UnitZ();
  double friction = 0.7;
};

/// Whether an assembly stands: contacts, forces, residual, margin. Ids are indices of blocks.
struct Check {
  std::vector<Contact> contacts;
  Stability stability;
  std::vector<Vec3> velocity;          ///< of each block in the collapse motion, unitless; all zero if it stands
  std::vector<Vec3> angular_velocity;
};

/// Rigid-block equilibrium of an exact assembly (thesis Eq. 4.2, 4.3; Whiting et al., "Procedural modeling of
/// structurally-sound masonry buildings", 2009), with a true friction cone. Stands if the residual is below 1e-6.
/// Blocks that are not convex are cut into convex parts. Throws InputError for unknown supports and blocks that are not
/// closed or have no volume.
Check check_assembly(const std::vector<Block>& blocks, const CheckOptions& options, Context& context);

}  // namespace unseen::cuboids
