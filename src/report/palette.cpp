// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/palette.h"

#include <fmt/format.h>

#include <cmath>

namespace unseen::report {
namespace {

constexpr std::array<Rgb, 8> kColors = {{{0, 114, 178},
                                         {230, 159, 0},
                                         {0, 158, 115},
                                         {204, 121, 167},
                                         {213, 94, 0},
                                         {86, 180, 233},
                                         {240, 228, 66},
                                         {110, 90, 70}}};

/// Mixes towards white (amount > 0) or black (amount < 0).
Rgb shade(const Rgb& color, double amount) {
  Rgb out{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double target = amount > 0 ? 255.0 : 0.0;
    out[i] = static_cast<std::uint8_t>(std::lround(color[i] + std::abs(amount) * (target - color[i])));
  }
  return out;
}

}  // namespace

Rgb frame_color(int frame) {
  if (frame < 0) return kUnassigned;
  const int round = frame / static_cast<int>(kColors.size());
  return shade(kColors[static_cast<std::size_t>(frame) % kColors.size()], -0.2 * (round % 4));
}

Rgb plane_color(int plane, int frame) {
  if (plane < 0) return kUnassigned;
  constexpr std::array<double, 5> kSteps = {0.0, 0.3, -0.2, 0.15, -0.35};
  return shade(frame_color(frame), kSteps[static_cast<std::size_t>(plane) % kSteps.size()]);
}

std::string hex(const Rgb& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

std::array<double, 3> linear(const Rgb& color) {
  std::array<double, 3> out{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = color[i] / 255.0;
    out[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  return out;
}

}  // namespace unseen::report
