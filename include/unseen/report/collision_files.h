// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/collision/types.h"

namespace unseen::report {

/// scene.glb (binary glTF 2.0): a node a body, centred at its centre of mass, whose animation has a linear key a frame and one at each
/// impact, in the shot's seconds; what is fixed as a quad; the camera. The root node turns z up into glTF's y up. Throws InputError for
/// a mesh that is not closed.
std::string collision_glb(const collision::Shot& shot, const collision::Reconstruction& reconstruction);

}  // namespace unseen::report
