// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "commands.h"
#include "evaluate.h"
#include "unseen/cuboids/evaluate.h"
#include "unseen/report/cuboids_evaluation.h"
#include "unseen/report/cuboids_result.h"
#include "unseen/report/cuboids_truth.h"

namespace unseen::cli {
namespace {

namespace fs = std::filesystem;

struct EvaluateCuboidsArguments {
  std::string result, truth, frame, hidden;
  CommonFlags common;
  GivenOptions given;
  cuboids::EvaluateOptions options;

  OptionTable table() {
    OptionTable table;
    table.add({"tolerance", &options.tolerance, "m", "initial boxes this near each other count as touching", 0, 1, {}});
    table.add({"referee", &options.referee, "", "let MuJoCo decide whether the result stands", {}, {}, {}});
    table.add({"seconds", &options.seconds, "s", "how long MuJoCo runs", 0.01, 100, {}});
    table.add({"friction", &options.friction, "1", "friction coefficient in MuJoCo", 0, 10, {}});
    table.add({"hidden", &hidden, "", "truth without poses: the dimensions that the frame hides, NAME:MILLIMETRES,…", {}, {}, {}});
    return table;
  }
};

cuboids::Truth read_truth(const EvaluateCuboidsArguments& args) {
  if (args.frame.empty()) return report::read_cuboids_truth(args.truth);
  return report::read_measured_truth(args.truth, args.frame, report::parse_hidden_dimensions(args.hidden, kCommandLine));
}

int run(EvaluateCuboidsArguments& args) {
  OptionTable table = args.table();
  if (resolve_or_dump(table, args.common, "evaluate", args.given)) return kSolved;
  require(args.result, "OUT");
  if (!args.options.referee || !args.frame.empty()) require(args.truth, "--truth TRUTH");

  Session session(args.common);
  Context& context = session.context;

  const fs::path file = result_file(args.result);
  const cuboids::Completion result = report::read_cuboids_result(file);
  const std::optional<cuboids::Truth> truth = args.truth.empty() ? std::nullopt : std::optional(read_truth(args));
  report::CuboidsEvaluation e;
  e.result_path = args.result;
  e.truth_path = args.truth;
  if (truth) e.family = truth->family;
  Summary summary;
  {
    const Stage stage(context, summary, "evaluate");
    e.scores = truth ? cuboids::evaluate(result, *truth, args.options, context) : cuboids::evaluate(result, args.options, context);
  }
  publish(e, file.parent_path(), args.common, session);
  return kSolved;
}

}  // namespace

Command add_evaluate_cuboids(CLI::App& evaluate) {
  auto args = std::make_shared<EvaluateCuboidsArguments>();
  CLI::App* sub =
      evaluate.add_subcommand("cuboids", "Measure a result of unseen cuboids, and write evaluation.json into it");
  sub->add_option("OUT", args->result, "the folder that unseen cuboids wrote");
  sub->add_option("--truth", args->truth, "truth.json of unseen synth cuboids, or measured sizes and contacts; without it, whether the result stands")
      ->type_name("TRUTH");
  sub->add_option("--frame", args->frame, "the truth has no poses: the frame's folder, with label.png")->type_name("DIR");
  add_flags(*sub, args->table(), args->given);
  add_flags(*sub, args->common);
  sub->footer(
      "Examples:\n  unseen evaluate cuboids OUT\n  unseen evaluate cuboids OUT --truth chair/view-0/truth.json\n"
      "  unseen evaluate cuboids OUT --truth sizes.json --frame shelf_07 --hidden W:263,W:199");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
