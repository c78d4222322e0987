// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/toml_file.h"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <sstream>

#include "io/file_bytes.h"
#include "io/json_field.h"
#include "unseen/core/error.h"

namespace unseen::io {

nlohmann::json read_toml(const std::filesystem::path& path, const std::string& expected) {
  const auto bytes = FileBytes::open(path);
  std::ostringstream text;
  try {
    text << toml::json_formatter{toml::parse(bytes->view(), path.string())};
  } catch (const toml::parse_error& error) {
    throw InputError(path.string(), fmt::format("line {}", error.source().begin.line), std::string(error.description()), expected);
  }
  return parse_json(text.str(), path.string(), expected);
}

}  // namespace unseen::io
