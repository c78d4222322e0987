// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <vector>

#include "io/depth_png.h"

namespace unseen::io {

/// How many pixels have each depth, by millimetres.
class DepthValues {
 public:
  /// Counts those from `low` to `high`, m.
  void add(const DepthImage& image, double low, double high);

  /// How far apart (m) the depths are that a sensor tells, where they are typical: half of the pixels have coarser ones. 0 where they are not
  /// apart in order, as in few depths, which a scene may have.
  double rounding() const;

 private:
  std::vector<std::uint64_t> pixels_ = std::vector<std::uint64_t>(65536);
};

}  // namespace unseen::io
