// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <filesystem>
#include <memory>

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

struct SynthCuboidsArguments {
  std::string out;
  CommonFlags common;
  GivenOptions given;
  cuboids::SynthOptions options;
};

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

int run(SynthCuboidsArguments& args) {
  OptionTable table = cuboids::describe(args.options);
  if (resolve_or_dump(table, args.common, "synth", args.given)) return kSolved;
  require(args.out, "-o DIR");

  Session session(args.common);
  Context& context = session.context;

  io::OutputFolder out(args.out);
  Summary summary;
  cuboids::SynthScene scene;
  {
    const Stage stage(context, summary, "photograph");
    scene = cuboids::make_scene(args.options, context);
  }
  {
    const Stage stage(context, summary, "write");
    for (const cuboids::SynthView& view : scene.views) {
      context.check();
      write_view(out.file(fmt::format("view-{}", view.number)), view, args.options.masks, table);
    }
  }
  const cuboids::Truth& truth = scene.views.front().truth;
  summary.counts = {
      {"views", scene.views.size()}, {"cuboids", truth.cuboids.size()}, {"contacts", truth.contacts.size()}};
  publish(summary, fmt::format("{} views of {} boxes with {} contacts", scene.views.size(), truth.cuboids.size(), truth.contacts.size()), out, args.out, args.common,
          session);
  return kSolved;
}

}  // namespace

Command add_synth_cuboids(CLI::App& synth) {
  auto args = std::make_shared<SynthCuboidsArguments>();
  CLI::App* sub =
      synth.add_subcommand("cuboids", "Make pictures of stacked things or furniture with their true boxes and contacts");
  sub->add_option("-o", args->out, "the folder for view-0 to view-4, each a frame folder with truth.json")
      ->type_name("DIR");
  add_flags(*sub, cuboids::describe(args->options), args->given);
  add_flags(*sub, args->common);
  sub->footer(
      "Examples:\n  unseen synth cuboids -o chair --scene chair-1\n"
      "  unseen synth cuboids -o wall --scene running-bond --boxes 56 --masks");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
