// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <CLI/CLI.hpp>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "unseen/core/options.h"

namespace unseen::cli {

/// The command line itself is wrong: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

inline constexpr const char* kCommandLine = "command line";  ///< the source in messages about flags

/// What the user gave on the command line, in that order: option name and text.
using GivenOptions = std::vector<std::pair<std::string, std::string>>;

/// Makes a flag of every option of the table; what the user gives is collected in `given`, which must live
/// as long as the app.
void add_flags(CLI::App& app, const OptionTable& table, GivenOptions& given);

/// Appends the options of `more` to `table`.
void append(OptionTable& table, const OptionTable& more);

/// Sets what the config file says (unless its name is empty), outside any table or in the table `section`,
/// then what the command line says: the latter wins.
void resolve(OptionTable& table, const std::string& config_file, const std::string& section,
             const GivenOptions& given);

/// Flags that all commands share.
struct CommonFlags {
  std::string config_file;
  bool dump_config = false;
  int threads = 0;
  bool quiet = false;
  bool json = false;
};
void add_flags(CLI::App& app, CommonFlags& flags);

/// A positional or an option that only counts once --dump-config is out of the way.
const std::string& require(const std::string& value, const std::string& what);

/// A command line as one can paste it into a shell; the first word becomes "unseen".
std::string shell_command(const std::vector<std::string>& words);

}  // namespace unseen::cli
