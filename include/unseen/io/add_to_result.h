// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace unseen::io {

/// Writes one more file into a folder that an OutputFolder made, in one step, and enters it in the folder's
/// list of our files: the next run takes it away with the rest of the old result. Throws InputError (path,
/// reason).
void add_to_result(const std::filesystem::path& folder, const std::string& name, std::string_view bytes);

}  // namespace unseen::io
