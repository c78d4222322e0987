// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/interactions/interactions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <limits>
#include <memory>
#include <sstream>

#include "commands.h"
#include "interactions.h"
#include "session.h"
#include "unseen/core/error.h"
#include "unseen/interactions/evidence_picture.h"
#include "unseen/io/output_folder.h"
#include "unseen/io/sha256.h"
#include "unseen/io/write_png.h"
#include "unseen/report/interactions_files.h"
#include "unseen/report/interactions_result.h"
#include "unseen/report/interactions_scene.h"
#include "unseen/report/interactions_take.h"
#include "unseen/report/page.h"
#include "unseen/report/scenelets_file.h"
#include "write_text.h"

namespace unseen::cli {
namespace {

/// Everything that `unseen interactions` can be told.
struct InteractionsArguments {
  std::vector<std::string> inputs, databases, videos;
  std::string out, shell_command;
  CommonFlags common;
  bool no_report = false;
  GivenOptions given;
  InteractionsOptions options;
};

/// All databases as one; saliency is that among all scenelets.
interactions::Database read_databases(const InteractionsOptions& options, const Context& context) {
  std::vector<interactions::Database> parts;
  if (options.shipped) parts.push_back(report::shipped_database());
  std::istringstream paths(options.scenelets);
  for (std::string path; std::getline(paths, path, ';');)
    if (!path.empty()) parts.push_back(report::read_database(path));
  interactions::Database all = parts.size() == 1 ? std::move(parts.front()) : interactions::join(parts, {}, context);
  if (all.scenelets.empty()) throw InputError(kCommandLine, "--scenelets", "no scenelet", "a database with some, of unseen scenelets build");
  return all;
}

/// Its bytes for the page; empty if there is no map.
std::string write_evidence(const interactions::EvidenceMap& map, const io::OutputFolder& out) {
  const interactions::EvidencePicture picture = interactions::picture_of(map, report::kEvidencePixels);
  if (picture.pixels.empty()) return "";
  const std::filesystem::path path = out.file("evidence.png");
  io::write_color_png(path, picture.width, picture.height, picture.pixels);
  return read_text(path, kLargestPicture);
}

void write_files(const std::vector<interactions::Take>& takes, interactions::Reconstruction& r, const InteractionsArguments& args, const OptionTable& table,
                 const io::OutputFolder& out, Context& context) {
  const report::InputRecord input = record_of(args.inputs, context);
  for (std::size_t p = 0; p < r.people.size(); ++p) {
    const std::string motion = report::interactions_bvh(r.people[p], r.fps);
    if (!motion.empty())
      write_text(out.file(report::bvh_name(p)), motion);
    else if (!r.people[p].frames.empty())
      r.summary.warnings.push_back(fmt::format("{} left out: from frame {} to {} are more than {} frames", report::bvh_name(p),
                                               r.people[p].frames.front().frame, r.people[p].frames.back().frame, report::kMostBvhFrames));
  }
  const std::string evidence = write_evidence(r.evidence, out);
  if (!args.no_report)
    write_text(out.file("report.html"), report::page_of(report::interactions_title(input),
                                                        {report::interactions_scene(r, input, table, args.shell_command, takes, evidence)}));
  write_text(out.file("result.json"), report::interactions_json(r, input, table));
  write_text(out.file("scene.glb"), report::interactions_glb(r));
}

std::string counted(std::size_t count, const char* one, const char* more) {
  return fmt::format("{} {}", count, count == 1 ? one : more);
}

void print_summary(const interactions::Reconstruction& r, const InteractionsArguments& args) {
  for (const interactions::FoundObject& found : r.objects) {
    const Vec3 place = report::upright_box(found.object).center;
    fmt::print("{} at {:.2f}, {:.2f} m: confidence {:.2f}, {}\n", found.object.category, place.x(), place.y(), found.confidence,
               counted(found.windows.size(), "window", "windows"));
  }
  if (r.objects.empty()) fmt::print("no object found\n");
  else fmt::print("confidence is that something is there; places are off by some 20 to 60 cm, and which kind of seat it is cannot be seen\n");
  std::size_t frames = 0;
  for (const interactions::Person& p : r.people) frames += p.frames.size();
  double seconds = 0;
  for (const auto& stage : r.summary.seconds) seconds += stage.second;
  fmt::print("{}, {}, {:.1f} s of work\n", counted(r.people.size(), "person", "people"), counted(frames, "pose", "poses"), seconds);
  print_place(args.out, args.no_report);
}

int run(InteractionsArguments& args) {
  OptionTable table = args.options.table();
  if (!args.databases.empty()) args.given.emplace_back("scenelets", fmt::format("{}", fmt::join(args.databases, ";")));
  if (resolve_or_dump(table, args.common, "interactions", args.given)) return kSolved;
  args.inputs.insert(args.inputs.end(), args.videos.begin(), args.videos.end());
  if (!args.videos.empty() && args.options.pose_model.empty()) throw UsageError("--video needs --pose-model, or give its joints as TAKE.json");
  if (args.inputs.empty()) throw UsageError("TAKE.json is missing");
  require(args.out, "-o OUT");

  Session session(args.common);
  Context& context = session.context;

  const std::vector<interactions::Take> takes = read_takes(args.inputs, args.options, context);
  const interactions::Database database = read_databases(args.options, context);
  io::OutputFolder out(args.out);
  interactions::Reconstruction r = interactions::reconstruct(takes, database, args.options.method, context);
  if (r.summary.status == Status::cancelled) throw Cancelled();
  write_files(takes, r, args, table, out, context);
  return finish(session, out, r.summary, args.common, [&] { print_summary(r, args); });
}

}  // namespace

std::vector<interactions::Take> read_takes(const std::vector<std::string>& paths, const InteractionsOptions& options, Context& context) {
  std::vector<interactions::Take> takes;
  for (const std::string& path : paths)
    takes.push_back(options.pose_model.empty() ? report::read_take(path) : report::detect_poses(options.pose_model, path, options.network, context));
  return takes;
}

report::InputRecord record_of(const std::vector<std::string>& paths, const Context& context) {
  if (paths.size() == 1) return {paths.front(), io::sha256(std::filesystem::path(paths.front()), context)};
  std::string lines;
  for (const std::string& path : paths) lines += fmt::format("{}  {}\n", io::sha256(std::filesystem::path(path), context), path);
  return {fmt::format("{}", fmt::join(paths, report::kBetweenTakes)), io::sha256(std::string_view(lines))};
}

OptionTable InteractionsOptions::table() {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  OptionTable table = interactions::describe(method);
  table.add({"scenelets", &scenelets, "", "databases of scenelets to be used as well, separated by ;", -kInf, kInf, {}});
  table.add({"shipped", &shipped, "", "the database that comes with the program is used", 0, 1, {}});
  table.add({"pose_model",
             &pose_model,
             "",
             "pose network (.onnx, or .caffemodel with its .prototxt beside it) to be run over videos, given instead of takes",
             -kInf,
             kInf,
             {}});
  append(table, report::describe(network));
  return table;
}

Command add_interactions(CLI::App& app, const std::string& shell_command) {
  auto args = std::make_shared<InteractionsArguments>();
  args->shell_command = shell_command;
  CLI::App* sub = app.add_subcommand("interactions", "Find the furniture that people use, and their whole motion, from 2D joints alone");
  sub->add_option("TAKE", args->inputs,
                  "take files (TAKE.json): the camera and the joints that a detector saw; several of one room and camera make one scene");
  sub->add_option("-o", args->out, "the folder for the result; made if it does not exist")->type_name("OUT");
  add_flags(*sub, interactions::describe(args->options.method), args->given);
  sub->add_option("--scenelets", args->databases, "a database of scenelets to be used as well; may be repeated")
      ->type_name("DB")
      ->allow_extra_args(false);
  sub->add_flag_function(
      "--shipped,!--no-shipped", [&given = args->given](std::int64_t n) { given.emplace_back("shipped", n > 0 ? "true" : "false"); },
      "use the database that comes with the program (default), or do without it");
  sub->add_option_function<std::string>(
         "--pose-model", [&given = args->given](const std::string& text) { given.emplace_back("pose_model", text); },
         "run this pose network (.onnx, or .caffemodel with its .prototxt beside it) over videos instead of reading takes")
      ->type_name("FILE");
  sub->add_option("--video", args->videos, "with --pose-model: a video of one person")->type_name("VIDEO")->allow_extra_args(false);
  add_flags(*sub, report::describe(args->options.network), args->given);
  sub->add_flag("--no-report", args->no_report, "leave out report.html");
  add_flags(*sub, args->common);
  sub->footer(
      "Examples:\n  unseen interactions take.json -o out\n  unseen interactions monday.json tuesday.json -o out\n"
      "  unseen interactions take.json -o out --scenelets office.bin --no-shipped\n"
      "  unseen interactions --pose-model body25.caffemodel --video room.mp4 -o out");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
