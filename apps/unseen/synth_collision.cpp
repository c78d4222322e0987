// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <filesystem>

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

std::string make(const collision::SynthOptions& options, const SynthRun& run) {
  collision::SynthShot scene;
  {
    const Stage stage(run.context, run.summary, "simulate");
    scene = collision::simulate(options);
  }
  if (options.video) {
    const Stage stage(run.context, run.summary, "film");
    film(scene, options, run.out.file(scene.shot.video), run.context);
  }
  {
    const Stage stage(run.context, run.summary, "write");
    write_texts(scene, run.table, run.out);
  }
  run.summary.counts = {{"frames", scene.truth.frames.size()}, {"impacts", scene.truth.impacts.size()}};
  const auto& restitution = scene.truth.restitution;
  return fmt::format("{} frames of {} impacts{}", scene.truth.frames.size(), scene.truth.impacts.size(),
                     restitution ? fmt::format(", restitution {:.3f}", *restitution) : "");
}

}  // namespace

Command add_synth_collision(CLI::App& synth) {
  return add_synth<collision::SynthOptions>(
      synth,
      {"collision", "Film two bodies that collide, with their true motion",
       "the folder for shot.json, truth.json, and shot.mp4 or observations.json",
       "Examples:\n  unseen synth collision -o boxes --seed 7\n"
       "  unseen synth collision -o tracks --scene offcentre --video=false --centroid-noise 0.05"},
      make);
}

}  // namespace unseen::cli
