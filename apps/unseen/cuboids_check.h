// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <vector>

#include "flags.h"

namespace unseen::cli {

/// What `unseen cuboids --check` is told.
struct CheckArguments {
  std::string assembly;               ///< the file; empty = no check was asked for
  std::vector<std::string> supports;  ///< names of blocks; empty = those that the file names
  std::string up;                     ///< "x,y,z"; empty = z
  double friction = 0.7;
  double density = 300.0;             ///< kg/m³, of blocks of which the file names none
};

/// Says whether an assembly stands. Exit code 0 if it does, 4 if not.
int run_check(const CheckArguments& args, const CommonFlags& common);

}  // namespace unseen::cli
