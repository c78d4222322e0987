// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <string>

#include "unseen/core/options.h"
#include "unseen/interactions/options.h"
#include "unseen/report/pose_network.h"

namespace unseen::cli {

inline constexpr std::size_t kLargestPicture = 100'000'000;  ///< bytes of evidence.png

/// Everything that result.json says of how an interactions run was told to work.
struct InteractionsOptions {
  interactions::Options method;
  std::string scenelets;  ///< databases of --scenelets, separated by ";"
  bool shipped = true;    ///< the database that comes with the program counts too
  std::string pose_model;  ///< a pose network; with it the input is a video
  report::PoseNetworkOptions network;

  /// The table points into this.
  OptionTable table();
};

}  // namespace unseen::cli
