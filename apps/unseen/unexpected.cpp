// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unexpected.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <vector>

namespace unseen::cli {
namespace {

/// Letters to insert, remove or replace to get from one word to the other (Levenshtein).
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t corner = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = corner + (a[i - 1] != b[j - 1]);
      corner = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
    }
  }
  return row.back();
}

/// The subcommand that was asked for, or the program itself.
const CLI::App& asked_for(const CLI::App& app) {
  const CLI::App* at = &app;
  while (!at->get_subcommands().empty()) at = at->get_subcommands().front();
  return *at;
}

}  // namespace

std::string unexpected(const CLI::App& app) {
  const CLI::App& command = asked_for(app);
  std::vector<std::string> words = app.remaining(true);
  std::erase(words, "--");
  if (words.empty()) return "-- is not known";
  const auto is_flag = [](const std::string& word) { return word.starts_with("-"); };
  const auto flag = std::find_if(words.begin(), words.end(), is_flag);
  const bool names_command = !command.get_subcommands({}).empty();
  if (!names_command && flag == words.end()) {
    const bool yes_or_no = words.front() == "true" || words.front() == "false";
    return words.front() + " is one argument too many" + (yes_or_no ? "; give it as --option=" + words.front() : "");
  }
  std::string word = names_command ? words.front() : *flag;
  if (is_flag(word)) word = word.substr(0, word.find('='));
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (const CLI::App* sub : command.get_subcommands({})) known.push_back(sub->get_name());
  std::string text = word + " is not known";
  const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) { return distance(word, a) < distance(word, b); });
  if (nearest != known.end() && *nearest != word && 3 * distance(word, *nearest) <= word.size()) text += fmt::format(" (did you mean {}?)", *nearest);
  return text;
}

}  // namespace unseen::cli
