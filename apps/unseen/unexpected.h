// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace unseen::cli {

/// What a command line holds that is not known, and what it may have meant: "--scal is not known (did you mean --scale?)"
std::string unexpected(const CLI::App& app);

}  // namespace unseen::cli
