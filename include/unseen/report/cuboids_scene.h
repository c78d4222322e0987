// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/core/options.h"
#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/types.h"
#include "unseen/report/stored_run.h"

namespace unseen::report {

/// What the page shows of a cuboids result, encoded for page_of (docs/scene.md): boxes with the part that was seen and
/// as they were fitted first, who carries whom with what force, supports, the depth cloud, the camera with its
/// photograph, tables, and how it was made. `command` is the command line that gives the same result. A frame without
/// depth and cloud leaves out what it would show.
std::string cuboids_scene(const cuboids::Completion& completion, const InputRecord& input, const OptionTable& options,
                          const std::string& command, const RgbdFrame& frame);

/// "Boxes of kitchen"
std::string cuboids_title(const InputRecord& input);

/// "1.26 l" of a volume in m³.
std::string volume_text(double volume);

}  // namespace unseen::report
