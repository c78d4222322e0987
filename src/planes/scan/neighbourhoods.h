// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "core/point_tree.h"
#include "planes/scan/scale.h"

namespace unseen::planes {

/// The points nearest to a probe, itself first, by rising distance.
using Neighbourhood = std::vector<Vec3>;

/// Finds neighbourhoods in a survey's sample, which it refers to.
class SampleTree {
 public:
  explicit SampleTree(const Survey& survey) : points_(survey.sample), tree_(points_) {}
  /// At most `points` points around one of the sample; of those just as far, the ones that come first in the sample.
  Neighbourhood around(std::size_t probe, std::size_t points) const;

 private:
  const LargeVector<Vec3>& points_;
  PointTree<LargeVector<Vec3>> tree_;
};

/// Neighbourhoods, of at most `points` points each, of the first points of a survey's sample among all points
/// of the source. One that is eight times as far from others as half of them are has none.
std::vector<Neighbourhood> neighbourhoods(PointSource& source, const Survey& survey, const SampleTree& tree,
                                          std::size_t probes, std::size_t points, const Context& context);

}  // namespace unseen::planes
