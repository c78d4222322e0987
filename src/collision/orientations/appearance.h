// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "collision/orientations/spin_search.h"

namespace unseen::collision {

/// A place on a body's surface, principal frame.
struct SurfacePoint {
  Vec3 place = Vec3::Zero();   ///< m
  Vec3 normal = Vec3::UnitZ();  ///< unit, outwards
};

inline constexpr double kColorsPerLook = 8.0;  ///< how many independent colours a look is worth

/// Places spread evenly over the surface. Deterministic.
std::vector<SurfacePoint> surface_points(const Body& body, const SpinBody& solid, std::size_t count, const std::string& source);

/// Variance of the colours (logarithms) that places of the body show in several looks, each about its own mean, after taking out what
/// light from a few directions explains (second-order spherical harmonics: Basri and Jacobs, "Lambertian reflectance and linear
/// subspaces", 2003). The right motion has a small one. Zero if no place is seen twice.
double color_variance(const std::vector<SurfacePoint>& points, const Camera& camera, const std::vector<const Look*>& looks,
                      const std::vector<Quat>& orientations);

/// What a variance of `looks` colours costs beside the `least` one as χ²: nothing where they are as good as alike, for the places
/// that are compared happen to lie beside an edge of the texture or not.
double color_cost(double variance, double least, double looks);

/// The minimum nearest to `start` of what silhouettes (over `noise`, squared) and colours cost together: first with blurred pictures,
/// then with sharp ones. `information` counts both, in units of the silhouettes' noise; `cost` remains that of the silhouettes.
Turning refined_by_colors(const Turning& start, const SpinBody& body, const Camera& camera, const std::vector<Look>& looks,
                          const std::vector<SurfacePoint>& points, double noise);

}  // namespace unseen::collision
