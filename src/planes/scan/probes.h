// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <vector>

#include "planes/scan/neighbourhoods.h"
#include "planes/scan/scale.h"
#include "planes/scan/weighted.h"

namespace unseen::planes {

constexpr std::size_t kFewestNeighbours = 32, kMostNeighbours = 128;  // of a probe

/// What the nearest neighbours of one point of a survey's sample tell.
struct Probe {
  double spacing = 0;     ///< m, to the sixth neighbour, or as far as those reach that lie in more than one line
  PlaneFit fit;           ///< of the nearest 32 (2D: 8 or 16 in a line), or more where these are no flat disc
  bool surrounded = true; ///< false: even the last neighbour lies in one line with the others
  std::size_t index = 0;  ///< in the sample
  double reach = 0;       ///< m, the spacing, or farther where the nearest are a line of a scan whose noise is as wide as its points are apart
};

/// Probes of the sample; of each the nearest `most` points count. `tree`: of the sample, as below.
std::vector<Probe> probe_sample(const Survey& survey, const SampleTree& tree, const Space& space, std::size_t count, std::size_t most,
                                const Context& context);

/// The same among all points of the source. Where even `most` of them are no flat disc, and where points are too sparse to be gathered, those of
/// the sample tell.
std::vector<Probe> probe_source(PointSource& source, const Survey& survey, const SampleTree& tree, const Space& space,
                                std::size_t count, std::size_t most, const Context& context);

/// Some hundred probes of the sample, of each the nearest kFewestNeighbours.
std::vector<Probe> probe_few(const Survey& survey, const Space& space, std::size_t count, const Context& context);

/// Those whose neighbours lie on a disc, and not in space as leaves do.
std::vector<Probe> flat_ones(const std::vector<Probe>& probes, const Space& space);

/// What each probe counts for in a median over the surface rather than over the points: the area (2D: length) it stands
/// for, so that a densely sampled corner does not decide for a whole scan. One whose neighbours are both far
/// and no surface is a stray point, and counts for nothing.
std::vector<double> weights_of(const std::vector<Probe>& probes, const Space& space);

/// The median of value(probe) by these weights.
template <class F>
double weighted_median(const std::vector<Probe>& probes, const Space& space, F value) {
  const std::vector<double> weights = weights_of(probes, space);
  std::vector<std::pair<double, double>> weighted;
  for (std::size_t i = 0; i < probes.size(); ++i) weighted.emplace_back(value(probes[i]), weights[i]);
  return weighted_quantile(std::move(weighted), 0.5);
}

}  // namespace unseen::planes
