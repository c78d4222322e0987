// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "flags.h"
#include "interrupt.h"
#include "progress.h"
#include "unseen/core/context.h"

namespace unseen::cli {

/// Resolves the options of a command; with --dump-config prints them as a config file and returns true, and
/// the command has nothing more to do.
bool resolve_or_dump(OptionTable& table, const CommonFlags& common, const std::string& section,
                     const GivenOptions& given);

/// What every command runs in: Ctrl-C, the progress bar, and a context tied to both.
struct Session {
  explicit Session(const CommonFlags& common);

  Interrupt interrupt;
  Progress progress;
  Context context;
};

}  // namespace unseen::cli
