// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "cuboids/surfaces/faces.h"

namespace unseen::cuboids {

inline constexpr double kOffPlane = 6.0;  ///< σ, of what does not lie on a plane

/// Cosines that tell level from leaning and upright from leaning, both by 10°.
inline const double kHorizontal = std::cos(radians(10.0)), kVertical = std::sin(radians(10.0));

/// Points of a frame as the supports see them: camera coordinates, viewpoint at the origin.
struct Scan {
  std::span<const Vec3> points;
  const PointGraph& graph;
  const Faces& faces;
  bool is_image = true;  ///< depth along z, noise in 1/z the same everywhere
  std::span<const int> pixel_of_point{}, point_of_pixel{};  ///< of an image
  int width = 0;                                            ///< pixels, of an image

  int height() const { return static_cast<int>(point_of_pixel.size()) / width; }
};

/// Faces of one plane.
struct Level {
  Plane plane;
  double area = 0;     ///< m²
  double carried = 0;  ///< points that stand on it
  std::vector<int> faces;
  std::vector<Vec2> outline;  ///< m, counter-clockwise; empty until it is asked for
};

/// Indices of all points of some faces.
std::vector<int> points_of(const Scan& scan, const std::vector<int>& faces);

/// rad: standard error of the normal of a plane through points, in the direction in which they tell least of it.
double tilt_error(const Scan& scan, std::span<const int> points);

/// Faces of one plane, largest first; each face joins the first plane that it lies on.
std::vector<Level> coplanar(const Scan& scan, std::vector<int> faces);

/// The convex outline of a level's points, along two directions.
void set_outline(const Scan& scan, Level& level, const Vec3& u, const Vec3& v);

/// That outline as points of the level's plane, which need not be orthogonal to u × v.
std::vector<Vec3> lifted(const Level& level, const Vec3& u, const Vec3& v);

/// A ground of which no more than a strip is seen, as behind a table, tells little of up: then the level does whose normal is surest.
/// @returns the standard error of the ground's normal (rad)
double level_with_surest(const Scan& scan, const std::vector<Level>& levels, Level& ground);

/// A desk is level with the ground of that normal (standard error: rad), if that tells better how it lies and no more than a few degrees say otherwise.
void level_with_ground(const Scan& scan, const Vec3& normal, double error, Level& desk);

/// Plane through points, robust. For an image the linear regression of 1/z on the ray, whose noise is the same
/// everywhere; for a cloud weighted total least squares. The normal points to the viewpoint.
Plane fit_support(const Scan& scan, std::span<const int> points);

}  // namespace unseen::cuboids
