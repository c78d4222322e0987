// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/core/error.h"

#include <fmt/format.h>

#include "core/shortened.h"

namespace unseen {
namespace {

/// Hostile input must not break the one-line promise or flood a terminal.
std::string one_line(std::string text) {
  constexpr std::size_t kLongest = 300;
  text = shortened(std::move(text), kLongest);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

std::string message(const std::string& source, const std::string& field, const std::string& found,
                    const std::string& expected) {
  std::string text = source;
  if (!field.empty()) text += (text.empty() ? "" : ": ") + field;
  if (!found.empty()) text += ": found " + found;
  if (!expected.empty()) text += (found.empty() ? ": expected " : ", expected ") + expected;
  return one_line(std::move(text));
}

}  // namespace

std::string shortened(std::string text, std::size_t most) {
  if (text.size() <= most) return text;
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xc0) == 0x80) --most;  // where the last character began
  return text.substr(0, most) + "…";
}

InputError::InputError(std::string source_, std::string field_, std::string found_, std::string expected_)
    : std::runtime_error(message(source_, field_, found_, expected_)),
      source(std::move(source_)),
      field(std::move(field_)),
      found(std::move(found_)),
      expected(std::move(expected_)) {}

}  // namespace unseen
