// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>
#include <vector>

#include "cuboids/objects/tints.h"

namespace unseen::cuboids {

/// A connected part of what was seen that has one colour.
struct ColorRegion {
  std::vector<int> points;
  std::vector<int> rim;  ///< what is blurred between it and others, and nearest to it
  Tint tint = Tint::Zero();  ///< mean of the points; where it has sides under different lights, of the first
  std::vector<Tint> others{};  ///< of what was absorbed
};

/// Makes another region part of one; the other is empty then.
void absorb(ColorRegion& region, ColorRegion& other);

/// The regions of a part (list of points) that has a few colours and nothing else; none of other parts. Sides that look different ways are one region where
/// light alone may have made them different. `scratch` has −2 for each point, before and after.
std::vector<ColorRegion> color_regions(const RgbdFrame& frame, const Observation& seen, std::span<const int> part, std::vector<int>& scratch);

}  // namespace unseen::cuboids
