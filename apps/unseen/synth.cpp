// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "synth.h"

#include <fmt/format.h>

#include "unseen/report/stored_run.h"

namespace unseen::cli {

void publish(Summary& summary, const std::string& made, io::OutputFolder& out, const std::string& folder, const CommonFlags& common, Session& session) {
  summary.warnings = session.context.take_warnings();
  session.context.check();
  session.progress.warn(summary.warnings);
  session.progress.warn(out.commit());
  if (common.json) {
    fmt::print("{}", report::summary_json(summary));
  } else if (!common.quiet) {
    fmt::print("{}\nwritten: {}\n", made, folder);
  }
}

}  // namespace unseen::cli
