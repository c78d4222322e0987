// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <vector>

#include "cuboids/objects/extent.h"

namespace unseen::cuboids {

/// How bright a picture is, 0 … 255, between pixels too.
class GreyPicture {
 public:
  explicit GreyPicture(const RgbdFrame& frame);
  double at(const Vec2& pixel) const;

 private:
  int width_ = 0, height_ = 0;
  std::vector<float> value_;
};

/// What the picture shows along lines that run straight over the whole of one side of a part: of each place across them, on how much of the line.
struct SeamLines {
  double low = 0, width = 0;        ///< m, of the first place, and between places: about a pixel
  std::vector<int> rows;            ///< how much of each line is in the picture, in steps of about three pixels
  std::vector<double> dark;         ///< 0 … 1: where it is darker than what is on either side
  std::array<std::vector<double>, 2> step;  ///< 0 … 1: where it is darker beyond than before, and the other way round
  std::array<double, 3> usual{};                ///< what most lines of the side have no more of (dark, and each step): where prints are everywhere, a line says little

  int place(double at) const { return static_cast<int>((at - low) / width); }
  double at(int place) const { return low + (place + 0.5) * width; }
  int count() const { return static_cast<int>(rows.size()); }
};

/// Lines across direction `across` on one side, of which `points` are some: those along which direction `along` runs (0 and 1 horizontal, 2 up).
SeamLines seam_lines(const GreyPicture& picture, const Camera& camera, const Observation& seen, const Directions& directions, std::span<const int> points, int across,
                     int along);

}  // namespace unseen::cuboids
