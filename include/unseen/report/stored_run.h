// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "unseen/core/context.h"
#include "unseen/core/options.h"
#include "unseen/core/summary.h"

namespace unseen::report {

/// Which input a result was made from.
struct InputRecord {
  std::string path;    ///< as the caller gave it
  std::string sha256;  ///< of its bytes, 64 hexadecimal digits; empty if it was never a file
};

/// How a result was made, as its result.json says.
struct StoredRun {
  std::string capability;
  InputRecord input;
  std::vector<std::pair<std::string, OptionInput>> options;  ///< those that have a value
};

/// Reads that part of a result.json of any capability. Throws InputError naming file and field.
StoredRun read_stored_run(const std::filesystem::path& path);

/// Where the input of a result lies: as the caller gave it, or as seen from one of the folders above the result, or beside it. The first with the
/// recorded content, or else the first that is there; the path as it was given if there is none.
std::filesystem::path find_input(const std::filesystem::path& result, const InputRecord& input, const Context& context);

/// A count of the summary by its name, 0 if there is none.
std::size_t count_of(const Summary& summary, std::string_view name);

/// The summary as one JSON object, as it stands in result.json: status, seconds, energy, counts, warnings.
std::string summary_json(const Summary& summary);

}  // namespace unseen::report
