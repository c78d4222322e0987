// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/cuboids/evaluate.h"

namespace unseen::report {

/// What `unseen evaluate cuboids` measured, and against what.
struct CuboidsEvaluation {
  std::string result_path, truth_path;  ///< the latter empty without a truth
  std::string family;  ///< of the generator, or the name of the frame
  cuboids::Evaluation scores;
};

/// evaluation.json (docs/formats.md). Shares in 0…1, angles in degrees.
std::string evaluation_json(const CuboidsEvaluation& evaluation);

/// The same figures as an aligned table for a terminal.
std::string evaluation_table(const CuboidsEvaluation& evaluation);

}  // namespace unseen::report
