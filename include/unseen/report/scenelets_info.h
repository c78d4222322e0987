// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/interactions/scenelets.h"

namespace unseen::report {

/// What a database holds: sources with licences, scenelets by category and action, quantiles of saliency. As JSON:
/// {"scenelets", "recordings": [{"name", "room", "licence", "scenelets"}], "categories": {NAME: scenelets with one}, "actions":
/// {NAME: {"scenelets", "saliency": [0, 10, 50, 90 and 100 %]}}}; the action is that of the middle frame.
std::string database_info_json(const interactions::Database& database);

/// The same to read.
std::string database_info_table(const interactions::Database& database);

}  // namespace unseen::report
