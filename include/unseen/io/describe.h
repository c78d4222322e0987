// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/core/options.h"
#include "unseen/io/points.h"

namespace unseen::io {

/// The one description of these options; the table points into `options`. The seed and the number of points
/// sampled on meshes are left to the caller.
OptionTable describe(ReadOptions& options);

}  // namespace unseen::io
