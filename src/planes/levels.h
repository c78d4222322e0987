// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "planes/probes.h"

namespace unseen::planes {

/// Levels along an axis on which a coarsely rounded depth, or a coarse lattice, has left most of the points.
struct Levels {
  Vec3 axis;               ///< unit
  std::vector<double> at;  ///< m, ascending

  /// How far apart the levels are around a point (m).
  double step_at(const Vec3& p) const;
};

/// The levels of points along an axis, if much of them lie on values that stand out among those `least` (m) away and less.
std::optional<Levels> find_levels(const std::vector<Vec3>& points, const Vec3& axis, double least);

/// How far apart (m) levels are on which the sample lies, as coarse depth leaves it; 0 where it does not. Steps of like size along two axes
/// are those of a model or a lattice.
double step_of_levels(const Survey& survey, const Space& space, const std::vector<Probe>& probes, double scale);

}  // namespace unseen::planes
