// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>

#include "unseen/core/options.h"
#include "unseen/cuboids/types.h"
#include "unseen/report/stored_run.h"

namespace unseen::report {

/// The whole result.json of a cuboids run (docs/formats.md, docs/schema/cuboids.result.schema.json). Lengths are in
/// metres, forces in newtons, numbers in the shortest form that reads back to the same bits. Throws std::logic_error
/// if a number is not finite.
std::string cuboids_json(const cuboids::Completion& completion, const InputRecord& input, const OptionTable& options);

/// Reads such a file back and checks it: types, ranges, rigid axes, that ids are unique and exist, that every contact
/// has a force a point or none. Throws InputError naming file and field.
cuboids::Completion read_cuboids_result(const std::filesystem::path& path);

/// The same from text; `source` names it in messages.
cuboids::Completion parse_cuboids_result(const std::string& text, const std::string& source);

}  // namespace unseen::report
