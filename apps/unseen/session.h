// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <functional>
#include <string>

#include "flags.h"
#include "interrupt.h"
#include "progress.h"
#include "unseen/core/context.h"
#include "unseen/core/summary.h"
#include "unseen/io/output_folder.h"

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

/// The end of a run: its files are put in their place, its warnings said, then its summary as JSON or `in_words`.
/// Returns the exit code.
int finish(Session& session, io::OutputFolder& out, const Summary& summary, const CommonFlags& common,
           const std::function<void()>& in_words);

/// The line that says where the page lies, or the result if there is no page.
void print_place(const std::string& out, bool no_report);

}  // namespace unseen::cli
