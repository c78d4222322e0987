// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <string>
#include <vector>

#include "collision/solve/best_fit.h"

namespace unseen::collision {

/// Whether flights and impact explain what was seen.
struct ModelCheck {
  bool fits = false;
  double held_out_chi2 = 0;   ///< mean square of held-out residuals over the noise that the tracks have by themselves
  double held_out_rms = 0;    ///< px
  double used_rms = 0;        ///< px
  std::vector<char> held_out;  ///< by point of the problem
  std::vector<char> outlier;   ///< by point: far from where the flights lead, as few are
  std::vector<std::string> reasons;  ///< why it does not fit, in words
};

using BodyNames = std::array<std::string, 2>;

/// Solves once more without every `every`th frame and predicts those; looks for a trend along each flight. `noise` (px): of the tracks by themselves.
/// The fit's covariance must be there: energy may grow within its noise.
ModelCheck check_model(const Solution& solution, int every, double noise, const BodyNames& names = {"the first body", "the second body"});

}  // namespace unseen::collision
