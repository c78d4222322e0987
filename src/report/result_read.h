// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>

#include "io/json_field.h"
#include "unseen/core/summary.h"

namespace unseen::report {

using io::JsonField;
using io::parse_json;

/// The text of a result.json of at most 1 GiB. Throws InputError.
std::string read_result_text(const std::filesystem::path& path);

/// The summary of a result of any capability; `text` is the file that `json` was parsed from. Throws InputError naming file and field.
Summary read_summary(const JsonField& json, const std::string& text);

/// Four rows of four numbers. Throws InputError unless they are a rigid motion.
RigidTransform read_transform(const JsonField& json);

}  // namespace unseen::report
