// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/collision/types.h"

namespace unseen::collision {

/// A body of unit mass and even density.
struct MassProperties {
  Vec3 center = Vec3::Zero();         ///< of mass, in the file's axes, m
  Mat3 axes = Mat3::Identity();       ///< columns: principal axes in the file's axes, right-handed
  Vec3 inertia = Vec3::Zero();        ///< about them, m²
  double volume = 0;                  ///< m³
  double extent = 0;                  ///< diameter of the sphere with the body's mean projected area, m
  double reach = 0;                   ///< largest distance of its surface from the centre, m
};

/// By volume integrals over a closed mesh (Mirtich, "Fast and accurate computation of polyhedral mass properties", 1996), or in
/// closed form. Throws InputError (naming `source`) for a mesh that is not closed or has no volume.
MassProperties mass_properties(const Body& body, const std::string& source);

}  // namespace unseen::collision
