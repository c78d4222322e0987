// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/pose_cost.h"

namespace unseen::collision {

/// A place on a body's surface, principal frame.
struct SurfacePoint {
  Vec3 place = Vec3::Zero();   ///< m
  Vec3 normal = Vec3::UnitZ();  ///< unit, outwards
};

/// Places spread evenly over the surface. Deterministic.
std::vector<SurfacePoint> surface_points(const Body& body, const SpinBody& solid, std::size_t count, const std::string& source);

/// Variance of the colours (logarithms) that places of the body show in several looks, each about its own mean, after taking out what
/// light from a few directions explains (second-order spherical harmonics: Basri and Jacobs, "Lambertian reflectance and linear
/// subspaces", 2003). The right motion has a small one. Zero if no place is seen twice.
double color_variance(const std::vector<SurfacePoint>& points, const Camera& camera, const std::vector<const Look*>& looks,
                      const std::vector<Quat>& orientations);

}  // namespace unseen::collision
