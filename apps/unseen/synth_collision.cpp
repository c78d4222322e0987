// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "commands.h"
#include "synth.h"
#include "unseen/collision/synth.h"
#include "unseen/io/output_folder.h"
#include "unseen/io/write_video.h"
#include "unseen/report/collision_truth.h"
#include "unseen/report/planes_result.h"
#include "write_text.h"

namespace unseen::cli {
namespace {

struct SynthCollisionArguments {
  std::string out;
  CommonFlags common;
  GivenOptions given;
  collision::SynthOptions options;
};

void film(const collision::SynthShot& scene, const collision::SynthOptions& options, const std::filesystem::path& path, Context& context) {
  io::VideoFile video(path, options.width, options.height, options.fps);
  collision::render(scene, options, context, [&](int, const std::vector<std::uint8_t>& bgr) { video.add(bgr); });
  video.close();
}

void write_texts(const collision::SynthShot& scene, const OptionTable& table, const io::OutputFolder& out) {
  write_text(out.file("shot.json"), report::collision_shot_json(scene.shot));
  write_text(out.file("truth.json"), report::collision_truth_json(scene.truth, table));
  if (scene.shot.video.empty()) write_text(out.file("observations.json"), report::collision_sightings_json(scene.shot));
  for (const collision::Body& body : scene.shot.bodies)
    if (body.shape == collision::Shape::mesh) write_text(out.file(body.name + ".obj"), report::body_obj(body));
}

int run(SynthCollisionArguments& args) {
  OptionTable table = collision::describe(args.options);
  if (resolve_or_dump(table, args.common, "synth", args.given)) return kSolved;
  require(args.out, "-o DIR");

  Session session(args.common);
  Context& context = session.context;

  io::OutputFolder out(args.out);
  Summary summary;
  collision::SynthShot scene;
  {
    const Stage stage(context, summary, "simulate");
    scene = collision::simulate(args.options);
  }
  if (args.options.video) {
    const Stage stage(context, summary, "film");
    film(scene, args.options, out.file(scene.shot.video), context);
  }
  {
    const Stage stage(context, summary, "write");
    write_texts(scene, table, out);
  }
  summary.counts = {{"frames", scene.truth.frames.size()}, {"impacts", scene.truth.impacts.size()}};
  const auto& restitution = scene.truth.restitution;
  publish(summary,
          fmt::format("{} frames of {} impacts{}", scene.truth.frames.size(), scene.truth.impacts.size(),
                      restitution ? fmt::format(", restitution {:.3f}", *restitution) : ""),
          out, args.out, args.common, session);
  return kSolved;
}

}  // namespace

Command add_synth_collision(CLI::App& synth) {
  auto args = std::make_shared<SynthCollisionArguments>();
  CLI::App* sub = synth.add_subcommand("collision", "Film two bodies that collide, with their true motion");
  sub->add_option("-o", args->out, "the folder for shot.json, truth.json, and shot.mp4 or observations.json")->type_name("DIR");
  add_flags(*sub, collision::describe(args->options), args->given);
  add_flags(*sub, args->common);
  sub->footer(
      "Examples:\n  unseen synth collision -o boxes --seed 7\n"
      "  unseen synth collision -o tracks --scene offcentre --video=false --centroid-noise 0.05");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
