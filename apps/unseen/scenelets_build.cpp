// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "session.h"
#include "unseen/interactions/scenelets.h"
#include "unseen/interactions/synth.h"
#include "unseen/io/output_folder.h"
#include "unseen/report/interactions_recording.h"
#include "unseen/report/planes_result.h"
#include "unseen/report/scenelets_file.h"
#include "write_text.h"

namespace unseen::cli {
namespace {

struct SceneletsBuildArguments {
  std::vector<std::string> folders, databases;
  std::string out;
  int synth = 0, seed = 1;
  CommonFlags common;
  GivenOptions given;
  interactions::SceneletOptions options;

  OptionTable table() {
    OptionTable table = interactions::describe(options);
    table.add({"synth", &synth, "", "so many recordings of the generator are added", 0, 10000, {}});
    table.add({"seed", &seed, "", "of the first of them", 0, 1000000000, {}});
    return table;
  }
};

/// A recording of the generator; rooms and casts vary with the seed.
interactions::Recording synthetic(int seed) {
  interactions::SynthOptions options;
  options.seed = seed;
  options.people = seed % 4 == 0 ? 2 : 1;
  options.objects = 3 + seed % 4;
  options.lifted = false;
  return interactions::simulate(options).truth;
}

std::vector<interactions::Recording> read_recordings(const SceneletsBuildArguments& args, Context& context) {
  std::vector<interactions::Recording> recordings;
  const double count = static_cast<double>(args.folders.size()) + args.synth;
  for (const std::string& folder : args.folders) {
    context.progress(static_cast<double>(recordings.size()) / count);
    recordings.push_back(report::read_recording(folder));
  }
  for (int i = 0; i < args.synth; ++i) {
    context.progress(static_cast<double>(recordings.size()) / count);
    recordings.push_back(synthetic(args.seed + i));
  }
  return recordings;
}

int run(SceneletsBuildArguments& args) {
  OptionTable table = args.table();
  if (resolve_or_dump(table, args.common, "scenelets", args.given)) return kSolved;
  if (args.folders.empty() && args.databases.empty() && args.synth == 0) throw UsageError("FOLDER, --add DB or --synth N is missing");
  require(args.out, "-o DB");

  Session session(args.common);
  Context& context = session.context;
  Summary summary;
  io::AtomicFile out(args.out);
  std::vector<interactions::Database> parts;
  for (const std::string& path : args.databases) parts.push_back(report::read_database(path));
  std::vector<interactions::Recording> recordings;
  {
    const Stage stage(context, summary, "read");
    recordings = read_recordings(args, context);
  }
  {
    const Stage stage(context, summary, "build");
    parts.push_back(interactions::build_database(recordings, args.options, context));
  }
  const interactions::Database database = parts.size() == 1 ? std::move(parts.front()) : interactions::join(parts, args.options, context);
  context.check();
  const std::string bytes = report::database_bytes(database);
  write_text(out.path(), bytes);
  out.commit();
  summary.counts = {{"recordings", database.recordings.size()}, {"scenelets", database.scenelets.size()}, {"bytes", bytes.size()}};
  summary.warnings = context.take_warnings();
  session.progress.clear();
  session.progress.warn(summary.warnings);
  if (args.common.json) {
    fmt::print("{}", report::summary_json(summary));
  } else if (!args.common.quiet) {
    fmt::print("{} scenelets of {} recordings\nwritten: {} ({:.0f} kB)\n", database.scenelets.size(), database.recordings.size(), args.out,
               static_cast<double>(bytes.size()) / 1000);
  }
  return kSolved;
}

}  // namespace

Command add_scenelets_build(CLI::App& scenelets) {
  auto args = std::make_shared<SceneletsBuildArguments>();
  CLI::App* sub = scenelets.add_subcommand("build", "Cut recordings of people among furniture into a database of scenelets");
  sub->add_option("FOLDER", args->folders, "scene folders with a gt/, of i3DB or of unseen synth interactions");
  sub->add_option("--add", args->databases, "databases whose scenelets are added")->type_name("DB");
  sub->add_option("-o", args->out, "the file to write")->type_name("DB");
  add_flags(*sub, args->table(), args->given);
  add_flags(*sub, args->common);
  sub->footer(
      "Examples:\n  unseen scenelets build office lobby -o people.bin\n  unseen scenelets build kitchen --add people.bin -o more.bin\n"
      "  unseen scenelets build --synth 40 -o synthetic.bin");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
