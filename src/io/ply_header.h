// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "io/columns.h"

namespace unseen::io {

struct PlyProperty {
  std::string name;
  Scalar type = Scalar::f32;
  bool is_list = false;
  Scalar count_type = Scalar::u8;  ///< of the length of a list
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;

  bool has_list() const;
  std::size_t stride() const;  ///< bytes an instance in binary files, where a list counts by its length only
};

struct PlyHeader {
  bool ascii = false;
  bool swap = false;          ///< stored in the other byte order than this machine's
  std::size_t data = 0;       ///< offset of the first byte after the header
  std::size_t data_line = 0;  ///< lines before it
  std::vector<PlyElement> elements;

  const PlyElement* find(std::string_view name) const;
};

/// Throws InputError on anything that is not a PLY header, or promises more than the file can hold.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name);

/// Moves `at` behind one binary instance of the element; false if the data ends before.
bool skip_instance(std::string_view bytes, std::size_t& at, const PlyElement& element, bool swap);
/// The length of a list at `at`, which moves behind it; false if the data ends before or within the list.
bool list_length(std::string_view bytes, std::size_t& at, const PlyProperty& property, bool swap,
                 std::size_t& length);

}  // namespace unseen::io
