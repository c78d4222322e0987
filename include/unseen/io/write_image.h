// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace unseen::io {

/// A picture (sRGB, row by row) as the bytes of a JPEG file; quality in 0…100.
std::string jpeg_of(const std::vector<std::array<std::uint8_t, 3>>& colors, int width, int height, int quality = 85);

}  // namespace unseen::io
