// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "unseen/core/context.h"
#include "unseen/core/rgbd_frame.h"
#include "unseen/cuboids/options.h"
#include "unseen/cuboids/types.h"
#include "unseen/io/output_folder.h"

namespace unseen::cli {

/// What is to be made of completed cuboids; empty = nothing.
struct ApplicationFlags {
  std::string complete;     ///< MODEL: a good scan of the same kind of object
  std::string retrieve;     ///< DIR: models to choose from
  std::vector<int> object;  ///< ids of the cuboids to find a model for; empty = the largest object
  std::string edit;         ///< EDITS.json
};
void add_flags(CLI::App& app, ApplicationFlags& flags);

/// Writes completed.ply and completed.json, retrieved.ply and retrieved.json, edited.png, as far as they are asked for, with the fill and seed that
/// the scene was made with, and the noise if it was given (a Kinect's otherwise).
/// Returns a line each that says what came of it. Throws InputError for files that cannot be used.
std::vector<std::string> run_applications(const ApplicationFlags& flags, const RgbdFrame& frame, const cuboids::Options& method,
                                          const cuboids::Completion& scene, io::OutputFolder& out, Context& context);

}  // namespace unseen::cli
