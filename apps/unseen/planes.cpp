// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/planes/planes.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "commands.h"
#include "session.h"
#include "unseen/core/error.h"
#include "unseen/io/describe.h"
#include "unseen/io/output_folder.h"
#include "unseen/io/points.h"
#include "unseen/io/sha256.h"
#include "unseen/report/page.h"
#include "unseen/report/planes_files.h"
#include "unseen/report/planes_result.h"
#include "unseen/report/planes_scene.h"
#include "unseen/report/points_file.h"
#include "write_text.h"

namespace unseen::cli {
namespace {

constexpr std::size_t kPointsInModels = 200'000;

/// Everything that `unseen planes` can be told.
struct PlanesArguments {
  std::string input, out, shell_command;
  CommonFlags common;
  bool no_report = false, no_points = false;
  GivenOptions given;
  planes::Options options;
  io::ReadOptions read;

  OptionTable table() {
    OptionTable table = planes::describe(options);
    append(table, io::describe(read));
    return table;
  }
};

/// What a run hands back besides the arrangement.
struct Streamed {
  report::PointSample sample;
  std::optional<report::PointsFile> points;
};

std::string plural(std::size_t count, const std::string& one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}

void print_summary(const planes::Arrangement& a, const PlanesArguments& args, bool drawing_expected) {
  const std::size_t points = report::count_of(a.summary, "points"), assigned = report::count_of(a.summary, "assigned");
  const bool estimated = !args.options.scale && !args.options.relative_scale;
  const std::string thing = a.two_dimensional ? "line" : "plane";
  const std::size_t finite = report::count_of(a.summary, "finite");
  const double share =
      finite == 0 ? 0.0 : 100.0 * static_cast<double>(assigned) / static_cast<double>(finite);
  const std::string left_out = finite == points ? "" : fmt::format(" ({} are no numbers)", points - finite);
  if (a.two_dimensional && !drawing_expected)
    fmt::print("all points share one coordinate, or lie in a thin slice: taken as a drawing\n");
  fmt::print("{}{}, {} of them on a {} ({:.1f} %)\n", plural(points, "point"), left_out, assigned, thing, share);
  fmt::print("{} in {}, {}\n", plural(a.planes.size(), thing), plural(a.frames.size(), "orientation frame"),
             plural(a.directions.size(), "direction"));
  fmt::print("{}, {} of {}s related\n", plural(a.relations.size(), "relation"),
             plural(a.plane_relations, "pair"), thing);
  fmt::print("scale {:.4g}{}{}\n", a.scale, a.two_dimensional ? "" : " m", estimated ? " (estimated; --scale sets it)" : "");
  if (a.planes.empty()) fmt::print("nothing found: a smaller or larger --scale may help\n");
  print_place(args.out, args.no_report);
}

/// Adds what the reader had to guess or leave out, unless the method has said so already.
void add_notes(const SourceInfo& info, Summary& summary) {
  for (const std::string& note : info.notes)
    if (std::find(summary.warnings.begin(), summary.warnings.end(), note) == summary.warnings.end())
      summary.warnings.push_back(note);
}

void write_files(const planes::Arrangement& a, const PlanesArguments& args, const OptionTable& table,
                 Streamed& streamed, const io::OutputFolder& out, const Context& context) {
  const report::InputRecord input = {args.input, io::sha256(args.input, context)};
  if (!args.no_report)
    write_text(out.file("report.html"),
               report::page_of(report::planes_title(a, input),
                               {report::planes_scene(a, input, table, args.shell_command, streamed.sample)}));
  write_text(out.file("result.json"), report::planes_json(a, input, table));
  if (a.summary.status == Status::infeasible) {
    streamed.points.reset();
    std::filesystem::remove(out.file("points.ply"));
    return;
  }
  if (streamed.points) {
    std::vector<int> frame_of_plane;
    for (const planes::ArrangedPlane& plane : a.planes) frame_of_plane.push_back(plane.frame);
    streamed.points->finish(frame_of_plane);
  }
  write_text(out.file("planes.ply"), report::planes_ply(a));
  write_text(out.file("planes.obj"), report::planes_obj(a, "planes.mtl"));
  write_text(out.file("planes.mtl"), report::planes_mtl(a));
  write_text(out.file("planes.csv"), report::planes_csv(a));
  const report::PointSample few = report::thinned(streamed.sample, kPointsInModels);
  write_text(out.file("scene.glb"), report::planes_glb(a, few));
  write_text(out.file("scene.usda"), report::planes_usda(a, few));
  if (!a.two_dimensional) return;
  write_text(out.file("drawing.dxf"), report::drawing_dxf(a));
  write_text(out.file("drawing.svg"), report::drawing_svg(a));
}

int run(PlanesArguments& args) {
  OptionTable table = args.table();
  if (resolve_or_dump(table, args.common, "planes", args.given)) return kSolved;
  require(args.input, "CLOUD");
  require(args.out, "-o OUT");
  args.read.seed = static_cast<std::uint64_t>(args.options.seed);

  Session session(args.common);
  Context& context = session.context;

  const auto source = io::open_points(args.input, args.read);
  io::OutputFolder out(args.out);
  Streamed streamed;
  if (!args.no_points) streamed.points.emplace(out.file("points.ply"));
  planes::Arrangement a =
      planes::find_planes(*source, args.options, context,
                          [&](std::span<const Vec3> positions, std::span<const int> plane_of_point) {
                            streamed.sample.add(positions, plane_of_point);
                            if (streamed.points) streamed.points->add(positions, plane_of_point);
                          });
  if (a.summary.status == Status::cancelled) throw Cancelled();
  add_notes(source->info(), a.summary);
  write_files(a, args, table, streamed, out, context);
  return finish(session, out, a.summary, args.common, [&] { print_summary(a, args, source->info().two_dimensional); });
}

}  // namespace

Command add_planes(CLI::App& app, const std::string& shell_command) {
  auto args = std::make_shared<PlanesArguments>();
  args->shell_command = shell_command;
  CLI::App* sub =
      app.add_subcommand("planes", "Find planes with exact relations in a scan, or lines in a drawing");
  sub->add_option("CLOUD", args->input,
                  "a point cloud, a mesh, an image, or a folder of depth frames or tiles");
  sub->add_option("-o", args->out, "the folder for the result; made if it does not exist")->type_name("OUT");
  add_flags(*sub, args->table(), args->given);
  sub->add_flag("--no-points", args->no_points, "leave out points.ply");
  sub->add_flag("--no-report", args->no_report, "leave out report.html");
  add_flags(*sub, args->common);
  sub->footer(
      "Examples:\n  unseen planes scan.ply -o out\n  unseen planes scan.ply -o out --scale 0.05 --angles "
      "60,90\n"
      "  unseen planes kitchen/ -o out --depth-range 0.3,3.5 --frame-step 20");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
