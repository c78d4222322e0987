// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace unseen::io {

/// Depth along the optical axis in millimetres, row by row; 0 = not measured.
struct DepthImage {
  int width = 0, height = 0;
  std::vector<std::uint16_t> millimetres;
};

/// Reads a 16-bit grey PNG. Throws InputError if the bytes are anything else or broken.
DepthImage read_depth_png(std::string_view bytes, const std::string& name);

}  // namespace unseen::io
