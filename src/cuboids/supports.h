// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "cuboids/faces.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// Counter-clockwise convex outline of points in the plane.
std::vector<Vec2> convex_outline(std::vector<Vec2> points);
bool inside_outline(std::span<const Vec2> outline, const Vec2& p, double margin);

/// Static surfaces among the faces of a frame, in the camera's coordinates; the first is the ground.
struct FoundSupports {
  Vec3 up = Vec3::UnitY();
  std::vector<Support> supports;  ///< outline empty = without end
  std::vector<std::vector<int>> points;
  bool upside_down = false;  ///< nothing faces the given up, but much its opposite
};

/// Points of a frame as the supports see them: camera coordinates, viewpoint at the origin.
struct Scan {
  std::span<const Vec3> points;
  const PointGraph& graph;
  const Faces& faces;
  bool is_image = true;  ///< depth along z, noise in 1/z the same everywhere
};

/// The direction that most large faces agree is up. A picture taken upright or looking down decides between floors
/// and walls.
Vec3 find_up(const Scan& scan);

/// Ground: the lowest large horizontal surface that carries things. Then walls that
/// bound what was seen, ceilings. Empty supports if there is no ground.
FoundSupports find_supports(const Scan& scan, const Vec3& up);

/// Plane through points, robust. For an image the linear regression of 1/z on the ray, whose noise is the same
/// everywhere; for a cloud weighted total least squares. The normal points to the viewpoint.
Plane fit_support(const Scan& scan, std::span<const int> points);

}  // namespace unseen::cuboids
