// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "unseen/core/random.h"

namespace unseen::cuboids {

using Color = std::array<std::uint8_t, 3>;

/// A picture with a hole, and which surface each pixel shows.
struct HoledPicture {
  int width = 0, height = 0;
  std::vector<Color> pixels;
  std::vector<char> hole;   ///< 1 = to be filled
  std::vector<int> guide;   ///< number of the surface, −1 = unknown; empty = no guide

  int at(int x, int y) const { return y * width + x; }
  int size() const { return width * height; }
};

/// Where each patch that meets the hole finds the patch without hole that looks most like it (Barnes et al.,
/// "PatchMatch: a randomized correspondence algorithm for structural image editing", 2009). A patch whose centre shows
/// another surface than the guide says is only taken where nothing else is near in looks.
class PatchMatch {
 public:
  static constexpr int kRadius = 3;  ///< pixels: patches of 7 × 7

  explicit PatchMatch(const HoledPicture& picture);

  /// False if no patch is free of the hole.
  bool has_sources() const { return !sources_.empty(); }
  /// Begins with any source of the right surface.
  void start(Random& random);
  /// Begins with the matches of a picture of half the size.
  void start(const PatchMatch& half, Random& random);
  /// Replaces the colours of the hole; the matches stay.
  void set_colors(const std::vector<Color>& pixels);
  /// One pass of propagation and random search over all targets, forwards and backwards in turn.
  void improve(Random& random);
  /// The hole as the matched patches would have it: each votes for the pixels that it covers, the more the better it
  /// matches and the nearer it is to the rim (Wexler et al., "Space-time completion of video", 2007).
  std::vector<Color> vote(const std::vector<Color>& pixels) const;

 private:
  struct Match {
    int source = -1;  ///< pixel in the middle of the patch
    int cost = 0;
  };
  int cost(int target, int source, int limit) const;
  void try_source(int target, int x, int y);
  int any_source(int target, Random& random) const;
  void measure();
  const std::int16_t* row(int x, int y) const { return &padded_[(static_cast<std::size_t>(y + kRadius) * stride_ + x + kRadius) * 4]; }

  int width_ = 0, height_ = 0, stride_ = 0;
  std::vector<std::int16_t> padded_;  ///< red, green, blue, 0; the border repeated
  std::vector<char> hole_, is_source_;
  std::vector<int> guide_;
  std::vector<int> targets_, sources_;  ///< pixels, in rising order
  std::vector<std::vector<int>> sources_of_surface_;
  std::vector<int> from_rim_;  ///< pixels, of each target
  std::vector<Match> matches_;  ///< a pixel
  bool forwards_ = true;
};

/// Steps to the nearest pixel outside the hole, by the larger of the two coordinates; 0 outside.
std::vector<int> distance_from_rim(const HoledPicture& picture);

}  // namespace unseen::cuboids
