// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/core/options.h"
#include "unseen/cuboids/options.h"

namespace unseen::cli {

/// Everything that result.json says of how a cuboids run was told to work.
struct CuboidsOptions {
  cuboids::Options method;
  std::string support;  ///< planes of --support, separated by ";"; empty = those of the frame, or found

  /// The table points into this.
  OptionTable table();
};

}  // namespace unseen::cli
