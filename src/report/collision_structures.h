// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "report/scene_builder.h"
#include "unseen/collision/overlay.h"
#include "unseen/collision/types.h"

namespace unseen::report {

/// The parts of a collision's page (docs/scene.md), each a structure.
void add_bodies(SceneBuilder& scene, const collision::Shot& shot, const collision::Reconstruction& r);
void add_fixed(SceneBuilder& scene, const collision::Shot& shot, const collision::Reconstruction& r);
/// A segment a frame and body, in the colour of its flight; the residuals are a quantity of them.
void add_flights(SceneBuilder& scene, const collision::Reconstruction& r, double gravity);
void add_impacts(SceneBuilder& scene, const collision::Reconstruction& r);
void add_clip(SceneBuilder& scene, const collision::Reconstruction& r, const std::vector<collision::OverlayPicture>& pictures);
void add_residual_chart(SceneBuilder& scene, const collision::Reconstruction& r);

}  // namespace unseen::report
