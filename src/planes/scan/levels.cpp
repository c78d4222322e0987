// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/levels.h"

#include <algorithm>
#include <optional>

#include "unseen/core/quantile.h"

namespace unseen::planes {
namespace {

constexpr double kExactlyFlat = 1e-3;                       // rms over spacing, of points that share a level
constexpr std::size_t kMostAxes = 8;                        // along which levels are sought
constexpr double kSameAxis = kPi / 60;                      // rad
constexpr double kAcross = 0.2, kStray = 0.01;              // of the exactly flat probes, and of all, that may face elsewhere
constexpr double kFacing = 0.1;                             // cosine of the axis and of what typical surfaces face
constexpr double kAlike = 0.3;                              // of the widest step
constexpr double kLeastStep = 0.1, kMostStep = 4.0;         // of the scale as noise has it: what lies nearer is no level; what is farther apart is real
constexpr std::size_t kMostLookedAt = 100'000;  // points
constexpr double kApart = 0.02, kNarrow = 0.5;  // of the least step: what lies nearer shares a value; how wide such a value may be
constexpr double kPeak = 4.0;                   // times as many points as on other values nearby are a level …
constexpr double kOnLevels = 0.4;               // … if levels hold this share of the points; some sensors fill in what lies between,
constexpr std::size_t kFewestLevels = 10;       // and there are so many: fewer are floors and walls,
constexpr double kFewestOnLevel = 10;           // with so many points each;
constexpr double kUneven = 1.5;                 // of one step to the next, in the median: floors, walls and what lies between stand anywhere
constexpr double kMostOnLevel = 0.05;           // one that holds more than this share of the points is a floor and counts no more

/// Levels along an axis on which a coarsely rounded depth, or a coarse lattice, has left most of the points.
struct Levels {
  Vec3 axis;               ///< unit
  std::vector<double> at;  ///< m, ascending

  /// The first level above a point, of those that have one below them.
  std::size_t above(const Vec3& p) const {
    const auto i = std::lower_bound(at.begin(), at.end(), axis.dot(p)) - at.begin();
    return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(i, 1, static_cast<std::ptrdiff_t>(at.size()) - 1));
  }
  /// How far apart the levels are around a point (m).
  double step_at(const Vec3& p) const { return at[above(p)] - at[above(p) - 1]; }
  /// How far a point is from the nearest level (m).
  double off(const Vec3& p) const {
    const double x = axis.dot(p);
    return std::min(std::abs(at[above(p)] - x), std::abs(x - at[above(p) - 1]));
  }
};

/// Points that share a value.
struct Value {
  double low, high;
  double count = 0;
};

LargeVector<Value> values_of(const LargeVector<double>& sorted, double apart) {
  LargeVector<Value> values;
  for (const double x : sorted) {
    if (values.empty() || x - values.back().high > apart) values.push_back({x, x});
    values.back().high = x;
    ++values.back().count;
  }
  return values;
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
         weighted_median(probes, space, [&](const Probe& p) { return std::abs(p.fit.normal.dot(axis)); }) > kFacing;
}

/// Whether neighbouring steps are alike, as those of a sensor are.
bool are_even(const std::vector<double>& at) {
  std::vector<double> ratios;
  for (std::size_t i = 2; i < at.size(); ++i) {
    const double step = at[i] - at[i - 1], before = at[i - 1] - at[i - 2];
    ratios.push_back(std::max(step, before) / std::min(step, before));
  }
  return median(std::move(ratios)) < kUneven;
}

/// How far apart levels are (m), where there are points on them: the columns of a scan make levels of some walls, and what lies between is far from any.
double step_of(const Levels& levels, const LargeVector<Vec3>& points, const std::vector<Probe>& probes, double least, const Space& space) {
  std::vector<Probe> on;
  for (const Probe& p : probes)
    if (levels.off(points[p.index]) <= kNarrow * least) on.push_back(p);
  return on.empty() ? 0.0 : weighted_median(on, space, [&](const Probe& p) { return levels.step_at(points[p.index]); });
}

/// The levels of points along an axis, if much of them lie on values that stand out among those `least` (m) away and less.
std::optional<Levels> find_levels(const LargeVector<Vec3>& points, const Vec3& axis, double least) {
  const std::size_t every = points.size() / kMostLookedAt + 1;
  LargeVector<double> along;
  along.reserve(points.size() / every + 1);
  for (std::size_t i = 0; i < points.size(); i += every) along.push_back(axis.dot(points[i]));
  std::sort(along.begin(), along.end());
  const LargeVector<Value> values = values_of(along, kApart * least);
  Levels levels{axis, {}};
  const double most = kMostOnLevel * static_cast<double>(along.size());
  double on_levels = 0, beside = 0;
  double nearby = 0;  // points on values that are no more than the least step away
  std::size_t first = 0, end = 0;
  for (const Value& v : values) {
    while (end < values.size() && values[end].low - v.high <= least) nearby += values[end++].count;
    while (v.low - values[first].high > least) nearby -= values[first++].count;
    const double others = static_cast<double>(end - first) - 1;
    if (v.count < kFewestOnLevel || v.high - v.low > kNarrow * least || v.count * others < kPeak * (nearby - v.count)) {
      beside += v.count;
      continue;
    }
    levels.at.push_back(0.5 * (v.low + v.high));
    on_levels += std::min(v.count, most);
  }
  if (levels.at.size() < kFewestLevels || on_levels < kOnLevels * (on_levels + beside) || !are_even(levels.at)) return std::nullopt;
  return levels;
}

}  // namespace

double step_of_levels(const Survey& survey, const Space& space, const std::vector<Probe>& probes, double scale, const Context& context) {
  if (space.is_2d()) return 0.0;
  const std::vector<Vec3> axes = axes_of_levels(probes);
  std::vector<double> steps(axes.size(), 0.0);
  parallel_blocks(context, axes.size(), 1, [&](std::size_t a, std::size_t) {
    const double least = kLeastStep * scale;
    const std::optional<Levels> levels = find_levels(survey.sample, axes[a], least);
    if (levels && is_of_depth(probes, axes[a], space)) steps[a] = step_of(*levels, survey.sample, probes, least, space);
  });
  double widest = 0, second = 0;
  for (const double step : steps) {
    second = std::max(second, std::min(step, widest));
    widest = std::max(widest, step);
  }
  return second < kAlike * widest && widest < kMostStep * scale ? widest : 0.0;
}

}  // namespace unseen::planes
