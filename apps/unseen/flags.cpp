// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "flags.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "unseen/core/version.h"
#include "unseen/io/config.h"

namespace unseen::cli {
namespace {

/// "how far … (deg; default 15; 1…45)"
std::string help_of(const Option& option) {
  std::vector<std::string> facts;
  if (!option.unit.empty() && option.unit != "1") facts.push_back(option.unit);
  if (!option.text().empty()) facts.push_back("default " + option.text());
  if (!option.range().empty()) facts.push_back(option.range());
  return facts.empty() ? option.help : fmt::format("{} ({})", option.help, fmt::join(facts, "; "));
}

/// "true" or "false" for all words that flags know; others as they are, for the option to refuse.
std::string truth_of(const std::string& text) {
  try {
    return CLI::detail::to_flag_value(text) > 0 ? "true" : "false";
  } catch (const std::logic_error&) {
    return text;
  }
}

}  // namespace

void add_flags(CLI::App& app, const OptionTable& table, GivenOptions& given) {
  for (const Option& option : table.all()) {
    const std::string name = option.name;
    if (std::holds_alternative<bool*>(option.target)) {
      app.add_flag(option.flag())->description(help_of(option))->each([name, &given](const std::string& text) {
        given.emplace_back(name, truth_of(text));
      });
    } else {
      const bool is_list = std::holds_alternative<std::vector<double>*>(option.target);
      app.add_option_function<std::string>(
             option.flag(), [name, &given](const std::string& text) { given.emplace_back(name, text); },
             help_of(option))
          ->type_name(option.choices.empty() ? (is_list ? "X,Y,.." : "X") : "NAME");
    }
  }
}

void append(OptionTable& table, const OptionTable& more) {
  for (const Option& option : more.all()) table.add(option);
}

void resolve(OptionTable& table, const std::string& config_file, const std::string& section,
             const GivenOptions& given) {
  if (!config_file.empty())
    io::apply_config(table, config_file, section,
                     {"planes", "cuboids", "collision", "interactions", "scenelets", "convert", "evaluate", "synth"});
  for (const auto& [name, text] : given) table.set_text(name, text, kCommandLine);
}

void add_flags(CLI::App& app, CommonFlags& flags) {
  app.add_option("--config", flags.config_file, "take options from this TOML file; flags given here win")
      ->check([](const std::string& file) { return file.empty() ? std::string("names no file") : std::string(); })
      ->type_name("FILE.toml");
  app.add_flag("--dump-config", flags.dump_config, "print all options as such a file, and end");
  app.add_option("--threads", flags.threads, "at most this many threads; 0 = as many as the machine has")
      ->check(CLI::Range(0, 1024))
      ->type_name("N");
  app.add_flag("--quiet", flags.quiet, "print nothing but errors");
  app.add_flag("--json", flags.json, "print the summary as JSON");
  app.set_version_flag("--version", fmt::format("unseen {}", kVersion));
}

const std::string& require(const std::string& value, const std::string& what) {
  if (value.empty()) throw UsageError(what + " is missing");
  return value;
}

std::string shell_command(const std::vector<std::string>& words) {
  constexpr const char* kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=./,:@%";
  std::string command = "unseen";
  for (std::size_t i = 1; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
      command += " " + word;
      continue;
    }
    command += " '";
    for (const char c : word) command += c == '\'' ? std::string("'\\''") : std::string(1, c);
    command += "'";
  }
  return command;
}

}  // namespace unseen::cli
