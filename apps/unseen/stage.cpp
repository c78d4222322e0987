// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/stage.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "commands.h"
#include "session.h"
#include "unseen/io/output_folder.h"
#include "unseen/io/sha256.h"
#include "unseen/report/page.h"
#include "unseen/report/stage_files.h"
#include "write_text.h"

namespace unseen::cli {
namespace {

namespace fs = std::filesystem;

struct StageArguments {
  std::vector<std::string> inputs;
  std::string out, shell_command;
  CommonFlags common;
  bool no_report = false;
};

collision::StagePlan plan_of(const std::vector<std::string>& inputs) {
  const bool is_list = fs::path(inputs.front()).extension() == ".toml";
  if (is_list && inputs.size() > 1) throw UsageError("one shot list, or results of unseen collision");
  return is_list ? report::read_stage_list(inputs.front()) : report::stage_side_by_side(inputs);
}

void write_files(const collision::StagedShot& shot, const StageArguments& args, const io::OutputFolder& out, Context& context) {
  const fs::path first = fs::is_directory(args.inputs.front()) ? fs::path(args.inputs.front()) / "result.json" : fs::path(args.inputs.front());
  const report::InputRecord input = {args.inputs.front(), io::sha256(first.string(), context)};
  write_text(out.file("result.json"), report::stage_json(shot, input));
  write_text(out.file("scene.glb"), report::stage_glb(shot));
  write_text(out.file("scene.usda"), report::stage_usda(shot));
  for (std::size_t i = 0; i < shot.actors.size(); ++i)
    if (shot.actors[i].body.shape == collision::Shape::mesh) write_text(out.file(report::actor_file(shot, i)), report::actor_obj(shot, i));
  if (!args.no_report)
    write_text(out.file("report.html"), report::page_of(report::stage_title(input), {report::stage_scene(shot, input, args.shell_command)}));
}

void print_summary(const collision::StagedShot& shot, const StageArguments& args) {
  const auto name = [&](int i) { return i >= 0 ? shot.actors[static_cast<std::size_t>(i)].name : shot.walls[static_cast<std::size_t>(-1 - i)].name; };
  for (const collision::StagedImpact& i : shot.impacts)
    fmt::print("{:.4f} s: {} and {}, restitution {:.3f} of {:.3f}\n", i.time, name(i.between[0]), name(i.between[1]), i.restitution, i.expected);
  print_place(args.out, args.no_report);
}

int run(StageArguments& args) {
  OptionTable table;
  if (resolve_or_dump(table, args.common, "stage", {})) return kSolved;
  if (args.inputs.empty()) throw UsageError("LIST.toml is missing");
  require(args.out, "-o OUT");

  Session session(args.common);
  Context& context = session.context;

  const collision::StagePlan plan = plan_of(args.inputs);
  io::OutputFolder out(args.out);
  const collision::StagedShot shot = collision::stage(plan, context);
  write_files(shot, args, out, context);
  return finish(session, out, shot.summary, args.common, [&] { print_summary(shot, args); });
}

}  // namespace

Command add_stage(CLI::App& app, const std::string& shell_command) {
  auto args = std::make_shared<StageArguments>();
  args->shell_command = shell_command;
  CLI::App* sub = app.add_subcommand("stage", "Combine reconstructed collisions into a new shot");
  sub->add_option("LIST", args->inputs, "a shot list (TOML), or results of unseen collision, which then happen side by side");
  sub->add_option("-o", args->out, "the folder for the new shot; made if it does not exist")->type_name("OUT");
  sub->add_flag("--no-report", args->no_report, "leave out report.html");
  add_flags(*sub, args->common);
  sub->footer("Examples:\n  unseen stage list.toml -o shot\n  unseen stage out1 out2 out3 -o shot");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
