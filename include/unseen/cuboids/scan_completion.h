// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/core/context.h"
#include "unseen/core/point_cloud.h"
#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

struct ScanCompletionOptions {
  double fill = 0.7;      ///< share of filled voxels in a box of the model, in (0, 1)
  double noise = 0.0015;  ///< σ of the depth at 1 m, m; grows with the square of the depth
  double reach = 0.05;    ///< m: points of scan and model so near to each other may be the same, > 0
};

/// A box of the model that is a cuboid of the scene.
struct BoxMatch {
  int model_box = -1;  ///< index
  int cuboid = -1;     ///< id
};

/// A scene with a good scan of an object in the place where the scene shows part of such an object.
struct ScanCompletion {
  bool found = false;                   ///< false: nothing in the scene is like the model
  RigidTransform T_world_model;         ///< a turn about up and a move
  std::vector<OrientedBox> model_boxes; ///< in the model's coordinates
  std::vector<BoxMatch> matches;
  double rms = 0;                       ///< m, of the scene's points from the model's surface
  double explained = 0;                 ///< share of the points of the matched cuboids that lie on the model
  PointCloud completed;                 ///< world; label 0 = measured, 1 = of the model
};

/// Completes a partial scan by a good one of the same kind of object (thesis, Section 4.5 (i)): boxes of the model are
/// matched to those of the scene, aligned by edges that correspond, and refined on the points. The model stands upright
/// (z up) in metres. Throws InputError for a model without points or of a size that no object has.
ScanCompletion complete_scan(const RgbdFrame& frame, const Completion& scene, const PointCloud& model,
                             const ScanCompletionOptions& options, Context& context);

/// The finite measured points of a frame in world coordinates, with their colours.
PointCloud cloud_in_world(const RgbdFrame& frame, const RigidTransform& T_world_camera);

}  // namespace unseen::cuboids
