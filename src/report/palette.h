// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace unseen::report {

using Rgb = std::array<std::uint8_t, 3>;  ///< sRGB

inline constexpr Rgb kUnassigned = {150, 150, 150};

/// Colour of an orientation frame; −1 gives the grey of what belongs to none. The first eight stay apart for
/// colour-blind eyes (after Okabe and Ito, "Color universal design", 2008); later ones repeat them darker.
Rgb frame_color(int frame);

/// The frame's colour, lighter or darker by plane, so that neighbouring planes of a frame can be told apart.
Rgb plane_color(int plane, int frame);

/// "#rrggbb"
std::string hex(const Rgb& color);

/// Linear components in [0,1], as glTF wants them.
std::array<double, 3> linear(const Rgb& color);

}  // namespace unseen::report
