// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/probes.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "planes/scan/sample_slabs.h"
#include "unseen/core/quantile.h"

namespace unseen::planes {
namespace {

constexpr double kSparsest = 3.0, kFar = 2.0;               // times the typical spacing
constexpr double kSparsestSurface = 6.0;                   // the same where the points clearly are a surface:
constexpr double kEven = 0.1;                               // rms over spacing
constexpr double kThick = 0.3;                              // rms over spacing that is no surface
constexpr std::size_t kSurrounding = 6;                     // neighbours at least that tell the spacing
constexpr double kThread = 0.2;                             // spread across over spread along: less is one line of a scan
constexpr double kAcrossSurface = kPi / 3;                  // rad, from the surface: a line and its noise are a disc of their own
constexpr double kBeyond = 1.4;                             // times as far as where they are no more
constexpr std::size_t kFewestOfLine = 8;                    // neighbours that tell the noise of a drawing, if their
constexpr double kThin = 0.25;                              // rms over spread is below this; a wall's other side is near
constexpr double kFlat = 0.5;                               // rms over spread of a disc

bool is_flat(const PlaneFit& fit, const Space& space) {
  return fit.rms < kFlat * (space.is_2d() ? fit.spread_u : fit.spread_v);
}

/// The first of the neighbours' numbers `first`, `times` as many, … whose fit `suits`, or all of them; the fit comes with it.
template <class Suits>
std::size_t grow(const Neighbourhood& n, std::size_t first, std::size_t times, const Space& space, PlaneFit& fit, Suits suits) {
  Moments m;
  std::size_t next = first;
  for (std::size_t i = 0; i < n.size(); ++i) {
    m += Moments{1.0, n[i], Mat3::Zero()};
    if (i + 1 < std::min(next, n.size())) continue;
    fit = fit_plane(m, space);
    if (suits(fit)) return i;
    next *= times;
  }
  return n.size() - 1;
}

/// Where noise exceeds the spacing, the nearest points show no more of it than they are far; where a scan's lines are farther apart than its
/// points in them, the nearest points show one line.
Probe probe(const Neighbourhood& n, std::size_t index, const Space& space) {
  Probe p;
  p.index = index;
  const auto flat = [&](const PlaneFit& f) { return is_flat(f, space); };
  const auto thin = [](const PlaneFit& f) { return f.rms < kThin * f.spread_u; };
  const bool is_line = space.is_2d() && grow(n, kFewestOfLine, 2, space, p.fit, thin) < kFewestNeighbours - 1;
  if (!is_line) grow(n, kFewestNeighbours, 4, space, p.fit, flat);
  PlaneFit near;
  const auto wide = [](const PlaneFit& f) { return f.spread_v > kThread * f.spread_u; };
  std::size_t last = space.is_2d() ? std::min(kSurrounding, n.size() - 1) : grow(n, kSurrounding + 1, 2, space, near, wide);
  p.surrounded = space.is_2d() || wide(near);
  p.spacing = p.reach = (n[last] - n[0]).norm();
  if (space.is_2d() || !p.surrounded || line_angle(near.normal, p.fit.normal) < kAcrossSurface) return p;
  last = grow(n, last + 2, 2, space, near, [&](const PlaneFit& f) { return wide(f) && line_angle(f.normal, p.fit.normal) < kAcrossSurface; });
  p.reach = kBeyond * (n[last] - n[0]).norm();
  return p;
}

}  // namespace

std::vector<Probe> probe_sample(const Survey& survey, const SampleTree& tree, const Space& space, std::size_t count, std::size_t most,
                                const Context& context) {
  std::vector<Probe> probes(std::min(count, survey.sample.size()));
  parallel_blocks(context, probes.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      probes[i] = probe(tree.around(i, kFewestNeighbours), i, space);
      if (!(is_flat(probes[i].fit, space) && probes[i].surrounded)) probes[i] = probe(tree.around(i, most), i, space);
    }
  });
  return probes;
}

std::vector<Probe> probe_few(const Survey& survey, const Space& space, std::size_t count, const Context& context) {
  const SampleSlabs slabs(survey);
  std::vector<Probe> probes(std::min(count, survey.sample.size()));
  parallel_blocks(context, probes.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) probes[i] = probe(slabs.around(i, kFewestNeighbours), i, space);
  });
  return probes;
}

std::vector<Probe> probe_source(PointSource& source, const Survey& survey, const SampleTree& tree, const Space& space,
                                std::size_t count, std::size_t most, const Context& context) {
  const std::vector<Neighbourhood> near = neighbourhoods(source, survey, tree, count, most, context);
  std::vector<Probe> probes;
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (near[i].size() < 2) {
      probes.push_back(probe(tree.around(i, most), i, space));
      for (double* length : {&probes.back().spacing, &probes.back().reach}) *length *= space.is_2d() ? survey.share : std::sqrt(survey.share);
      continue;
    }
    probes.push_back(probe(near[i], i, space));
    if (!is_flat(probes.back().fit, space)) probes.back().fit = probe(tree.around(i, 4 * most), i, space).fit;
  }
  return probes;
}

std::vector<Probe> flat_ones(const std::vector<Probe>& probes, const Space& space) {
  std::vector<Probe> flat;
  std::copy_if(probes.begin(), probes.end(), std::back_inserter(flat), [&](const Probe& p) { return is_flat(p.fit, space); });
  return flat;
}

std::vector<double> weights_of(const std::vector<Probe>& probes, const Space& space) {
  std::vector<double> spacing;
  for (const Probe& p : probes) spacing.push_back(p.spacing);
  const double usual = median(std::move(spacing));
  std::vector<double> weights;
  for (const Probe& p : probes) {
    const bool stray = p.spacing > kFar * usual && p.fit.rms > kThick * p.spacing;
    const double sparsest = p.fit.rms < kEven * p.spacing ? kSparsestSurface : kSparsest;
    const double side = stray ? 0.0 : std::min(p.spacing, sparsest * usual);
    weights.push_back(space.is_2d() ? side : side * side);
  }
  return weights;
}

}  // namespace unseen::planes
