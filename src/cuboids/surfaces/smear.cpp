// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/surfaces/smear.h"

#include <algorithm>
#include <cmath>

namespace unseen::cuboids {
namespace {

constexpr int kLeastReach = 2, kMostReach = 6;  // pixels, that an edge is smeared over to either side
constexpr double kJump = 0.05;       // of the inverse depth, that lies between two surfaces,
constexpr double kSteep = 4.0;       // and times what either changes by over as many pixels
constexpr double kNoFarther = 0.5;    // of the lesser inverse depth: no surface goes on farther than twice as far
constexpr double kClear = 2.0;       // times as large a jump has no narrow side between its surfaces
constexpr double kBetween = 0.15;    // of the jump, that a pixel is off either surface which is on none
constexpr double kSmeared = 0.6;     // of the pixels at clear jumps are between surfaces; in sharp images, with stray pixels at edges, a quarter at most
constexpr std::size_t kFewest = 200;  // pixels at clear jumps

/// What a row or column says of a pixel in it. A plane's inverse depth is linear in the picture.
struct Jump {
  double size = 0;       ///< of the inverse depth; 0 = there is none
  double place = 0;      ///< of the pixel between both surfaces, 0…1
  double continued = 0;  ///< inverse depth there of the surface that it is nearer to
  bool clear = false;
};

Jump jump_at(const std::vector<float>& depth, std::size_t i, std::size_t step, int reach) {
  double w[5];
  for (int k = 0; k < 5; ++k) {
    const double z = depth[i + static_cast<std::size_t>(k * reach) * step - static_cast<std::size_t>(2 * reach) * step];
    if (!(z > 0.0) || !std::isfinite(z)) return {};
    w[k] = 1.0 / z;
  }
  const double size = w[3] - w[1], least = std::max(kJump * std::max(w[1], w[3]), kSteep * std::max(std::abs(w[1] - w[0]), std::abs(w[4] - w[3])));
  if (std::abs(size) < least) return {};
  const double place = (w[2] - w[1]) / size;
  const double continued = place < 0.5 ? 2.0 * w[1] - w[0] : 2.0 * w[3] - w[4];
  return {std::abs(size), place, std::max(continued, kNoFarther * std::min(w[1], w[3])), std::abs(size) >= kClear * least};
}

/// Calls f(pixel, jump) for each pixel at a jump, the larger one if there is one along its row and one along its column.
template <class F>
void for_jumps(const RgbdFrame& frame, int reach, F f) {
  const int width = frame.camera.width, height = frame.camera.height, margin = 2 * reach;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      const Jump across = x >= margin && x < width - margin ? jump_at(frame.depth, i, 1, reach) : Jump{};
      const Jump down = y >= margin && y < height - margin ? jump_at(frame.depth, i, static_cast<std::size_t>(width), reach) : Jump{};
      if (const Jump& jump = across.size > down.size ? across : down; jump.size > 0.0) f(i, jump);
    }
}

bool is_smeared(const RgbdFrame& frame, int reach) {
  std::size_t jumps = 0, between = 0;
  for_jumps(frame, reach, [&](std::size_t, const Jump& jump) {
    if (!jump.clear) return;
    ++jumps;
    between += jump.place > kBetween && jump.place < 1.0 - kBetween;
  });
  return jumps >= kFewest && static_cast<double>(between) >= kSmeared * static_cast<double>(jumps);
}

}  // namespace

std::optional<RgbdFrame> without_smear(const RgbdFrame& frame, Context& context) {
  if (frame.is_fused() || frame.depth.size() != static_cast<std::size_t>(frame.camera.width) * std::max(frame.camera.height, 0)) return std::nullopt;
  int reach = kMostReach;  // beyond the smear fewer pixels are between surfaces
  while (reach >= kLeastReach && !is_smeared(frame, reach)) --reach;
  if (reach < kLeastReach) return std::nullopt;
  RgbdFrame sharp = frame;
  for_jumps(frame, reach, [&](std::size_t i, const Jump& jump) {
    sharp.depth[i] = static_cast<float>(1.0 / jump.continued);
  });
  context.warn("the depth is smeared across edges, as of a phone: what lies between two surfaces goes to the one whose depth it is closer to, and sizes are good to two pixels");
  return sharp;
}

}  // namespace unseen::cuboids
