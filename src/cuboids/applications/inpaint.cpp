// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/applications/inpaint.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace unseen::cuboids {
namespace {

constexpr int kSmallest = 6 * PatchMatch::kRadius;  // pixels: no coarser picture than that
constexpr int kSearches = 2;                        // passes before each vote
constexpr int kRoundsCoarse = 12, kRoundsFine = 3;  // votes

/// Half the size. A pixel is in the hole if any of its four is, so that what is known stays pure.
HoledPicture halved(const HoledPicture& fine) {
  HoledPicture coarse;
  coarse.width = fine.width / 2;
  coarse.height = fine.height / 2;
  for (int y = 0; y < coarse.height; ++y)
    for (int x = 0; x < coarse.width; ++x) {
      std::array<int, 3> sum{};
      char hole = 0;
      for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
        const int from = fine.at(2 * x + i, 2 * y + j);
        hole |= fine.hole[from];
        for (int k = 0; k < 3; ++k) sum[k] += fine.pixels[from][k];
      }
      coarse.hole.push_back(hole);
      coarse.pixels.push_back({static_cast<std::uint8_t>((sum[0] + 2) / 4), static_cast<std::uint8_t>((sum[1] + 2) / 4),
                               static_cast<std::uint8_t>((sum[2] + 2) / 4)});
      if (!fine.guide.empty()) coarse.guide.push_back(fine.guide[fine.at(2 * x, 2 * y)]);
    }
  return coarse;
}

/// The hole filled ring by ring with the mean of what is known around each pixel.
std::vector<Color> filled_smoothly(const HoledPicture& picture) {
  std::vector<Color> out = picture.pixels;
  const std::vector<int> ring = distance_from_rim(picture);
  std::vector<int> order;
  for (int i = 0; i < picture.size(); ++i)
    if (picture.hole[i]) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return ring[a] < ring[b]; });
  for (const int i : order) {
    const int x = i % picture.width, y = i / picture.width;
    std::array<int, 3> sum{};
    int count = 0;
    for (int v = std::max(0, y - 1); v <= std::min(picture.height - 1, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(picture.width - 1, x + 1); ++u) {
        const int from = picture.at(u, v);
        if (ring[from] >= ring[i]) continue;
        for (int k = 0; k < 3; ++k) sum[k] += out[from][k];
        ++count;
      }
    for (int k = 0; k < 3 && count > 0; ++k) out[i][k] = static_cast<std::uint8_t>(sum[k] / count);
  }
  return out;
}

/// The picture and its halves, down to where the hole is hardly wider than a patch.
std::vector<HoledPicture> pyramid(const HoledPicture& picture) {
  std::vector<HoledPicture> levels = {picture};
  while (std::min(levels.back().width, levels.back().height) >= 2 * kSmallest) {
    const std::vector<int> depth = distance_from_rim(levels.back());
    if (*std::max_element(depth.begin(), depth.end()) <= PatchMatch::kRadius) break;
    HoledPicture next = halved(levels.back());
    if (!PatchMatch(next).has_sources()) break;
    levels.push_back(std::move(next));
  }
  return levels;
}

}  // namespace

std::vector<Color> inpaint(const HoledPicture& picture, std::uint64_t seed, Context& context) {
  if (std::find(picture.hole.begin(), picture.hole.end(), 1) == picture.hole.end()) return picture.pixels;
  std::vector<HoledPicture> levels = pyramid(picture);
  Random random(seed);
  std::optional<PatchMatch> coarser;
  const int last = static_cast<int>(levels.size()) - 1;
  for (int l = last; l >= 0; --l) {
    HoledPicture& level = levels[l];
    level.pixels = filled_smoothly(level);
    PatchMatch match(level);
    if (!match.has_sources()) return level.pixels;
    if (coarser) {
      match.start(*coarser, random);
      level.pixels = match.vote(level.pixels);
      match.set_colors(level.pixels);
    } else {
      match.start(random);
    }
    const int rounds = l == 0 ? kRoundsFine : std::max(kRoundsFine, kRoundsCoarse - 2 * (last - l));
    for (int round = 0; round < rounds; ++round) {
      context.progress(1.0 - (l + 1.0 - (round + 1.0) / rounds) / (last + 1.0));
      for (int pass = 0; pass < kSearches; ++pass) match.improve(random);
      level.pixels = match.vote(level.pixels);
      match.set_colors(level.pixels);
    }
    coarser = std::move(match);
  }
  return levels.front().pixels;
}

}  // namespace unseen::cuboids
