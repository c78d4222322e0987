// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <filesystem>

#include "commands.h"
#include "synth.h"
#include "unseen/cuboids/synth.h"
#include "unseen/io/output_folder.h"
#include "unseen/io/write_png.h"
#include "unseen/report/cuboids_truth.h"
#include "unseen/report/planes_result.h"
#include "write_text.h"

namespace unseen::cli {
namespace {

void write_view(const std::filesystem::path& folder, const cuboids::SynthView& view, bool masks,
                const OptionTable& table) {
  const int width = view.camera.width, height = view.camera.height;
  std::filesystem::create_directory(folder);
  write_text(folder / "frame.json", report::synth_frame_json(view, masks));
  write_text(folder / "truth.json", report::cuboids_truth_json(view, table));
  io::write_grey_png(folder / "depth.png", width, height, report::synth_depth_pixels(view));
  io::write_color_png(folder / "color.png", width, height, view.color);
  io::write_grey_png(folder / "masks.png", width, height, view.masks);
}

std::string make(const cuboids::SynthOptions& options, const SynthRun& run) {
  cuboids::SynthScene scene;
  {
    const Stage stage(run.context, run.summary, "photograph");
    scene = cuboids::make_scene(options, run.context);
  }
  {
    const Stage stage(run.context, run.summary, "write");
    for (const cuboids::SynthView& view : scene.views) {
      run.context.check();
      write_view(run.out.file(fmt::format("view-{}", view.number)), view, options.masks, run.table);
    }
  }
  const cuboids::Truth& truth = scene.views.front().truth;
  run.summary.counts = {
      {"views", scene.views.size()}, {"cuboids", truth.cuboids.size()}, {"contacts", truth.contacts.size()}};
  return fmt::format("{} views of {} boxes with {} contacts", scene.views.size(), truth.cuboids.size(), truth.contacts.size());
}

}  // namespace

Command add_synth_cuboids(CLI::App& synth) {
  return add_synth<cuboids::SynthOptions>(
      synth,
      {"cuboids", "Make pictures of stacked things or furniture with their true boxes and contacts",
       "the folder for view-0 to view-4, each a frame folder with truth.json",
       "Examples:\n  unseen synth cuboids -o chair --scene chair-1\n"
       "  unseen synth cuboids -o wall --scene running-bond --boxes 56 --masks"},
      make);
}

}  // namespace unseen::cli
