// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>

#include "unseen/core/geometry.h"

namespace unseen::cuboids {

/// A point of a part, and where its surface looks.
struct Sample {
  Vec3 p, n;
  double sigma;  ///< m, of p
  double at = 0;  ///< m, along the direction in which a part is cut
};

/// How much of some samples (each 0 … 1: off its side by three σ and more, or beyond another one) the upright box does not explain that suits them
/// best, with one side in each of four directions and a top.
double unexplained(std::span<const Sample> samples);

/// The horizontal direction along the side of that box on which most samples are; unit.
Vec2 across_front(std::span<const Sample> samples);

/// The same of a body whose sides and top may lean: one plane each way.
double unexplained_leaning(std::span<const Sample> samples);

}  // namespace unseen::cuboids
