// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "unseen/core/geometry.h"
#include "unseen/core/summary.h"

namespace unseen::planes {

/// A simple polygon in a plane: the outline first, counter-clockwise seen from the tip of the normal, then
/// its holes, clockwise. No ring repeats its first point. Metres.
using Polygon = std::vector<std::vector<Vec3>>;

/// One plane of the arrangement (a line in 2D, where all points share one coordinate). Its normal is that of its direction, up to sign.
struct ArrangedPlane {
  Plane plane;
  int direction = -1;                           ///< index into Arrangement::directions
  int frame = -1;                               ///< index into Arrangement::frames
  double area = 0;                              ///< m², of the polygon (2D: length of the segment, m)
  std::size_t points = 0;                       ///< how many points are assigned to it
  double rms = 0;                               ///< m, of those points' distances
  std::string tag;                              ///< "floor", "ceiling", "wall", … or empty
  Polygon polygon;                              ///< empty in 2D
  std::optional<std::array<Vec3, 2>> segment;   ///< 2D only: its two ends
  double turned = 0, turned_error = 0;          ///< rad, from the plane that its points fit best, and its standard error by their noise
};

/// A class of exactly parallel planes.
struct Direction {
  Vec3 normal = Vec3::UnitZ();
  int frame = -1;
};

/// Orientation frame: directions whose mutual angles are exact, and the planes that have them.
struct Frame {
  std::vector<int> directions, planes;
};

/// Two directions at one of the angles asked for, exact within 0.01°.
struct Relation {
  int a = -1, b = -1;  ///< direction indices, a ≠ b
  double angle = 0;    ///< rad, in [0, π/2]; the angle of Θ that holds, folded
};

/// Parallel planes at equal steps (treads of a stair, rows of windows). Second order: reported, not enforced.
struct Spacing {
  std::vector<int> planes;  ///< in the order of their offsets
  double step = 0;          ///< m
  double rms = 0;           ///< m, deviation of the offsets from equal steps
};

/// Two parallel planes that face each other.
struct Distance {
  int a = -1, b = -1;  ///< plane indices
  double distance = 0; ///< m
};

/// Planes of one direction whose extents agree (equal length): reported, not enforced.
struct EqualLength {
  std::vector<int> planes;
  double length = 0;  ///< m, the mean of their longer sides
  double rms = 0;     ///< m
};

/// The result: exact planes, how they relate, and how it was found.
struct Arrangement {
  bool two_dimensional = false;
  double scale = 0;            ///< ρ, m
  std::vector<double> angles;  ///< rad, the generators asked for
  double lambda = 0.5;
  std::vector<ArrangedPlane> planes;
  std::vector<Direction> directions;
  std::vector<Frame> frames;
  std::vector<Relation> relations;
  std::size_t plane_relations = 0;  ///< pairs of planes that the relations (and parallelism) make
  std::vector<std::vector<int>> coplanar;
  std::vector<Spacing> spacing;
  std::vector<Distance> distances;
  std::vector<EqualLength> equal_lengths;
  Summary summary;
};

/// The axis (0…2) along which a drawing is flat: across its first line and that one's normal, or z. Nothing in 3D.
std::optional<int> flat_axis(const Arrangement& arrangement);

/// The two other axes of a drawing, in their order: as x and y, or x and z, they run right and up on paper.
std::array<int, 2> drawing_axes(const Arrangement& drawing);

/// Receives the plane of each point, block after block in input order; −1 = none.
/// `positions` are the block's points as read.
using AssignmentSink = std::function<void(std::span<const Vec3> positions, std::span<const int> plane_of_point)>;

}  // namespace unseen::planes
