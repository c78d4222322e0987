// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/columns.h"

namespace unseen::io {

struct PcdField {
  std::string name;
  Scalar type = Scalar::f32;
  std::size_t count = 1;  ///< values a point
};

struct PcdHeader {
  enum class Data { ascii, binary, compressed };
  std::vector<PcdField> fields;
  std::size_t points = 0;
  std::size_t stride = 0;  ///< bytes a point
  std::size_t values = 0;  ///< numbers a point
  Data data = Data::ascii;
  std::optional<Vec3> viewpoint;
  std::size_t offset = 0, line = 0;  ///< where the data starts, lines before it
};

/// Throws InputError on anything that is not a PCD header, or promises more than the file can hold.
PcdHeader read_pcd_header(std::string_view bytes, const std::string& name);

}  // namespace unseen::io
