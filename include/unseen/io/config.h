// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "unseen/core/options.h"

namespace unseen::io {

/// Sets options from a TOML file: its keys outside any table, then those of the table `section` (e.g.
/// "planes"). Tables named in `other_sections` belong to others and are passed over. Throws InputError (file,
/// option, found, expected) for broken TOML, an unknown key or table (lists the known ones), a wrong type or
/// value.
void apply_config(OptionTable& table, const std::filesystem::path& path, const std::string& section,
                  const std::vector<std::string>& other_sections = {"planes", "cuboids", "collision",
                                                                    "interactions"});

/// The current values as TOML that apply_config() reads back exactly, each with its help, unit and range;
/// options that are not set are commented out.
std::string dump_config(const OptionTable& table, const std::string& section);

}  // namespace unseen::io
