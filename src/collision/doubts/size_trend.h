// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "collision/solve/problem.h"

namespace unseen::collision {

/// How the distances of the filmed balls change along each flight, from the projected sizes in `problem.points`: blur, shade and a wrong radius
/// make all sizes of a flight off alike, but hardly their change.
std::vector<SizeTrend> size_trends(const Problem& problem);

}  // namespace unseen::collision
