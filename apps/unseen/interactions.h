// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "unseen/core/context.h"
#include "unseen/core/options.h"
#include "unseen/interactions/options.h"
#include "unseen/interactions/types.h"
#include "unseen/report/pose_network.h"
#include "unseen/report/stored_run.h"

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

/// The takes of these files; of videos, with a pose network.
std::vector<interactions::Take> read_takes(const std::vector<std::string>& paths, const InteractionsOptions& options, Context& context);

/// Several takes count as a text that lists them; its hash is that of the lines "HASH  PATH".
report::InputRecord record_of(const std::vector<std::string>& paths, const Context& context);

}  // namespace unseen::cli
