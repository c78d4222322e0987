// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/core/options.h"
#include "unseen/planes/types.h"
#include "unseen/report/planes_result.h"
#include "unseen/report/point_sample.h"

namespace unseen::report {

/// What the page shows of a planes result, encoded for page_of (docs/scene.md): planes and points with frame, plane
/// and residual, relations, normals before and after, the table, and how it was made. `command` is the command
/// line that gives the same result.
std::string planes_scene(const planes::Arrangement& arrangement, const InputRecord& input, const OptionTable& options,
                         const std::string& command, const PointSample& points);

/// "Planes of scan.ply"
std::string planes_title(const planes::Arrangement& arrangement, const InputRecord& input);

}  // namespace unseen::report
