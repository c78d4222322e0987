// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "commands.h"
#include "session.h"
#include "unseen/io/describe.h"
#include "unseen/io/points.h"
#include "unseen/io/write_points.h"
#include "unseen/report/planes_result.h"

namespace unseen::cli {
namespace {

struct ConvertArguments {
  std::string in, out;
  CommonFlags common;
  GivenOptions given;
  io::ReadOptions read;
};

/// A file cannot be read and replaced at once, nor one in a folder that is read.
void check_apart(const std::string& in, const std::string& out) {
  std::error_code error;
  const std::filesystem::path from = std::filesystem::canonical(in, error);
  if (error) return;  // opening it says why
  if (std::filesystem::equivalent(in, out, error)) throw UsageError(fmt::format("OUT, {}, is the same file as IN", out));
  if (std::filesystem::weakly_canonical(out, error).parent_path() == from) throw UsageError(fmt::format("OUT, {}, lies in the folder IN", out));
}

int run(ConvertArguments& args) {
  OptionTable table = io::describe(args.read);
  if (resolve_or_dump(table, args.common, "convert", args.given)) return kSolved;
  require(args.in, "IN");
  require(args.out, "OUT");
  check_apart(args.in, args.out);

  Session session(args.common);
  Context& context = session.context;

  const auto source = io::open_points(args.in, args.read);
  Summary summary;
  {
    const Stage stage(context, summary, "convert");
    io::write_points(args.out, *source, context);
  }
  for (const std::string& note : source->info().notes) context.warn(note);
  summary.warnings = context.take_warnings();
  session.progress.warn(summary.warnings);
  if (args.common.json) {
    fmt::print("{}", report::summary_json(summary));
  } else if (!args.common.quiet) {
    fmt::print("written: {}\n", args.out);
  }
  return kSolved;
}

}  // namespace

Command add_convert(CLI::App& app) {
  auto args = std::make_shared<ConvertArguments>();
  CLI::App* sub =
      app.add_subcommand("convert", "Turn any cloud that can be read into ply, pcd, xyz, csv or las");
  sub->add_option("IN", args->in, "a point cloud, a mesh, an image, or a folder of depth frames or tiles");
  sub->add_option("OUT", args->out, "the file to write; its ending says the format");
  add_flags(*sub, io::describe(args->read), args->given);
  add_flags(*sub, args->common);
  sub->footer("Example:\n  unseen convert scan.las scan.ply");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
