// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "report/palette.h"
#include "unseen/core/geometry.h"

namespace unseen::report {

/// USD ASCII under construction: prims in one another, attributes line by line.
class UsdText {
 public:
  explicit UsdText(std::string head) : text_(std::move(head)) {}

  void open(const std::string& type, const std::string& name) {
    line(fmt::format("def {} \"{}\"", type, name));
    line("{");
    ++depth_;
  }
  void close() {
    --depth_;
    line("}");
  }
  /// A primvar: one value for the whole prim ("constant") or one a point ("vertex").
  void primvar(const std::string& declaration, const std::string& interpolation) {
    line(declaration + " (");
    line("    interpolation = \"" + interpolation + "\"");
    line(")");
  }
  void line(const std::string& text) { text_ += std::string(4 * depth_, ' ') + text + "\n"; }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::size_t depth_ = 0;
};

/// "[a, b, …]"
template <class Items, class Write>
std::string list(const Items& items, Write write) {
  std::string text = "[";
  for (const auto& item : items) {
    if (text.size() > 1) text += ", ";
    text += write(item);
  }
  return text + "]";
}

template <class Vector>
std::string tuple(const Vector& v) {
  return fmt::format("({}, {}, {})", v[0] + 0, v[1] + 0, v[2] + 0);  // + 0: no "-0"
}

/// A string of USD ASCII.
std::string quoted(const std::string& text);

/// USD's colours are linear.
std::string color(const Rgb& srgb);

}  // namespace unseen::report
