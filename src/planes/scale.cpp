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

struct Probe {
  double sixth = 0;  ///< m, distance to the sixth neighbour
  double noise = 0;  ///< m, of the nearest 32 about their plane, whatever lies beside that
  Vec3 normal;
  bool stray = false;  ///< lies beside the surface that its neighbours lie on
};

PlaneFit fit_points(std::span<const Vec3> points, const Space& space) {
  Moments m;
  for (const Vec3& p : points) m += Moments{1.0, p, Mat3::Zero()};
  return fit_plane(m, space);
}

/// The noise is that of the four fifths of the points which are nearest to the plane, brought up to that of all
/// points of a normal distribution.
Probe probe(Neighbourhood n, const Space& space) {
  constexpr double kKept = 0.8, kAllOverKept = 1.511, kBeside = 4.0, kFarBeside = 0.25;
  const double sixth = (n[std::min<std::size_t>(6, n.size() - 1)] - n[0]).norm();
  const Vec3 itself = n[0];
  PlaneFit fit = fit_points(n, space);
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : n) mean += p / static_cast<double>(n.size());
  const auto kept = static_cast<std::size_t>(std::ceil(kKept * static_cast<double>(n.size())));
  for (int round = 0; round < 2; ++round) {
    std::sort(n.begin(), n.end(), [&](const Vec3& a, const Vec3& b) {
      return std::abs(fit.normal.dot(a - mean)) < std::abs(fit.normal.dot(b - mean));
    });
    fit = fit_points(std::span(n).first(kept), space);
    mean = Vec3::Zero();
    for (std::size_t i = 0; i < kept; ++i) mean += n[i] / static_cast<double>(kept);
  }
  const double noise = kAllOverKept * fit.rms;
  const double beside = std::abs(fit.normal.dot(itself - mean));
  return {sixth, noise, fit.normal, beside > kBeside * noise && beside > kFarBeside * sixth};
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
