// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/interactions/scenelets.h"

namespace unseen::interactions {

/// Does whoever has this pose use the object: sits on its seat, has a hand on or over its top, or a hand at its shelves?
bool uses(const Pose& pose, const Object& object);

/// For each object of a scenelet: is it used around the scenelet's middle?
std::vector<bool> used_objects(const Scenelet& scenelet);

}  // namespace unseen::interactions
