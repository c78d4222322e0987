// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace unseen::io {

/// A TOML file as JSON, for JsonField. `expected` says what it should have been. Throws InputError with the line that is broken.
nlohmann::json read_toml(const std::filesystem::path& path, const std::string& expected);

}  // namespace unseen::io
