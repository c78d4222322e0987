// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <vector>

namespace unseen::report {

/// A whole page that shows one scene, or two side by side; it needs no other file and no network.
std::string page_of(const std::string& title, const std::vector<std::string>& scenes);

}  // namespace unseen::report
