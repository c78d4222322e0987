// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string_view>

namespace unseen::cli {

/// Writes a whole file. Throws InputError (path, reason) if that fails, e.g. because the disk is full.
void write_text(const std::filesystem::path& path, std::string_view bytes);

}  // namespace unseen::cli
