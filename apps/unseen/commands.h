// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace unseen::cli {

/// Exit codes of the program.
enum ExitCode { kSolved = 0, kFault = 1, kUsage = 2, kBadInput = 3, kNoSolution = 4, kInterrupted = 130 };

/// A subcommand that can be run once the command line is parsed. `run` returns the exit code; it throws
/// UsageError, InputError or Cancelled.
struct Command {
  CLI::App* app = nullptr;
  std::function<int()> run;
};

/// Each adds its subcommand to `app`; `shell_command` is the whole command line, for the report.
Command add_planes(CLI::App& app, const std::string& shell_command);
Command add_cuboids(CLI::App& app, const std::string& shell_command);
Command add_collision(CLI::App& app, const std::string& shell_command);
Command add_interactions(CLI::App& app, const std::string& shell_command);
Command add_convert(CLI::App& app);
Command add_scenelets_build(CLI::App& scenelets);
Command add_scenelets_info(CLI::App& scenelets);
Command add_stage(CLI::App& app, const std::string& shell_command);
Command add_view(CLI::App& app);
Command add_synth_planes(CLI::App& synth);
Command add_synth_cuboids(CLI::App& synth);
Command add_synth_collision(CLI::App& synth);
Command add_synth_interactions(CLI::App& synth);
Command add_evaluate_planes(CLI::App& evaluate);
Command add_evaluate_cuboids(CLI::App& evaluate);
Command add_evaluate_collision(CLI::App& evaluate);
Command add_evaluate_interactions(CLI::App& evaluate);

}  // namespace unseen::cli
