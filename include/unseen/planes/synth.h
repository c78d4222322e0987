// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <vector>

#include "unseen/core/context.h"
#include "unseen/core/mesh.h"
#include "unseen/core/options.h"
#include "unseen/core/point_cloud.h"

namespace unseen::planes {

/// What scene to make and how to scan it. Angles in degrees, as on the command line.
struct SynthOptions {
  std::string scene = "room";  ///< lhouse, stairs, room, floorplan (2D) or building
  int points = 200000;         ///< in all, outliers included; met exactly
  double turn = 12.0;      ///< deg, yaw of the turned furniture against the room (room, floorplan, building)
  double share = 0.05;     ///< share of the scanned points on turned furniture; 0 = there is none
  double yaw = 25.0;       ///< deg, of the whole scene against the axes
  int floors = 3;          ///< building: number of storeys
  int scanners = 0;        ///< how many of the scene's scanner positions are used; 0 = all
  double noise = 0.005;    ///< m, standard deviation along the ray (2D: across the line)
  double incidence = 0.0;  ///< how much noise grows with slanted incidence: σ·(1 + incidence·(1/cos − 1))
  double uneven = 0.0;     ///< 0…1, how much density falls with slanted incidence (2D: from line to line)
  double outliers = 0.0;   ///< share of points anywhere in the bounding box; their label is −1
  double registration = 0.0;  ///< m, size of each scan's rigid misplacement; the first scan has none
  bool normals = false;       ///< give each point the true normal of its surface
  int seed = 1;
};

/// The one description of these options; the table points into `options`.
OptionTable describe(SynthOptions& options);

/// Points with exact truth. Labels are indices into `planes`.
struct SynthScene {
  PointCloud cloud;    ///< labels are those of the surface hit, −1 for outliers; viewpoint if one scanner
  TriangleMesh truth;  ///< labelled; floorplan: the lines extruded by 1 m up and down
  std::vector<Plane> planes;   ///< label → plane
  std::vector<int> frames;     ///< label → index into `axes`
  std::vector<Mat3> axes;      ///< orientation frames; columns are their three axes. 0 is the scene's own
  std::vector<int> turned;     ///< labels of the turned furniture
  std::vector<Vec3> scanners;  ///< m, the positions used; empty for the floorplan
  bool two_dimensional = false;
};

/// Builds the scene and scans it by casting rays on each scanner's angular grid, so that occlusion is that
/// of a real scan. The grid is made as fine as `points` and `share` need, and what is too much is dropped at
/// random. Same options, same bytes, at any thread count.
/// Throws InputError for options outside their range, and for a share that no grid can reach.
SynthScene make_scene(const SynthOptions& options, Context& context);

}  // namespace unseen::planes
