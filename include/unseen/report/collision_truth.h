// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>

#include "unseen/collision/synth.h"
#include "unseen/core/options.h"

namespace unseen::report {

/// truth.json of `unseen synth collision` (docs/formats.md). Meshes are named NAME.obj, beside it.
std::string collision_truth_json(const collision::Truth& truth, const OptionTable& options);

/// Reads such a truth.json with its meshes. Throws InputError.
collision::Truth read_collision_truth(const std::filesystem::path& path);

/// The SHOT.json of a simulated shot. What replaces a video is named observations.json, meshes NAME.obj, all beside it.
std::string collision_shot_json(const collision::Shot& shot);

/// That observations.json.
std::string collision_sightings_json(const collision::Shot& shot);

/// The mesh of a body as Wavefront OBJ.
std::string body_obj(const collision::Body& body);

}  // namespace unseen::report
