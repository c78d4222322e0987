// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "unseen/core/context.h"

namespace unseen::io {

/// SHA-256 in lower-case hexadecimal of a file; of a folder, that of the lines "HASH  NAME" of its files in
/// the order of their names, which is what `LC_ALL=C sha256sum * | sha256sum` gives there (hidden files, folders
/// and files without the permission to read them do not count). Reports progress and can be cancelled. Throws InputError if something else
/// cannot be read.
std::string sha256(const std::filesystem::path& path, const Context& context);

/// The same of bytes.
std::string sha256(std::string_view bytes);

}  // namespace unseen::io
