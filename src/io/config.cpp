// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <toml++/toml.h>
#include <algorithm>
#include <sstream>

#include "io/file_bytes.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

toml::table parse(const std::filesystem::path& path) {
  const auto bytes = FileBytes::open(path);
  try {
    return toml::parse(bytes->view(), path.string());
  } catch (const toml::parse_error& error) {
    throw InputError(path.string(), fmt::format("line {}", error.source().begin.line),
                     std::string(error.description()), "TOML such as \"scale = 0.05\"");
  }
}

OptionInput input_of(const toml::node& node, const std::string& source, const std::string& key) {
  if (const auto value = node.value_exact<bool>()) return *value;
  if (const auto value = node.value_exact<std::string>()) return *value;
  if (node.is_number()) return *node.value<double>();
  const toml::array* array = node.as_array();
  if (!array)
    throw InputError(source, key, "a table or date", "true, false, a number, text or a list of numbers");
  std::vector<double> values;
  for (const toml::node& element : *array) {
    if (!element.is_number())
      throw InputError(source, key, "a list with other than numbers", "a list of numbers");
    values.push_back(*element.value<double>());
  }
  return values;
}

/// Text as TOML: in quotes, with escapes.
std::string quoted_toml(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      (result += '\\') += c;
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else
      result += c;
  }
  return result + "\"";
}

std::string value_of(const Option& option) {
  if (std::holds_alternative<std::string*>(option.target)) return quoted_toml(option.text());
  if (std::holds_alternative<std::vector<double>*>(option.target)) return fmt::format("[{}]", option.text());
  return option.text();
}

}  // namespace

void apply_config(OptionTable& table, const std::filesystem::path& path, const std::string& section,
                  const std::vector<std::string>& other_sections) {
  const std::string source = path.string();
  const toml::table root = parse(path);
  const toml::table* own = nullptr;
  for (const auto& [key, node] : root) {
    const std::string name(key.str());
    if (!node.is_table()) {
      table.set(name, input_of(node, source, name), source);
    } else if (name == section) {
      own = node.as_table();
    } else if (std::find(other_sections.begin(), other_sections.end(), name) == other_sections.end()) {
      throw InputError(source, "table", fmt::format("[{}]", name), fmt::format("[{}]", section));
    }
  }
  if (!own) return;
  for (const auto& [key, node] : *own) {
    const std::string name(key.str());
    table.set(name, input_of(node, source, name), source);
  }
}

std::string dump_config(const OptionTable& table, const std::string& section) {
  std::string text = fmt::format("[{}]\n", section);
  for (const Option& option : table.all()) {
    std::vector<std::string> remarks;
    for (std::string remark : {option.help, option.unit, option.range()}) {
      std::replace(remark.begin(), remark.end(), '\n', ' ');
      if (!remark.empty()) remarks.push_back(std::move(remark));
    }
    if (!remarks.empty()) text += fmt::format("\n# {}\n", fmt::join(remarks, "; "));
    const bool unset = std::holds_alternative<std::optional<double>*>(option.target) && option.text().empty();
    text += unset ? fmt::format("# {} =\n", option.name)
                  : fmt::format("{} = {}\n", option.name, value_of(option));
  }
  return text;
}

}  // namespace unseen::io
