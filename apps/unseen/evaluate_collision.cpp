// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "commands.h"
#include "evaluate.h"
#include "unseen/collision/evaluate.h"
#include "unseen/core/error.h"
#include "unseen/report/collision_evaluation.h"
#include "unseen/report/collision_result.h"
#include "unseen/report/collision_truth.h"

namespace unseen::cli {
namespace {

namespace fs = std::filesystem;

struct EvaluateCollisionArguments {
  std::string result, truth;
  CommonFlags common;
};

int run(EvaluateCollisionArguments& args) {
  OptionTable table;
  if (resolve_or_dump(table, args.common, "evaluate", {})) return kSolved;
  require(args.result, "OUT");
  require(args.truth, "--truth TRUTH");

  Session session(args.common);

  const fs::path file = result_file(args.result);
  const collision::Reconstruction result = report::read_collision_result(file);
  const collision::Truth truth = report::read_collision_truth(args.truth);
  report::CollisionEvaluation e;
  e.result_path = args.result;
  e.truth_path = args.truth;
  e.scene = truth.scene;
  try {
    e.scores = collision::evaluate(result, truth);
  } catch (const InputError& error) {
    throw InputError(error.source == "result" ? file.string() : args.truth, error.field, error.found, error.expected);
  }
  publish(e, file.parent_path(), args.common, session);
  return kSolved;
}

}  // namespace

Command add_evaluate_collision(CLI::App& evaluate) {
  auto args = std::make_shared<EvaluateCollisionArguments>();
  CLI::App* sub = evaluate.add_subcommand("collision", "Measure a result of unseen collision, and write evaluation.json into it");
  sub->add_option("OUT", args->result, "the folder that unseen collision wrote");
  sub->add_option("--truth", args->truth, "truth.json of unseen synth collision")->type_name("TRUTH");
  add_flags(*sub, args->common);
  sub->footer("Example:\n  unseen evaluate collision OUT --truth shot/truth.json");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
