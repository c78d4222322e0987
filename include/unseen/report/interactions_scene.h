// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "unseen/core/options.h"
#include "unseen/interactions/types.h"
#include "unseen/report/stored_run.h"

namespace unseen::report {

/// What the page shows of an interactions result, encoded for page_of (docs/scene.md): the objects as boxes with their category and
/// confidence, the people in motion, the paths of their pelvises, the camera with what its detector saw, the likelihood of an interaction over time
/// with the windows that prove objects, the evidence map on the floor, tables, and how it was made. `command` is the command line
/// that gives the same result. Of no take, or of several (their frames have the same numbers), the detections are left out.
/// `evidence_png`: the bytes of evidence.png, kEvidencePixels a cell of the map; empty = there is none.
std::string interactions_scene(const interactions::Reconstruction& reconstruction, const InputRecord& input, const OptionTable& options,
                               const std::string& command, const std::vector<interactions::Take>& takes, const std::string& evidence_png);

inline constexpr int kEvidencePixels = 6;

/// Stands between the paths of several takes in their record.
inline constexpr std::string_view kBetweenTakes = ", ";

/// The files of a record of takes.
std::vector<std::string> takes_of(const InputRecord& input);

/// "Interactions of lounge.json", or of several takes, separated by commas; of a take.json its folder is named.
std::string interactions_title(const InputRecord& input);

}  // namespace unseen::report
