// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "io/json_field.h"
#include "unseen/core/summary.h"

namespace unseen::report {

using io::JsonField;
using io::parse_json;

/// The text of a result.json of at most 1 GiB. Throws InputError.
std::string read_result_text(const std::filesystem::path& path);

/// The summary of a result of any capability; `text` is the file that `json` was parsed from. Throws InputError naming file and field.
Summary read_summary(const JsonField& json, const std::string& text);

/// Four rows of four numbers. Throws InputError unless they are a rigid motion.
RigidTransform read_transform(const JsonField& json);

/// Three rows, each an axis: columns of a right-handed rotation. Throws InputError if they are none.
Mat3 read_axes(const JsonField& json);

/// fx, fy, cx, cy, width, height.
Camera read_camera(const JsonField& json);

/// An id below 10⁹ that nothing before had; enters it. Throws InputError.
int new_id(const JsonField& json, std::set<int>& ids);

/// One of `ids`. Throws InputError.
int known_id(const JsonField& json, const std::set<int>& ids);

/// The place of a text in a list of names. Throws InputError that names them all.
template <class Kind, std::size_t N>
Kind kind_of(const JsonField& json, const char* const (&names)[N]) {
  const std::string text = json.text();
  std::string all;
  for (std::size_t i = 0; i < N; ++i) {
    if (text == names[i]) return static_cast<Kind>(i);
    all += (i == 0 ? "" : ", ") + std::string(names[i]);
  }
  json.fail("one of " + all);
}

}  // namespace unseen::report
