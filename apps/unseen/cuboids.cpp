// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "commands.h"
#include "cuboids_applications.h"
#include "cuboids_check.h"
#include "session.h"
#include "unseen/core/error.h"
#include "unseen/cuboids/cuboids.h"
#include "unseen/io/output_folder.h"
#include "unseen/io/rgbd.h"
#include "unseen/io/sha256.h"
#include "unseen/report/cuboids_files.h"
#include "unseen/report/cuboids_result.h"
#include "unseen/report/cuboids_scene.h"
#include "unseen/report/page.h"
#include "write_text.h"

namespace unseen::cli {
namespace {

/// Everything that `unseen cuboids` can be told.
struct CuboidsArguments {
  std::string input, out, shell_command;
  std::vector<std::string> supports;  ///< planes, or with --check the names of blocks
  CheckArguments check;
  CommonFlags common;
  bool no_report = false;
  GivenOptions given;
  CuboidsOptions options;
  ApplicationFlags applications;
};

std::string plural(std::size_t count, const std::string& one, const std::string& many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

void print_summary(const cuboids::Completion& c, const CuboidsArguments& args) {
  const auto completed = std::count_if(c.cuboids.begin(), c.cuboids.end(), [](const cuboids::Cuboid& cuboid) { return cuboid.is_completed(); });
  if (c.cuboids.empty()) {
    fmt::print("no box found\n");
  } else {
    std::vector<std::string> supports;
    for (const cuboids::Support& s : c.supports)
      supports.emplace_back(cuboids::kSupportKinds[static_cast<int>(s.kind)]);
    fmt::print("{} ({}), {} completed into the hidden part: {}\n", plural(c.cuboids.size(), "box", "boxes"),
               fmt::join(supports, ", "), completed, report::volume_text(c.extended_volume));
    fmt::print("{}, {} fixed{}\n", plural(c.contacts.size(), "contact", "contacts"), c.fixed_contacts,
               c.search.optimal ? " (proven to be the fewest)" : "");
    const std::string doubt = c.may_move.empty() ? "" : fmt::format(", {} doubtfully", plural(c.may_move.size(), "box", "boxes"));
    if (c.stability.stable)
      fmt::print("{}{}: bears a sideways push of {:.2f} g, needs a friction of {:.2f} (has {:.4g})\n",
                 c.unsupported.empty() ? "stands" : "what is supported stands", doubt, c.stability.margin, c.stability.friction_needed,
                 args.options.method.friction);
    else if (c.unsupported.size() + c.held_outside.size() < c.cuboids.size())
      fmt::print("does not stand: residual {:.2g} (limit {:.2g})\n", c.stability.residual,
                 args.options.method.stable_residual);
    if (!c.unsupported.empty())
      fmt::print("nothing can support {}: {}\n", plural(c.unsupported.size(), "box", "boxes"),
                 fmt::join(c.unsupported, ", "));
    if (!c.held_outside.empty())
      fmt::print("only something outside the picture, which cuts them off, can hold {}: {}\n", plural(c.held_outside.size(), "box", "boxes"),
                 fmt::join(c.held_outside, ", "));
  }
  print_place(args.out, args.no_report);
}

void write_files(const cuboids::Completion& c, const RgbdFrame& frame, CuboidsArguments& args, const OptionTable& table,
                 const io::OutputFolder& out, const Context& context) {
  const report::InputRecord input = {args.input, io::sha256(args.input, context)};
  if (!args.no_report)
    write_text(out.file("report.html"),
               report::page_of(report::cuboids_title(input),
                               {report::cuboids_scene(c, input, table, args.shell_command, frame)}));
  write_text(out.file("result.json"), report::cuboids_json(c, input, table));
  if (c.summary.status == Status::infeasible) return;
  write_text(out.file("scene.glb"), report::cuboids_glb(c, frame));
  write_text(out.file("scene.xml"), report::cuboids_mjcf(c, args.options.method.friction));
  write_text(out.file("scene.urdf"), report::cuboids_urdf(c, args.options.method.friction));
}

int run(CuboidsArguments& args) {
  OptionTable table = args.options.table();
  const bool check = !args.check.assembly.empty();
  if (!args.supports.empty() && !check)
    args.given.emplace_back("support", fmt::format("{}", fmt::join(args.supports, ";")));
  if (resolve_or_dump(table, args.common, "cuboids", args.given)) return kSolved;
  if (check) {
    if (!args.input.empty() || !args.out.empty()) throw UsageError("--check takes neither FRAME nor -o OUT");
    args.check.supports = args.supports;
    args.check.friction = args.options.method.friction;
    args.check.density = args.options.method.density;
    return run_check(args.check, args.common);
  }
  if (!args.check.up.empty()) throw UsageError("--up belongs to --check; a frame file has its own \"up\"");
  require(args.input, "FRAME");
  require(args.out, "-o OUT");
  const std::vector<GivenSupport> supports = io::parse_supports(args.options.support, kCommandLine);

  Session session(args.common);
  Context& context = session.context;

  RgbdFrame frame = io::read_rgbd_frame(args.input);
  if (!supports.empty()) frame.supports = supports;
  io::OutputFolder out(args.out);
  const cuboids::Completion c = cuboids::complete_cuboids(frame, args.options.method, context);
  if (c.summary.status == Status::cancelled) throw Cancelled();
  write_files(c, frame, args, table, out, context);
  std::vector<std::string> said;
  if (c.summary.status != Status::infeasible) said = run_applications(args.applications, frame, args.options.method, c, out, context);
  return finish(session, out, c.summary, args.common, [&] {
    print_summary(c, args);
    for (const std::string& line : said) fmt::print("{}\n", line);
  });
}

}  // namespace

OptionTable CuboidsOptions::table() {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  OptionTable table = cuboids::describe(method);
  table.add({"support",
             &support,
             "",
             "supports instead of those of the frame: nx,ny,nz,d[,kind] with n·p = d in the camera's coordinates; "
             "several separated by ;",
             -kInf,
             kInf,
             {}});
  return table;
}

Command add_cuboids(CLI::App& app, const std::string& shell_command) {
  auto args = std::make_shared<CuboidsArguments>();
  args->shell_command = shell_command;
  CLI::App* sub = app.add_subcommand("cuboids", "Complete a single RGB-D frame by boxes that stand");
  sub->add_option("FRAME", args->input,
                  "a frame file (FRAME.json), or a folder with frame.json or depth.png and intrinsics.json");
  sub->add_option("-o", args->out, "the folder for the result; made if it does not exist")->type_name("OUT");
  add_flags(*sub, cuboids::describe(args->options.method), args->given);
  sub->add_option("--support", args->supports,
                  "a support instead of those of the frame or found: n·p = d in the camera's coordinates; kind: "
                  "ground, desk, wall or "
                  "ceiling; may be repeated. With --check the name of a block that does not move")
      ->type_name("NX,NY,NZ,D[,KIND]|ID")
      ->allow_extra_args(false);
  sub->add_option_function<std::string>(
         "--mu", [&given = args->given](const std::string& text) { given.emplace_back("friction", text); },
         "the same as --friction")
      ->type_name("X")
      ->excludes("--friction");
  add_flags(*sub, args->applications);
  sub->add_option("--check", args->check.assembly, "only say whether an assembly of blocks stands; exit code 4 if not")
      ->type_name("ASSEMBLY.json");
  sub->add_option("--up", args->check.up, "with --check: the direction that points up (default 0,0,1)")
      ->type_name("X,Y,Z");
  sub->add_flag("--no-report", args->no_report, "leave out report.html");
  add_flags(*sub, args->common);
  sub->footer(
      "Examples:\n  unseen cuboids frame.json -o out\n  unseen cuboids kitchen/ -o out --density 500\n"
      "  unseen cuboids frame.json -o out --support 0,-0.83,-0.55,-0.71,desk\n"
      "  unseen cuboids --check arch.json --support 0 --up -1,0,0 --mu 0.84");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
