// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "collision/tracks/candidates.h"
#include "unseen/core/context.h"

namespace unseen::collision {

/// Tracks of sightings that are labelled already, one a frame and body: no search for who is who, but for the time at which flights in space
/// that meet explain the sightings best. Works at any noise that leaves an impact visible. Nothing if sightings are unlabelled, too few or too many,
/// or if no such flights explain them.
std::optional<Tracks> search_pair(const Shot& shot, const ShotCamera& camera, const Candidates& candidates, double fps, double least_noise, Context& context);

}  // namespace unseen::collision
