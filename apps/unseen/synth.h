// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <memory>
#include <string>

#include "commands.h"
#include "session.h"
#include "unseen/core/summary.h"
#include "unseen/io/output_folder.h"

namespace unseen::cli {

/// Ends a command that made a scene: commits the folder and prints the summary, or what `made` says and where it lies. Throws Cancelled.
void publish(Summary& summary, const std::string& made, io::OutputFolder& out, const std::string& folder, const CommonFlags& common, Session& session);

/// What a synth command is called, and says of itself.
struct SynthTexts {
  const char *name, *about, *out, *examples;
};

/// What a scene is made and written with.
struct SynthRun {
  const OptionTable& table;
  const io::OutputFolder& out;
  Context& context;
  Summary& summary;
};

/// Adds a command that makes a scene: `make` writes it and returns a line that says what was made.
template <class Options>
Command add_synth(CLI::App& synth, const SynthTexts& texts, std::string (*make)(const Options&, const SynthRun&)) {
  struct Arguments {
    std::string out;
    CommonFlags common;
    GivenOptions given;
    Options options;
  };
  auto args = std::make_shared<Arguments>();
  CLI::App* sub = synth.add_subcommand(texts.name, texts.about);
  sub->add_option("-o", args->out, texts.out)->type_name("DIR");
  add_flags(*sub, describe(args->options), args->given);
  add_flags(*sub, args->common);
  sub->footer(texts.examples);
  return {sub, [args, make]() -> int {
            OptionTable table = describe(args->options);
            if (resolve_or_dump(table, args->common, "synth", args->given)) return kSolved;
            require(args->out, "-o DIR");
            Session session(args->common);
            io::OutputFolder out(args->out);
            Summary summary;
            const std::string made = make(args->options, {table, out, session.context, summary});
            publish(summary, made, out, args->out, args->common, session);
            return kSolved;
          }};
}

}  // namespace unseen::cli
