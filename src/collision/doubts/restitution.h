// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/collision/types.h"

namespace unseen::collision {

/// One value from several estimates of the same thing: weighted by their precision; no surer than they agree. `common`: the part of each one's
/// error that comes from what all share; products are covariances.
Estimate pooled(const std::vector<Estimate>& estimates, const std::vector<Vec3>& common = {});

}  // namespace unseen::collision
