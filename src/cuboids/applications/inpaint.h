// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>

#include "cuboids/applications/patch_match.h"
#include "unseen/core/context.h"

namespace unseen::cuboids {

/// Fills the hole with patches of the rest of the picture, from coarse to fine (Wexler et al., "Space-time completion of
/// video", 2007, with PatchMatch as the search). Pixels outside the hole keep their bits. The same picture and seed
/// give the same bits. If all patches meet the hole, it is filled smoothly from its rim.
std::vector<Color> inpaint(const HoledPicture& picture, std::uint64_t seed, Context& context);

}  // namespace unseen::cuboids
