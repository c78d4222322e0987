// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace unseen::cli {

/// Writes a whole file. Throws InputError (path, reason) if that fails, e.g. because the disk is full.
void write_text(const std::filesystem::path& path, std::string_view bytes);

/// The bytes of a file. Throws InputError if it cannot be read or has more than `largest` bytes.
std::string read_text(const std::filesystem::path& path, std::size_t largest);

}  // namespace unseen::cli
