// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>

#include "unseen/collision/types.h"

namespace unseen::report {

/// Reads a SHOT.json (docs/formats.md, docs/schema/collision-shot.schema.json) with the meshes and the sightings that it names; paths
/// are relative to its folder. The free body comes first, whatever the file's order. Throws InputError (file, field, found, expected),
/// also for fields that it does not know and for sizes that nothing thrown before a camera has.
collision::Shot read_shot(const std::filesystem::path& path);

}  // namespace unseen::report
