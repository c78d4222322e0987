// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planes/levels.h"
#include "planes/neighbourhoods.h"
#include "planes/weighted.h"
#include "unseen/core/error.h"

namespace unseen::planes {
namespace {

constexpr std::size_t kProbes = 2000, kNormalProbes = 128;  // for the scale; for whether normals are usable
constexpr double kSparsest = 3.0, kFar = 2.0;               // times the typical spacing
constexpr double kSparsestSurface = 6.0;                   // the same where the points clearly are a surface:
constexpr double kEven = 0.1;                               // rms over spacing
constexpr std::size_t kFewest = 32, kMost = 128;            // neighbours of a probe
constexpr std::size_t kSurrounding = 6;                     // neighbours at least that tell the spacing
constexpr double kThread = 0.2;                             // spread across over spread along: less is one line of a scan
constexpr std::size_t kFewestOfLine = 8;                    // neighbours that tell the noise of a drawing, if their
constexpr double kThin = 0.25;                              // rms over spread is below this; a wall's other side is near
constexpr double kFlat = 0.5;                               // rms over spread of a disc
constexpr double kNoise = 4.0;                              // times the noise is a scale, and a tolerance
constexpr double kLeastTolerance = 0.5;                     // of the scale
constexpr std::size_t kWide = 512, kWideEvery = 4;          // neighbours that tell correlated noise; of every so many probes,
constexpr double kWideFlat = 0.2, kMostNoise = 0.8;         // if this flat (rms over spread); of the surface there is less noise on this share
constexpr double kExactlyFlat = 1e-3;                       // rms over spacing, of points that share a level
constexpr std::size_t kMostAxes = 8;                        // along which levels are sought
constexpr double kSameAxis = kPi / 60;                      // rad
constexpr double kAcross = 0.2, kStray = 0.01;              // of the exactly flat probes, and of all, that may face elsewhere
constexpr double kFacing = 0.1;                             // cosine of the axis and of what typical surfaces face
constexpr double kAlike = 0.3;                              // of the widest step
constexpr double kLeastStep = 0.1, kMostStep = 4.0;         // of the scale as noise has it: what lies nearer is no level; what is farther apart is real
constexpr double kSteps = 2.5;                              // that a scale must span, so that a slant is no staircase
constexpr double kThick = 0.3;                              // rms over spacing that is no surface

struct Probe {
  double spacing = 0;     ///< m, to the sixth neighbour, or as far as those reach that lie in more than one line
  PlaneFit fit;           ///< of the nearest 32 (2D: 8 or 16 in a line), or more where these are no flat disc
  bool surrounded = true; ///< false: even the last neighbour lies in one line with the others
  std::size_t index = 0;  ///< in the sample
};

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
  PlaneFit near;
  const std::size_t last = space.is_2d() ? std::min(kSurrounding, n.size() - 1)
                                         : grow(n, kSurrounding + 1, 2, space, near, [](const PlaneFit& f) { return f.spread_v > kThread * f.spread_u; });
  p.surrounded = space.is_2d() || near.spread_v > kThread * near.spread_u;
  p.spacing = (n[last] - n[0]).norm();
  const auto flat = [&](const PlaneFit& f) { return is_flat(f, space); };
  const auto thin = [](const PlaneFit& f) { return f.rms < kThin * f.spread_u; };
  const bool is_line = space.is_2d() && grow(n, kFewestOfLine, 2, space, p.fit, thin) < kFewest - 1;
  if (!is_line) grow(n, kFewest, 4, space, p.fit, flat);
  return p;
}

/// Probes of the sample; of each the nearest `most` points count.
std::vector<Probe> probe_sample(const Survey& survey, const Space& space, std::size_t count, std::size_t most,
                                const Context& context) {
  const SampleTree tree(survey);
  std::vector<Probe> probes(std::min(count, survey.sample.size()));
  parallel_blocks(context, probes.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      probes[i] = probe(tree.around(i, kFewest), i, space);
      if (most > kFewest && !(is_flat(probes[i].fit, space) && probes[i].surrounded)) probes[i] = probe(tree.around(i, most), i, space);
    }
  });
  return probes;
}

/// The same among all points of the source. Where even `most` of them are no flat disc, and where points are too sparse to be gathered, those of
/// the sample tell.
std::vector<Probe> probe_source(PointSource& source, const Survey& survey, const Space& space,
                                std::size_t count, std::size_t most, const Context& context) {
  const SampleTree tree(survey);
  const std::vector<Neighbourhood> near = neighbourhoods(source, survey, tree, count, most, context);
  std::vector<Probe> probes;
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (near[i].size() < 2) {
      probes.push_back(probe(tree.around(i, most), i, space));
      probes.back().spacing *= space.is_2d() ? survey.share : std::sqrt(survey.share);
      continue;
    }
    probes.push_back(probe(near[i], i, space));
    if (!is_flat(probes.back().fit, space)) probes.back().fit = probe(tree.around(i, 4 * most), i, space).fit;
  }
  return probes;
}

/// Median over the surface rather than over the points: a probe counts for the area (2D: length) it stands
/// for, so that a densely sampled corner does not decide for a whole scan. One whose neighbours are both far
/// and no surface is a stray point, and counts for nothing.
template <class F>
double median(const std::vector<Probe>& probes, const Space& space, F value) {
  std::vector<double> spacing;
  for (const Probe& p : probes) spacing.push_back(p.spacing);
  const auto middle = spacing.begin() + static_cast<std::ptrdiff_t>(spacing.size() / 2);
  std::nth_element(spacing.begin(), middle, spacing.end());
  std::vector<std::pair<double, double>> weighted;
  for (const Probe& p : probes) {
    const bool stray = p.spacing > kFar * *middle && p.fit.rms > kThick * p.spacing;
    const double sparsest = p.fit.rms < kEven * p.spacing ? kSparsestSurface : kSparsest;
    const double side = stray ? 0.0 : std::min(p.spacing, sparsest * *middle);
    weighted.emplace_back(value(p), space.is_2d() ? side : side * side);
  }
  return weighted_quantile(std::move(weighted), 0.5);
}

/// Noise (m) over wider neighbourhoods, of those that are flat: correlated noise, and how far scans are out of register, show only there.
double wide_noise(const Survey& survey, const Space& space, const std::vector<Probe>& probes) {
  const SampleTree tree(survey);
  std::vector<std::pair<double, double>> noise;  // by area
  for (std::size_t i = 0; i < probes.size(); i += kWideEvery) {
    const Neighbourhood n = tree.around(probes[i].index, kWide);
    Moments m;
    for (std::size_t k = 0; k < n.size(); ++k) m += Moments{1.0, n[k], Mat3::Zero()};
    const PlaneFit fit = fit_plane(m, space);
    if (fit.rms < kWideFlat * fit.spread_v) noise.emplace_back(fit.rms, probes[i].spacing * probes[i].spacing);
  }
  return noise.empty() ? std::numeric_limits<double>::infinity() : weighted_quantile(std::move(noise), kMostNoise);
}

/// Whether a probe's neighbours are flat beyond any noise.
bool is_exact(const Probe& p) { return p.surrounded && p.fit.rms < kExactlyFlat * p.spacing; }

/// Axes along which the sample may lie on levels: those of the coordinates, and normals of probes that share a level.
std::vector<Vec3> axes_of_levels(const std::vector<Probe>& probes) {
  std::vector<Vec3> axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (const Probe& p : probes) {
    const auto same = [&](const Vec3& a) { return line_angle(a, p.fit.normal) < kSameAxis; };
    if (axes.size() < kMostAxes && is_exact(p) && std::none_of(axes.begin(), axes.end(), same)) axes.push_back(p.fit.normal);
  }
  return axes;
}

/// Whether what is exactly flat faces along an axis, and the typical surface not across it: a model without noise has other faces, and
/// lines of a scan lie in the surface.
bool is_of_depth(const std::vector<Probe>& probes, const Vec3& axis, const Space& space) {
  double exact = 0, across = 0;
  for (const Probe& p : probes) {
    if (!is_exact(p)) continue;
    ++exact;
    across += line_angle(axis, p.fit.normal) > kSameAxis;
  }
  return across <= kAcross * exact + kStray * static_cast<double>(probes.size()) &&
         median(probes, space, [&](const Probe& p) { return std::abs(p.fit.normal.dot(axis)); }) > kFacing;
}

/// How far apart (m) levels are on which the sample lies, as coarse depth leaves it; 0 where it does not. Steps of like size along two axes
/// are those of a model or a lattice.
double typical_step(const Survey& survey, const Space& space, const std::vector<Probe>& probes, double scale) {
  if (space.is_2d()) return 0.0;
  double widest = 0, second = 0;
  for (const Vec3& axis : axes_of_levels(probes)) {
    const std::optional<Levels> levels = find_levels(survey.sample, axis, kLeastStep * scale);
    if (!levels || !is_of_depth(probes, axis, space)) continue;
    const double step = median(probes, space, [&](const Probe& p) { return levels->step_at(survey.sample[p.index]); });
    second = std::max(second, std::min(step, widest));
    widest = std::max(widest, step);
  }
  return second < kAlike * widest && widest < kMostStep * scale ? widest : 0.0;
}

}  // namespace

Scale choose_scale(PointSource& source, const Survey& survey, const Space& space, const Options& options,
                   Context& context) {
  const double extent = survey.extent();
  double scale = 0, tolerance = std::numeric_limits<double>::infinity();
  if (options.scale) {
    scale = *options.scale;
  } else if (options.relative_scale) {
    scale = *options.relative_scale * extent;
  } else {
    const std::vector<Probe> probes = survey.share < 1.0
                                          ? probe_source(source, survey, space, kProbes, kMost, context)
                                          : probe_sample(survey, space, kProbes, kMost, context);
    const double spacing = median(probes, space, [](const Probe& p) { return p.spacing; });
    const double noise = median(probes, space, [](const Probe& p) { return p.fit.rms; });
    scale = std::clamp(std::max(1.25 * spacing, kNoise * noise), 1e-4 * extent, 0.1 * extent);
    const double step = typical_step(survey, space, probes, scale);
    if (step == 0.0 && !space.is_2d() && kNoise * noise < scale) tolerance = std::max(kLeastTolerance * scale, kNoise * wide_noise(survey, space, probes));
    if (kSteps * step > scale) {
      scale = kSteps * step;
      context.warn(fmt::format("the points lie on levels that are about {:.2g} m apart, as coarse depth leaves them: the scale is {:.1f} times that, "
                               "and what is smaller is lost", step, kSteps));
    }
  }
  if (!(scale > 0)) throw InputError("", "scale", fmt::format("{} m", scale), "more than 0");
  if (!(scale <= extent))
    throw InputError("", "scale", fmt::format("{} m", scale),
                     fmt::format("less than the scene's extent, {:.6g} m", extent));
  return {scale, std::min(tolerance, scale)};
}

bool normals_usable(const Survey& survey, const Space& space, const Context& context) {
  if (!survey.has_normals() || 2 * survey.without_normal > survey.finite) return false;
  const std::vector<Probe> probes = probe_sample(survey, space, kNormalProbes, kFewest, context);
  return median(probes, space, [&](const Probe& p) {
           const Vec3 n = survey.sample_normals[p.index].cast<double>();
           return n.norm() > 0.5 ? line_angle(n, p.fit.normal) : kPi / 2;
         }) < radians(30.0);
}

}  // namespace unseen::planes
