// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "interactions/matching/windows.h"

namespace unseen::interactions {

/// A person's pose in every frame with a detection: in a window the scenelet's, else the detection's own 3D pose or, where it has none, that of the
/// scenelet that fits best; each bent to the joints that are seen, set on the path, and joined smoothly.
std::vector<PersonFrame> find_motion(const std::vector<Sight>& sights, const std::vector<Reading>& readings, const std::vector<Choice>& windows,
                                     const Database& database, const Path& path, const View& view, double fps);

}  // namespace unseen::interactions
