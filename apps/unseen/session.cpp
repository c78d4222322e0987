// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "session.h"

#include <fmt/format.h>

#include "unseen/io/config.h"

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

}  // namespace unseen::cli
