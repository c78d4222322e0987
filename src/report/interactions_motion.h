// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>

#include "unseen/interactions/types.h"

namespace unseen::report {

/// Median length of each of kBones over a person's frames, m; 0 without frames.
std::array<double, interactions::kBones.size()> bone_lengths(const interactions::Person& person);

}  // namespace unseen::report
