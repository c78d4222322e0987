// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/collision/evaluate.h"

namespace unseen::report {

/// What `unseen evaluate collision` measured, and against what.
struct CollisionEvaluation {
  std::string result_path, truth_path;
  std::string scene;  ///< of the generator
  collision::Evaluation scores;
};

/// evaluation.json (docs/formats.md). Angles in degrees.
std::string evaluation_json(const CollisionEvaluation& evaluation);

/// The same figures as an aligned table for a terminal.
std::string evaluation_table(const CollisionEvaluation& evaluation);

}  // namespace unseen::report
