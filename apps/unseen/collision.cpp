// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/collision.h"

#include <fmt/format.h>

#include <memory>

#include "commands.h"
#include "session.h"
#include "unseen/collision/overlay.h"
#include "unseen/core/error.h"
#include "unseen/io/output_folder.h"
#include "unseen/io/sha256.h"
#include "unseen/report/collision_files.h"
#include "unseen/report/collision_result.h"
#include "unseen/report/collision_scene.h"
#include "unseen/report/collision_shot.h"
#include "unseen/report/page.h"
#include "write_text.h"

namespace unseen::cli {
namespace {

/// Everything that `unseen collision` can be told.
struct CollisionArguments {
  std::string input, out, shell_command;
  CommonFlags common;
  bool no_report = false, no_overlay = false;
  GivenOptions given;
  collision::Options options;
};

void print_impacts(const collision::Reconstruction& r) {
  if (r.impacts.empty()) {
    fmt::print("no collision found\n");
    return;
  }
  const collision::Impact& first = r.impacts.front();
  if (!r.fits)
    fmt::print("the model does not explain the impact{} looked for at frame {:.2f} ({:.4f} s)\n", r.impacts.size() > 1 ? "s; the first was" : "", first.frame, first.time);
  else if (r.impacts.size() == 1)
    fmt::print("one impact, at frame {:.2f} ({:.4f} s)\n", first.frame, first.time);
  else
    fmt::print("{} impacts, the first at frame {:.2f} ({:.4f} s)\n", r.impacts.size(), first.frame, first.time);
}

void print_summary(const collision::Reconstruction& r, const CollisionArguments& args) {
  print_impacts(r);
  fmt::print("restitution: {}\n", r.restitution ? report::estimate_text(*r.restitution) : "no confident value");
  if (r.fixed.empty() && r.bodies.size() == 2)
    fmt::print("mass of {} to {}: {}\n", r.bodies[1].name, r.bodies[0].name, r.mass_ratio ? report::estimate_text(*r.mass_ratio) : "no confident value");
  if (r.restitution)
    fmt::print("kinetic energy: {:.0f} % kept\n", 100.0 * r.energy_after / r.energy_before);
  if (!r.frames.empty())
    fmt::print("{}: {:.2f} px in the frames used{}\n", r.fits ? "the model fits" : "the model does not fit", r.reprojection_rms,
               r.held_out_rms > 0 ? fmt::format(", {:.2f} px in those held out", r.held_out_rms) : "");
  for (const collision::Alternative& a : r.ambiguous)
    fmt::print("ambiguous: {} explains it too (restitution {:.3f}{})\n", a.what, a.restitution, r.fixed.empty() ? fmt::format(", mass ratio {:.3f}", a.mass_ratio) : "");
  for (const std::string& remark : r.observability) fmt::print("{}\n", remark);
  print_place(args.out, args.no_report);
}

void write_files(const collision::Shot& shot, collision::Reconstruction& r, const CollisionArguments& args, const OptionTable& table,
                 const io::OutputFolder& out, Context& context) {
  const report::InputRecord input = {args.input, io::sha256(args.input, context)};
  std::vector<collision::OverlayPicture> pictures;
  if (!args.no_overlay) {
    const Stage stage(context, r.summary, "overlay");
    pictures = collision::write_overlay(shot, r, out.file("overlay.mp4"), context);
  }
  if (!args.no_report)
    write_text(out.file("report.html"),
               report::page_of(report::collision_title(input), {report::collision_scene(r, input, table, args.shell_command, shot, pictures)}));
  write_text(out.file("result.json"), report::collision_json(r, input, table));
  if (!r.frames.empty()) write_text(out.file("scene.glb"), report::collision_glb(shot, r));
}

int run(CollisionArguments& args) {
  OptionTable table = collision::describe(args.options);
  if (resolve_or_dump(table, args.common, "collision", args.given)) return kSolved;
  require(args.input, "SHOT.json");
  require(args.out, "-o OUT");

  Session session(args.common);
  Context& context = session.context;

  const collision::Shot shot = report::read_shot(args.input);
  io::OutputFolder out(args.out);
  collision::Reconstruction r = collision::reconstruct(shot, args.options, context);
  if (r.summary.status == Status::cancelled) throw Cancelled();
  write_files(shot, r, args, table, out, context);
  return finish(session, out, r.summary, args.common, [&] { print_summary(r, args); });
}

}  // namespace

Command add_collision(CLI::App& app, const std::string& shell_command) {
  auto args = std::make_shared<CollisionArguments>();
  args->shell_command = shell_command;
  CLI::App* sub = app.add_subcommand("collision", "Reconstruct two bodies that collide once, or one that bounces, from a video");
  sub->add_option("SHOT", args->input, "a shot file (SHOT.json): the video, the camera, the two bodies");
  sub->add_option("-o", args->out, "the folder for the result; made if it does not exist")->type_name("OUT");
  add_flags(*sub, collision::describe(args->options), args->given);
  sub->add_flag("--no-overlay", args->no_overlay, "leave out overlay.mp4 and the clip in the page");
  sub->add_flag("--no-report", args->no_report, "leave out report.html");
  add_flags(*sub, args->common);
  sub->footer(
      "Examples:\n  unseen collision shot.json -o out\n  unseen collision bounce.json -o out --shared-restitution\n"
      "  unseen collision shot.json -o out --drag on --starts 64");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
