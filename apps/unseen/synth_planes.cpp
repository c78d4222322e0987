// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>


#include "commands.h"
#include "synth.h"
#include "unseen/io/output_folder.h"
#include "unseen/io/write_points.h"
#include "unseen/planes/synth.h"
#include "unseen/report/planes_result.h"
#include "unseen/report/synth_truth.h"
#include "write_text.h"

namespace unseen::cli {
namespace {

std::string make(const planes::SynthOptions& options, const SynthRun& run) {
  planes::SynthScene scene;
  {
    const Stage stage(run.context, run.summary, "scan");
    scene = planes::make_scene(options, run.context);
  }
  {
    const Stage stage(run.context, run.summary, "write");
    CloudSource source(scene.cloud);
    io::write_points(run.out.file("cloud.ply"), source, run.context);
    write_text(run.out.file("truth.obj"), report::labelled_obj(scene.truth));
    write_text(run.out.file("truth.json"), report::synth_truth_json(scene, run.table));
  }
  run.summary.counts = {
      {"points", scene.cloud.size()}, {"planes", scene.planes.size()}, {"frames", scene.axes.size()}};
  return fmt::format("{} points on {} planes in {} orientation frames", scene.cloud.size(), scene.planes.size(), scene.axes.size());
}

}  // namespace

Command add_synth_planes(CLI::App& synth) {
  return add_synth<planes::SynthOptions>(
      synth,
      {"planes", "Make a scanned scene with its true planes, labels and mesh",
       "the folder for cloud.ply, truth.obj and truth.json",
       "Examples:\n  unseen synth planes -o room --seed 7\n  unseen synth planes -o stairs --scene stairs "
       "--noise 0.01"},
      make);
}

}  // namespace unseen::cli
