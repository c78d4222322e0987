// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>

#include "unseen/core/options.h"
#include "unseen/planes/types.h"
#include "unseen/report/stored_run.h"

namespace unseen::report {

/// The whole result.json of a planes run (docs/formats.md, docs/schema/planes.result.schema.json). Angles are
/// in degrees, lengths in metres, numbers in the shortest form that reads back to the same bits. Throws
/// std::logic_error if a number is not finite.
std::string planes_json(const planes::Arrangement& arrangement, const InputRecord& input,
                        const OptionTable& options);

/// Reads such a file back and checks it: types, ranges, unit normals, that every index exists and that
/// planes, directions and frames agree. Throws InputError naming file and field.
planes::Arrangement read_planes_result(const std::filesystem::path& path);

/// The same from text; `source` names it in messages.
planes::Arrangement parse_planes_result(const std::string& text, const std::string& source);

}  // namespace unseen::report
