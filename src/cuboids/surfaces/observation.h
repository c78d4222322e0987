// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cuboids/surfaces/depth_view.h"
#include "cuboids/surfaces/point_graph.h"
#include "unseen/core/context.h"
#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/options.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// Where world coordinates come from: up from the frame, or from the dominant horizontal plane.
struct Observation {
  RigidTransform T_world_camera;
  std::vector<Support> supports;     ///< ids 0, 1, …; the first is the ground
  std::vector<Vec3> points;          ///< world, m
  std::vector<int> pixel_of_point;   ///< index into the depth image; empty for a fused cloud
  std::vector<int> support_of_point; ///< index into supports, −1 = none
  std::vector<int> point_of_pixel;   ///< −1 = none; empty for a fused cloud
  std::vector<Vec2> tints;           ///< of the pixels (tints.h); empty without colours, and for a fused cloud
  PointGraph graph;                  ///< neighbours, normals (world) and noise of the points
};

/// The points of one object, or of one disjoint visible part of it.
struct ObjectPart {
  std::vector<int> points;  ///< indices into Observation::points
  std::string label;
  bool free_orientation = false;  ///< its axes come from its two largest planes, not from up
  int stack = -1, level = -1;     ///< parts on different levels of the stack with this number are not one; −1 = of none
};

/// Stage 1: cloud, world, supports (design page, step 1).
Observation observe(const RgbdFrame& frame, const Options& options, Context& context);
/// Stage 2: points without support points, grouped (step 2).
std::vector<ObjectPart> find_objects(const RgbdFrame& frame, const Observation& seen, const Options& options, Context& context);
/// Stage 3: boxes around what is visible of each part (step 3). Ids follow those of the supports.
std::vector<Cuboid> fit_cuboids(const RgbdFrame& frame, const Observation& seen, const std::vector<ObjectPart>& parts,
                                const DepthView& view, const Options& options, Context& context);
/// Stage 4: visible box edges pulled to edges of the colour image (step 4, Eq. 4.1).
void align_to_image_edges(const RgbdFrame& frame, const Observation& seen, const DepthView& view,
                          std::vector<Cuboid>& cuboids, const Options& options, Context& context);

}  // namespace unseen::cuboids
