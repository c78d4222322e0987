// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "synth.h"
#include "unseen/interactions/synth.h"
#include "unseen/io/output_folder.h"
#include "unseen/report/interactions_truth.h"
#include "unseen/report/planes_result.h"
#include "write_text.h"

namespace unseen::cli {
namespace {

struct SynthInteractionsArguments {
  std::string out;
  CommonFlags common;
  GivenOptions given;
  interactions::SynthOptions options;
};

void write_files(const std::vector<report::SceneFile>& files, const io::OutputFolder& out) {
  for (const report::SceneFile& file : files) {
    const std::filesystem::path path = out.file(file.path);
    std::filesystem::create_directories(path.parent_path());
    write_text(path, file.text);
  }
}

int run(SynthInteractionsArguments& args) {
  OptionTable table = interactions::describe(args.options);
  if (resolve_or_dump(table, args.common, "synth", args.given)) return kSolved;
  require(args.out, "-o DIR");

  Session session(args.common);
  Context& context = session.context;

  io::OutputFolder out(args.out);
  Summary summary;
  interactions::SynthTake synth;
  {
    const Stage stage(context, summary, "simulate");
    synth = interactions::simulate(args.options);
  }
  {
    const Stage stage(context, summary, "write");
    write_files(report::interactions_scene_files(synth, table), out);
  }
  const interactions::Recording& truth = synth.truth;
  summary.counts = {{"frames", truth.people.at(0).size()}, {"people", truth.people.size()}, {"objects", truth.objects.size()},
                    {"interacted", truth.interacted.size()}};
  publish(summary,
          fmt::format("{} frames of {} {}, {} of {} objects used", truth.people.at(0).size(), truth.people.size(), truth.people.size() == 1 ? "person" : "people",
                      truth.interacted.size(), truth.objects.size()),
          out, args.out, args.common, session);
  return kSolved;
}

}  // namespace

Command add_synth_interactions(CLI::App& synth) {
  auto args = std::make_shared<SynthInteractionsArguments>();
  CLI::App* sub = synth.add_subcommand("interactions", "Let people walk, sit, reach and lie among furniture, as joint detections with their truth");
  sub->add_option("-o", args->out, "the folder for take.json, its joints, and the truth in gt/")->type_name("DIR");
  add_flags(*sub, interactions::describe(args->options), args->given);
  add_flags(*sub, args->common);
  sub->footer("Examples:\n  unseen synth interactions -o flat --seed 7\n  unseen synth interactions -o party --people 3 --objects 6 --noise 10");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
