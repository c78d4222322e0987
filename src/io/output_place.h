// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace unseen::io {

/// The absolute path behind symbolic links, without a slash at its end; the last parts need not exist.
std::filesystem::path resolved(const std::filesystem::path& path);
/// A hidden name beside `target` that nothing else uses.
std::filesystem::path temporary_beside(const std::filesystem::path& target);
/// The result that an earlier run wrote into a folder, relative to it; nothing if it wrote something to be read, as unseen synth does.
std::set<std::string> result_files(const std::filesystem::path& folder);

}  // namespace unseen::io
