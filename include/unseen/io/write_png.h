// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>

namespace unseen::io {

/// Writes a 16-bit grey PNG, row by row. Throws InputError (path, reason) if the file cannot be written.
void write_grey_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint16_t> pixels);

/// The same in 8 bits and red, green, blue.
void write_color_png(const std::filesystem::path& path, int width, int height,
                     std::span<const std::array<std::uint8_t, 3>> pixels);

}  // namespace unseen::io
