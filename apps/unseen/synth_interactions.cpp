// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include "commands.h"
#include "synth.h"
#include "unseen/interactions/synth.h"
#include "unseen/io/output_folder.h"
#include "unseen/report/interactions_truth.h"
#include "unseen/report/planes_result.h"
#include "write_text.h"

namespace unseen::cli {
namespace {

void write_files(const std::vector<report::SceneFile>& files, const io::OutputFolder& out, const Context& context) {
  std::size_t written = 0;
  for (const report::SceneFile& file : files) {
    context.progress(static_cast<double>(written++) / static_cast<double>(files.size()));
    const std::filesystem::path path = out.file(file.path);
    std::filesystem::create_directories(path.parent_path());
    write_text(path, file.text);
  }
}

std::string make(const interactions::SynthOptions& options, const SynthRun& run) {
  interactions::SynthTake synth;
  {
    const Stage stage(run.context, run.summary, "simulate");
    synth = interactions::simulate(options, run.context);
  }
  {
    const Stage stage(run.context, run.summary, "write");
    write_files(report::interactions_scene_files(synth, run.table), run.out, run.context);
  }
  const interactions::Recording& truth = synth.truth;
  run.summary.counts = {{"frames", truth.people.at(0).size()}, {"people", truth.people.size()}, {"objects", truth.objects.size()},
       {"interacted", truth.interacted.size()}};
  return fmt::format("{} frames of {} {}, {} of {} objects used", truth.people.at(0).size(), truth.people.size(), truth.people.size() == 1 ? "person" : "people",
         truth.interacted.size(), truth.objects.size());
}

}  // namespace

Command add_synth_interactions(CLI::App& synth) {
  return add_synth<interactions::SynthOptions>(
      synth,
      {"interactions", "Let people walk, sit, reach and lie among furniture, as joint detections with their truth",
       "the folder for take.json, its joints, and the truth in gt/",
       "Examples:\n  unseen synth interactions -o flat --seed 7\n  unseen synth interactions -o party --people 3 --objects 6 --noise 10"},
      make);
}

}  // namespace unseen::cli
