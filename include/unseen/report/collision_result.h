// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>

#include "unseen/collision/types.h"
#include "unseen/core/options.h"
#include "unseen/report/stored_run.h"

namespace unseen::report {

/// The whole result.json of a collision run (docs/formats.md, docs/schema/collision.schema.json): SI units, numbers in the shortest
/// form that reads back to the same bits. Throws std::logic_error if a number is not finite.
std::string collision_json(const collision::Reconstruction& reconstruction, const InputRecord& input, const OptionTable& options);

/// Reads such a file back and checks it: types, ranges, unit quaternions and normals, that names exist and that the shot's values are
/// those of its first impact. Velocity and angular momentum of `frames` are not stored and come back as 0. Throws InputError naming
/// file and field.
collision::Reconstruction read_collision_result(const std::filesystem::path& path);

/// The same from text; `source` names it in messages.
collision::Reconstruction parse_collision_result(const std::string& text, const std::string& source);

}  // namespace unseen::report
