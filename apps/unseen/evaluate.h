// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "session.h"
#include "unseen/io/add_to_result.h"

// What the commands that measure a result have in common.
namespace unseen::cli {

/// The result.json that a folder holds, or the file itself.
inline std::filesystem::path result_file(const std::filesystem::path& named) {
  return std::filesystem::is_directory(named) ? named / "result.json" : named;
}

/// Writes evaluation.json into the folder of a result, unless that is empty, and prints the scores. Throws Cancelled.
template <class Evaluation>
void publish(const Evaluation& evaluation, const std::filesystem::path& folder, const CommonFlags& common, Session& session) {
  session.context.check();
  const std::string json = evaluation_json(evaluation);
  if (!folder.empty()) io::add_to_result(folder, "evaluation.json", json);
  session.progress.clear();
  session.progress.warn(session.context.take_warnings());
  if (common.json) {
    fmt::print("{}", json);
  } else if (!common.quiet) {
    fmt::print("{}", evaluation_table(evaluation));
  }
}

}  // namespace unseen::cli
