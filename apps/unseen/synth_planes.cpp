// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <memory>

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

struct SynthPlanesArguments {
  std::string out;
  CommonFlags common;
  GivenOptions given;
  planes::SynthOptions options;
};

int run(SynthPlanesArguments& args) {
  OptionTable table = planes::describe(args.options);
  if (resolve_or_dump(table, args.common, "synth", args.given)) return kSolved;
  require(args.out, "-o DIR");

  Session session(args.common);
  Context& context = session.context;

  io::OutputFolder out(args.out);
  Summary summary;
  planes::SynthScene scene;
  {
    const Stage stage(context, summary, "scan");
    scene = planes::make_scene(args.options, context);
  }
  {
    const Stage stage(context, summary, "write");
    CloudSource source(scene.cloud);
    io::write_points(out.file("cloud.ply"), source, context);
    write_text(out.file("truth.obj"), report::labelled_obj(scene.truth));
    write_text(out.file("truth.json"), report::synth_truth_json(scene, table));
  }
  summary.counts = {
      {"points", scene.cloud.size()}, {"planes", scene.planes.size()}, {"frames", scene.axes.size()}};
  publish(summary, fmt::format("{} points on {} planes in {} orientation frames", scene.cloud.size(), scene.planes.size(), scene.axes.size()), out, args.out,
          args.common, session);
  return kSolved;
}

}  // namespace

Command add_synth_planes(CLI::App& synth) {
  auto args = std::make_shared<SynthPlanesArguments>();
  CLI::App* sub =
      synth.add_subcommand("planes", "Make a scanned scene with its true planes, labels and mesh");
  sub->add_option("-o", args->out, "the folder for cloud.ply, truth.obj and truth.json")->type_name("DIR");
  add_flags(*sub, planes::describe(args->options), args->given);
  add_flags(*sub, args->common);
  sub->footer(
      "Examples:\n  unseen synth planes -o room --seed 7\n  unseen synth planes -o stairs --scene stairs "
      "--noise 0.01");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
