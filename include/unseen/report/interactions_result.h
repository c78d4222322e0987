// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>

#include "unseen/core/options.h"
#include "unseen/interactions/types.h"
#include "unseen/report/stored_run.h"

namespace unseen::report {

/// The whole result.json of an interactions run (docs/formats.md): SI units, an object's yaw in radians, the camera's pitch and roll in
/// degrees, numbers in the shortest form that reads back to the same bits. An object's "center", "size" and "yaw" are those of the
/// smallest upright box around its parts that is turned as its first main part is. Of the evidence map it holds the geometry only.
/// Throws std::logic_error if a number is not finite.
std::string interactions_json(const interactions::Reconstruction& reconstruction, const InputRecord& input, const OptionTable& options);

/// Reads such a file back and checks it: types, ranges, rigid axes, frames in order, that ids are unique and windows exist. Throws
/// InputError naming file and field.
interactions::Reconstruction read_interactions_result(const std::filesystem::path& path);

/// The same from text; `source` names it in messages.
interactions::Reconstruction parse_interactions_result(const std::string& text, const std::string& source);

/// The upright box around an object: axes x, y level, z up.
OrientedBox upright_box(const interactions::Object& object);

}  // namespace unseen::report
