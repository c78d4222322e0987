// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/usd_text.h"

namespace unseen::report {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c == '\n' || c == '\r' ? ' ' : c;
  }
  out += '"';
  return out;
}

std::string color(const Rgb& srgb) {
  const auto c = linear(srgb);
  return tuple(Vec3f(Vec3(c[0], c[1], c[2]).cast<float>()));
}

}  // namespace unseen::report
