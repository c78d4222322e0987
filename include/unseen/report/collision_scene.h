// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <vector>

#include "unseen/collision/overlay.h"
#include "unseen/collision/types.h"
#include "unseen/core/options.h"
#include "unseen/report/stored_run.h"

namespace unseen::report {

/// What the page shows of a collision result, encoded for page_of (docs/scene.md): the flights, the bodies as they
/// move, contact point, normal and impulses of each impact, the camera with the frames of the clip, the residuals over the frames, tables, and
/// how it was made. `command` is the command line that gives the same result. A shot without bodies (the file is gone) shows balls of
/// the bodies' inertia.
std::string collision_scene(const collision::Reconstruction& reconstruction, const InputRecord& input, const OptionTable& options,
                            const std::string& command, const collision::Shot& shot, const std::vector<collision::OverlayPicture>& pictures);

/// "Collision of shot.json"
std::string collision_title(const InputRecord& input);

/// "0.700 ± 0.010 (95 %: 0.680…0.719)", with as many digits as the deviation has to say something with, three at least; without the deviation where the
/// interval is so uneven that it ends within one.
std::string estimate_text(const collision::Estimate& e);

}  // namespace unseen::report
