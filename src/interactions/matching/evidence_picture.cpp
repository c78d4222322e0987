// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/interactions/evidence_picture.h"

#include <algorithm>
#include <cmath>

namespace unseen::interactions {
namespace {

/// Of the superclasses, as the page shows them: apart for colour-blind eyes (after Okabe and Ito).
constexpr std::array<std::array<float, 3>, 3> kHues = {{{0, 114, 178}, {230, 159, 0}, {0, 158, 115}}};

}  // namespace

EvidencePicture picture_of(const EvidenceMap& map, int pixels_per_cell) {
  const auto ground = static_cast<std::size_t>(std::max(map.rows, 0)) * static_cast<std::size_t>(std::max(map.columns, 0));
  if (ground == 0 || map.probability.size() != kHues.size() * EvidenceMap::kTurns * ground) return {};
  const int scale = std::max(pixels_per_cell, 1);
  EvidencePicture picture = {map.columns * scale, map.rows * scale, {}};
  picture.pixels.reserve(ground * static_cast<std::size_t>(scale * scale));
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const auto cell = static_cast<std::size_t>((map.rows - 1 - y / scale) * map.columns + x / scale);
      std::array<float, 3> light = {};
      for (std::size_t s = 0; s < kHues.size(); ++s) {
        float likeliest = 0;
        for (std::size_t turn = 0; turn < EvidenceMap::kTurns; ++turn)
          likeliest = std::max(likeliest, map.probability[(s * EvidenceMap::kTurns + turn) * ground + cell]);
        for (std::size_t c = 0; c < 3; ++c) light[c] += std::min(likeliest, 1.0f) * kHues[s][c];
      }
      std::array<std::uint8_t, 3>& pixel = picture.pixels.emplace_back();
      for (std::size_t c = 0; c < 3; ++c) pixel[c] = static_cast<std::uint8_t>(std::lround(std::min(light[c], 255.0f)));
    }
  return picture;
}

}  // namespace unseen::interactions
