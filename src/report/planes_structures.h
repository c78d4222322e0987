// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "report/point_order.h"
#include "report/scene_builder.h"
#include "report/surfaces.h"
#include "unseen/planes/types.h"

namespace unseen::report {

/// Each adds one structure of a planes result to a scene (docs/scene.md): polygons (2D: segments), with where they
/// lie on planes fitted freely; points with frame, plane and residual; directions and their relations; normals of the
/// input and of the result.
void add_surfaces(SceneBuilder& scene, const planes::Arrangement& arrangement, const std::vector<Surface>& surfaces,
                  const OrderedPoints& points);
void add_points(SceneBuilder& scene, const planes::Arrangement& arrangement, const OrderedPoints& points);
void add_relations(SceneBuilder& scene, const planes::Arrangement& arrangement);
void add_normals(SceneBuilder& scene, const planes::Arrangement& arrangement, const OrderedPoints& points);

}  // namespace unseen::report
