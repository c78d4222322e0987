// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "planes/select.h"
#include "unseen/planes/types.h"

namespace unseen::planes {

/// A frame in the tree that shared axes make: a child keeps one axis of its parent exactly and may only turn
/// about it (a table turned on the floor keeps the floor's up).
struct FrameNode {
  OrientationFrame frame;
  int parent = -1;
  int parent_axis = -1;  ///< which axis of the parent it shares; it is this frame's first axis
};

/// A plane on its way to the result: which direction it has, which voxels support it.
struct PlaneModel {
  int frame = -1, local = -1;  ///< node, index into local_directions
  Patch support;
  double offset = 0;
  int coplanar = -1;  ///< planes with the same number share one offset
};

/// Everything the refit changes together.
struct Model {
  std::vector<Vec3> locals;
  std::vector<FrameNode> nodes;  ///< a parent comes before its children
  std::vector<PlaneModel> planes;

  Vec3 normal(const PlaneModel& p) const { return nodes[p.frame].frame.direction(locals[p.local]); }
};

/// Turns a selection into a model: frames that do not differ significantly become one, axes that do not differ
/// significantly are shared, and patches of one direction that adjoin within the scale become one plane.
Model build_model(const Selection& selection, const Patches& patches, const VoxelGrid& grid, const Cells& cells,
                  const AngleSet& angles, const Space& space, Context& context);

/// Least squares over all planes at once with every relation kept exact: a rotation a frame (one angle where
/// an axis is shared), an offset a plane or coplanar group.
void refit(Model& model);

/// Replaces a plane's moments, e.g. by those of the points assigned to it; its variances are scaled along.
void update_support(PlaneModel& plane, const Moments& moments, const Space& space);

}  // namespace unseen::planes
