// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/interactions/evaluate.h"

namespace unseen::report {

/// What `unseen evaluate interactions` measured, and against what.
struct InteractionsEvaluation {
  std::string result_path, truth_path;
  std::string scene;  ///< name of the truth
  interactions::Evaluation scores;
};

/// evaluation.json (docs/formats.md). Lengths in metres, shares in 0…1.
std::string evaluation_json(const InteractionsEvaluation& evaluation);

/// The same figures as an aligned table for a terminal, lengths in centimetres.
std::string evaluation_table(const InteractionsEvaluation& evaluation);

}  // namespace unseen::report
