// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "collision/tracks/pair_links.h"

namespace unseen::collision {

/// Collisions with a body so heavy that its flight hardly shows them, best first, and the arcs that they are of.
struct HeavyHits {
  std::vector<Arc> arcs;
  std::vector<Collision> found;
};

/// What flies on as one arc is parted where something beside it is pushed away from it. Nothing if no such push is found.
std::optional<HeavyHits> find_heavy_hits(const Shot& shot, const Candidates& candidates, const std::vector<Arc>& arcs, double noise, double jitter, double fps,
                                         Context& context);

}  // namespace unseen::collision
