// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "collision/tracks/candidates.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// The fewest flights in space that explain the sightings of a body that bounces off something fixed: one a frame, in order, off by `noise` px.
/// Nothing if they are too few or too many, or show no two flights that follow each other.
std::optional<Tracks> search_chain(const Shot& shot, const ShotCamera& camera, std::vector<Candidate> seen, int body, double fps, double noise, Context& context);

/// The same for a filmed ball that comes and goes along the view ray: its sizes must say that it turns where two flights meet.
std::optional<Tracks> search_return(const Shot& shot, const ShotCamera& camera, const std::vector<Candidate>& seen, int body, double fps, double noise,
                                    Context& context);

}  // namespace unseen::collision
