// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "session.h"

#include <fmt/format.h>

#include <filesystem>

#include "commands.h"
#include "unseen/io/config.h"
#include "unseen/report/stored_run.h"

namespace unseen::cli {

bool resolve_or_dump(OptionTable& table, const CommonFlags& common, const std::string& section,
                     const GivenOptions& given) {
  resolve(table, common.config_file, section, given);
  if (common.dump_config) fmt::print("{}", io::dump_config(table, section));
  return common.dump_config;
}

Session::Session(const CommonFlags& common) : progress(common.quiet) {
  progress.attach(context);
  context.stop = interrupt.token();
  context.threads = common.threads;
}

int finish(Session& session, io::OutputFolder& out, const Summary& summary, const CommonFlags& common,
           const std::function<void()>& in_words) {
  session.context.check();
  session.progress.warn(summary.warnings);
  session.progress.warn(session.context.take_warnings());
  session.progress.warn(out.commit());
  if (common.json) {
    fmt::print("{}", report::summary_json(summary));
  } else if (!common.quiet) {
    in_words();
  }
  return summary.status == Status::infeasible ? kNoSolution : kSolved;
}

void print_place(const std::string& out, bool no_report) {
  fmt::print("{}: {}\n", no_report ? "result" : "report", (std::filesystem::path(out) / (no_report ? "result.json" : "report.html")).string());
}

}  // namespace unseen::cli
