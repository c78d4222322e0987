// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <nanoflann.hpp>

#include "unseen/core/error.h"

namespace unseen::planes {
namespace {

constexpr std::size_t kProbes = 2000, kNormalProbes = 500;  // for the scale; for whether normals are usable
constexpr double kSparsest = 3.0;  // times the typical spacing

struct Sample {
  const std::vector<Vec3>& points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t a) const { return points[i][a]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Sample>, Sample, 3>;

struct Probe {
  double sixth = 0;  ///< m, distance to the sixth neighbour
  PlaneFit fit;      ///< of the nearest 32
  std::size_t index = 0;
};

std::vector<Probe> probe(const Survey& survey, const Space& space, std::size_t most, const Context& context) {
  constexpr std::size_t kNeighbours = 32;
  const Sample sample{survey.sample};
  const Tree tree(3, sample, {10});
  std::vector<Probe> probes(std::min(most, survey.sample.size()));
  const std::size_t count = std::min(kNeighbours, survey.sample.size());
  parallel_blocks(context, probes.size(), 64, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> index(count);
    std::vector<double> squared(count);
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t found = tree.knnSearch(survey.sample[i].data(), count, index.data(), squared.data());
      Moments m;
      for (std::size_t k = 0; k < found; ++k) m += Moments{1.0, survey.sample[index[k]], Mat3::Zero()};
      probes[i] = {std::sqrt(squared[std::min<std::size_t>(6, found - 1)]), fit_plane(m, space), i};
    }
  });
  return probes;
}

/// Median over the surface rather than over the points: a probe counts for the area (2D: length) it stands for,
/// so that a densely sampled corner does not decide for a whole scan.
template <class F>
double median(const std::vector<Probe>& probes, const Space& space, F value) {
  std::vector<double> spacing;
  for (const Probe& p : probes) spacing.push_back(p.sixth);
  const auto middle = spacing.begin() + static_cast<std::ptrdiff_t>(spacing.size() / 2);
  std::nth_element(spacing.begin(), middle, spacing.end());
  std::vector<std::pair<double, double>> weighted;  // value, weight
  double total = 0;
  for (const Probe& p : probes) {
    const double side = std::min(p.sixth, kSparsest * *middle);  // stray points stand for nothing
    weighted.emplace_back(value(p), space.is_2d() ? side : side * side);
    total += weighted.back().second;
  }
  std::sort(weighted.begin(), weighted.end());
  double below = 0;
  for (const auto& [v, weight] : weighted)
    if ((below += weight) >= 0.5 * total) return v;
  return weighted.back().first;
}

}  // namespace

double choose_scale(const Survey& survey, const Space& space, const Options& options, const Context& context) {
  const double extent = survey.extent();
  double scale = 0;
  if (options.scale) {
    scale = *options.scale;
  } else if (options.relative_scale) {
    scale = *options.relative_scale * extent;
  } else {
    const std::vector<Probe> probes = probe(survey, space, kProbes, context);
    // Thinning a surface to a share f of its points spreads them by 1/√f, a line by 1/f.
    const double thinning = space.is_2d() ? survey.share : std::sqrt(survey.share);
    const double spacing = thinning * median(probes, space, [](const Probe& p) { return p.sixth; });
    const double noise = median(probes, space, [](const Probe& p) { return p.fit.rms; });
    scale = std::clamp(std::max(1.25 * spacing, 4.0 * noise), 1e-4 * extent, 0.1 * extent);
  }
  if (!(scale > 0))
    throw InputError("", "scale", fmt::format("{} m", scale), "more than 0");
  if (!(scale <= extent))
    throw InputError("", "scale", fmt::format("{} m", scale), fmt::format("less than the scene's extent, {:.6g} m", extent));
  return scale;
}

bool normals_usable(const Survey& survey, const Space& space, const Context& context) {
  if (!survey.has_normals() || 2 * survey.without_normal > survey.finite) return false;
  const std::vector<Probe> probes = probe(survey, space, kNormalProbes, context);
  return median(probes, space, [&](const Probe& p) {
           const Vec3 n = survey.sample_normals[p.index].cast<double>();
           return n.norm() > 0.5 ? line_angle(n, p.fit.normal) : kPi / 2;
         }) < radians(30.0);
}

}  // namespace unseen::planes
