// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "evaluate.h"
#include "unseen/core/error.h"
#include "unseen/report/interactions_evaluation.h"
#include "unseen/report/interactions_recording.h"
#include "unseen/report/interactions_result.h"

namespace unseen::cli {
namespace {

namespace fs = std::filesystem;

struct EvaluateInteractionsArguments {
  std::string result, truth, original;
  std::vector<int> interacted;
  CommonFlags common;
};

interactions::Recording read_truth(const EvaluateInteractionsArguments& args) {
  interactions::Recording truth = report::read_recording(args.truth);
  for (const int id : args.interacted)
    if (std::none_of(truth.objects.begin(), truth.objects.end(), [id](const auto& o) { return o.id == id; }))
      throw InputError(kCommandLine, "--interacted", std::to_string(id), "numbers of the truth's objects");
  if (!args.interacted.empty()) truth.interacted = args.interacted;
  return truth;
}

int run(EvaluateInteractionsArguments& args) {
  OptionTable table;
  if (resolve_or_dump(table, args.common, "evaluate", {})) return kSolved;
  if (args.original.empty()) require(args.result, "OUT");
  require(args.truth, "--truth SCENE");

  Session session(args.common);

  const fs::path file = result_file(args.result);
  const interactions::Recording truth = read_truth(args);
  report::InteractionsEvaluation e;
  e.result_path = args.original.empty() ? args.result : args.original;
  e.truth_path = args.truth;
  e.scene = truth.name;
  e.scores = interactions::evaluate(
      args.original.empty() ? report::read_interactions_result(file) : report::read_original_result(args.original, truth), truth);
  publish(e, args.original.empty() ? file.parent_path() : fs::path(), args.common, session);
  return kSolved;
}

}  // namespace

Command add_evaluate_interactions(CLI::App& evaluate) {
  auto args = std::make_shared<EvaluateInteractionsArguments>();
  CLI::App* sub = evaluate.add_subcommand("interactions", "Measure a result of unseen interactions, and write evaluation.json into it");
  CLI::Option* out = sub->add_option("OUT", args->result, "the folder that unseen interactions wrote");
  sub->add_option("--truth", args->truth, "a scene folder with the truth in its gt/, of i3DB or unseen synth interactions")->type_name("SCENE");
  sub->add_option("--interacted", args->interacted, "numbers of the true objects that somebody uses, if the scene does not say: 0,2,4")
      ->delimiter(',')
      ->type_name("IDS");
  sub->add_option("--original", args->original, "instead of OUT: the output of the original authors' program, which is only printed")
      ->type_name("DIR")
      ->excludes(out);
  add_flags(*sub, args->common);
  sub->footer(
      "Examples:\n  unseen evaluate interactions OUT --truth synth/room\n"
      "  unseen evaluate interactions OUT --truth i3db/Scene07 --interacted 0,1,2");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
