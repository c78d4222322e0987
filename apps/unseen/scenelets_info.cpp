// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "session.h"
#include "unseen/report/scenelets_file.h"
#include "unseen/report/scenelets_info.h"

namespace unseen::cli {
namespace {

struct SceneletsInfoArguments {
  std::string database;
  bool json = false;
};

int run(const SceneletsInfoArguments& args) {
  const interactions::Database read = args.database.empty() ? interactions::Database{} : report::read_database(args.database);
  const interactions::Database& database = args.database.empty() ? report::shipped_database() : read;
  fmt::print("{}", args.json ? report::database_info_json(database) : report::database_info_table(database));
  return kSolved;
}

}  // namespace

Command add_scenelets_info(CLI::App& scenelets) {
  auto args = std::make_shared<SceneletsInfoArguments>();
  CLI::App* sub = scenelets.add_subcommand("info", "Say what a database of scenelets holds, and where it comes from");
  sub->add_option("DB", args->database, "the database (default: the one that comes with the program)");
  sub->add_flag("--json", args->json, "as JSON");
  sub->footer("Examples:\n  unseen scenelets info\n  unseen scenelets info people.bin --json");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
