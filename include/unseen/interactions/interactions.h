// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/core/context.h"
#include "unseen/interactions/options.h"
#include "unseen/interactions/scenelets.h"
#include "unseen/interactions/types.h"

namespace unseen::interactions {

/// Furniture and motion from joint detections: thesis Chapter 6, docs/interactions.md.
/// Several takes of one room from one camera merge into one scene. Throws InputError for a take without a usable detection;
/// cancellation gives Status::cancelled, a take in which nothing is found Status::infeasible.
Reconstruction reconstruct(const std::vector<Take>& takes, const Database& database, const Options& options, Context& context);

}  // namespace unseen::interactions
