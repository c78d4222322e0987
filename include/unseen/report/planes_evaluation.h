// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <string>

#include "unseen/planes/evaluate.h"

namespace unseen::report {

/// What `unseen evaluate planes` measured, and against what.
struct PlanesEvaluation {
  std::string result_path, truth_path;
  std::string truth_kind;  ///< "mesh", "result" or "labels"
  double scale = 0;        ///< ρ, m, that the figures were made with
  planes::RelationScore relations;
  std::optional<planes::TruthScore> truth;   ///< against a mesh or another result
  std::optional<planes::LabelScore> labels;  ///< against a labelled cloud
};

/// evaluation.json (docs/formats.md). Angles in degrees.
std::string evaluation_json(const PlanesEvaluation& evaluation);

/// The same figures as an aligned table for a terminal.
std::string evaluation_table(const PlanesEvaluation& evaluation);

}  // namespace unseen::report
