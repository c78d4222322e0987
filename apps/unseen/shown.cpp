// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "shown.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "cuboids.h"
#include "flags.h"
#include "interactions.h"
#include "unseen/collision/options.h"
#include "unseen/collision/overlay.h"
#include "unseen/core/error.h"
#include "unseen/io/describe.h"
#include "unseen/io/points.h"
#include "unseen/io/rgbd.h"
#include "unseen/io/sha256.h"
#include "unseen/planes/options.h"
#include "unseen/report/collision_result.h"
#include "unseen/report/collision_scene.h"
#include "unseen/report/collision_shot.h"
#include "unseen/report/cuboids_result.h"
#include "unseen/report/cuboids_scene.h"
#include "unseen/report/interactions_result.h"
#include "unseen/report/interactions_scene.h"
#include "unseen/report/planes_scene.h"
#include "unseen/report/stage_files.h"
#include "write_text.h"

namespace unseen::cli {
namespace {

/// The points of a result with their planes, from its points.ply; none if it was left out.
report::PointSample read_points(const std::filesystem::path& path, std::size_t plane_count, Context& context) {
  report::PointSample sample;
  if (!std::filesystem::exists(path)) return sample;
  io::ReadOptions read;
  read.label_field = "plane";
  const auto source = io::open_points(path, read);
  const double total = static_cast<double>(source->info().point_count.value_or(1));
  for_each_block(*source, [&](const PointCloud& block, std::size_t first) {
    for (const int plane : block.labels)
      if (plane < -1 || plane >= static_cast<int>(plane_count))
        throw InputError(path.string(), "plane", fmt::format("{}", plane), fmt::format("-1…{}, as result.json has planes", static_cast<int>(plane_count) - 1));
    sample.add(block.positions, block.labels);
    context.progress(static_cast<double>(first + block.size()) / total);
  });
  return sample;
}

/// The command line that made a result, by what its options say that is not the default.
std::string command_of(const report::StoredRun& run, const std::vector<std::string>& inputs, const std::string& out, OptionTable& table) {
  std::vector<std::string> words = {"unseen", run.capability};
  words.insert(words.end(), inputs.begin(), inputs.end());
  words.insert(words.end(), {"-o", out});
  for (const auto& [name, value] : run.options) {
    const std::string before = table.text_of(name);
    table.set(name, value, out);
    if (table.text_of(name) == before) continue;
    words.push_back("--" + name);
    std::replace(words.back().begin(), words.back().end(), '_', '-');
    if (!std::holds_alternative<bool>(value)) words.push_back(table.text_of(name));
    else if (!std::get<bool>(value)) words.back() += "=false";
  }
  return shell_command(words);
}

Shown planes_result(const std::filesystem::path& folder, const report::StoredRun& run, Context& context) {
  const planes::Arrangement a = report::read_planes_result(folder / "result.json");
  planes::Options options;
  io::ReadOptions read;
  OptionTable table = planes::describe(options);
  append(table, io::describe(read));
  const std::string command = command_of(run, {run.input.path}, folder.string(), table);
  const report::PointSample points = read_points(folder / "points.ply", a.planes.size(), context);
  return {report::planes_title(a, run.input), report::planes_scene(a, run.input, table, command, points)};
}

/// Throws InputError if the input of a run has another content by now.
void check_unchanged(const report::InputRecord& input, const std::string& sha256) {
  if (!input.sha256.empty() && sha256 != input.sha256) throw InputError(input.path, "sha256", "another content", "that of the run");
}

/// The frame that a result was made from, if it is still where it was; without it the page has neither depth nor
/// photograph, and says so.
RgbdFrame frame_of(const std::filesystem::path& folder, const report::StoredRun& run, cuboids::Completion& c, Context& context) {
  try {
    const std::filesystem::path path = report::find_input(folder / "result.json", run.input, context);
    check_unchanged(run.input, io::sha256(path, context));
    return io::read_rgbd_frame(path);
  } catch (const InputError& error) {
    c.summary.warnings.push_back(fmt::format("shown without depth and photograph: {}", error.what()));
    context.warn(c.summary.warnings.back());
    return {};
  }
}

Shown cuboids_result(const std::filesystem::path& folder, const report::StoredRun& run, Context& context) {
  cuboids::Completion c = report::read_cuboids_result(folder / "result.json");
  CuboidsOptions options;
  OptionTable table = options.table();
  const std::string command = command_of(run, {run.input.path}, folder.string(), table);
  const RgbdFrame frame = frame_of(folder, run, c, context);
  return {report::cuboids_title(run.input), report::cuboids_scene(c, run.input, table, command, frame)};
}

Shown collision_result(const std::filesystem::path& folder, const report::StoredRun& run, Context& context) {
  collision::Reconstruction r = report::read_collision_result(folder / "result.json");
  collision::Options options;
  OptionTable table = collision::describe(options);
  const std::string command = command_of(run, {run.input.path}, folder.string(), table);
  collision::Shot shot;
  std::vector<collision::OverlayPicture> pictures;
  try {  // without the shot the page has neither shapes nor clip, and says so
    const std::filesystem::path path = report::find_input(folder / "result.json", run.input, context);
    check_unchanged(run.input, io::sha256(path, context));
    shot = report::read_shot(path);
    pictures = collision::write_overlay(shot, r, "", context);
  } catch (const InputError& error) {
    r.summary.warnings.push_back(fmt::format("shown without the clip: {}", error.what()));
    context.warn(r.summary.warnings.back());
  }
  return {report::collision_title(run.input), report::collision_scene(r, run.input, table, command, shot, pictures)};
}

Shown interactions_result(const std::filesystem::path& folder, const report::StoredRun& run, Context& context) {
  interactions::Reconstruction r = report::read_interactions_result(folder / "result.json");
  InteractionsOptions options;
  OptionTable table = options.table();
  const std::vector<std::string> inputs = report::takes_of(run.input);
  const std::string command = command_of(run, inputs, folder.string(), table);
  std::vector<interactions::Take> takes;
  try {  // without the take the page does not show what the detector saw, and says so
    std::vector<std::string> paths = inputs;  // the record of several holds their paths
    if (paths.size() == 1) paths[0] = report::find_input(folder / "result.json", run.input, context).string();
    check_unchanged(run.input, record_of(paths, context).sha256);
    takes = read_takes(paths, options, context);
  } catch (const InputError& error) {
    r.summary.warnings.push_back(fmt::format("shown without the detections: {}", error.what()));
    context.warn(r.summary.warnings.back());
  }
  const std::filesystem::path evidence = folder / "evidence.png";
  const std::string picture = std::filesystem::exists(evidence) ? read_text(evidence, kLargestPicture) : "";
  return {report::interactions_title(run.input), report::interactions_scene(r, run.input, table, command, takes, picture)};
}

Shown stage_result(const std::filesystem::path& folder, const report::StoredRun& run) {
  const collision::StagedShot shot = report::read_stage_result(folder / "result.json");
  std::vector<std::string> words = {"unseen", "stage", run.input.path};
  if (std::filesystem::path(run.input.path).extension() != ".toml")  // results side by side, of which the first is the input
    for (std::size_t i = 1; i < shot.placements.size(); ++i) words.push_back(shot.placements[i].file);
  words.insert(words.end(), {"-o", folder.string()});
  return {report::stage_title(run.input), report::stage_scene(shot, run.input, shell_command(words))};
}

}  // namespace

Shown read_shown(const std::string& out, Context& context) {
  const std::filesystem::path folder(out), file = folder / "result.json";
  if (!std::filesystem::is_directory(folder)) throw InputError(out, "folder", "none", "the folder of a result");
  if (!std::filesystem::exists(file)) throw InputError(file.string(), "file", "none", "the result.json of a run");
  const report::StoredRun run = report::read_stored_run(file);
  if (run.capability == "planes") return planes_result(folder, run, context);
  if (run.capability == "cuboids") return cuboids_result(folder, run, context);
  if (run.capability == "collision") return collision_result(folder, run, context);
  if (run.capability == "interactions") return interactions_result(folder, run, context);
  if (run.capability == "stage") return stage_result(folder, run);
  throw InputError(file.string(), "capability", '"' + run.capability + '"', "\"planes\", \"cuboids\", \"collision\", \"interactions\" or \"stage\"");
}

}  // namespace unseen::cli
