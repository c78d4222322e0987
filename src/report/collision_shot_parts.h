// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <vector>

#include "io/json_field.h"
#include "unseen/collision/types.h"

namespace unseen::report {

using io::JsonField;

/// Three numbers that are not all 0, made a unit vector.
Vec3 read_direction(const JsonField& json);

/// "mesh", "box", "sphere", "size" or "fixed", whichever there is.
void read_shape(collision::Body& body, const JsonField& json, const std::filesystem::path& folder);

/// An entry of "bodies"; `folder` is what a mesh's path is relative to.
collision::Body read_body(const JsonField& json, const std::filesystem::path& folder);

/// "camera", or what is assumed without it: 60° across.
collision::ShotCamera read_shot_camera(const JsonField& shot);

/// The file that "observations" names. Labels are names of `bodies`.
std::vector<collision::Sighting> read_sightings(const std::filesystem::path& path, const std::vector<collision::Body>& bodies, const Camera& camera);

/// The place of the named body that moves.
int free_body(const JsonField& name, const std::vector<collision::Body>& bodies);

}  // namespace unseen::report
