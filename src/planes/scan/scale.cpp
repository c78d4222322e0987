// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "planes/scan/dashes.h"
#include "planes/scan/levels.h"
#include "planes/scan/probes.h"
#include "unseen/core/error.h"

namespace unseen::planes {
namespace {

constexpr std::size_t kProbes = 2000, kNormalProbes = 128;  // for the scale; for whether normals are usable
constexpr double kSpacing = 1.25, kNoise = 4.0;             // times the spacing or the noise is a scale; times the noise a tolerance
constexpr double kPlants = 2.0, kFewestFlat = 0.05;         // times as large a scale is made by what is not flat, if so many probes are: plants
constexpr double kLines = 0.2;                              // of the probes, whose nearest are a line and its noise: those of a scan are
constexpr double kLeastTolerance = 0.5;                     // of the scale
constexpr std::size_t kWide = 512, kWideEvery = 4;          // neighbours that tell correlated noise; of every so many probes,
constexpr double kWideFlat = 0.2, kMostNoise = 0.8;         // if this flat (rms over spread); of the surface there is less noise on this share
constexpr double kFarthestDash = 6.0;                       // scales between dashes of a line
constexpr double kStepsSpanned = 2.5;                              // that a scale must span, so that a slant is no staircase

/// Noise (m) over wider neighbourhoods, of those that are flat: correlated noise, and how far scans are out of register, show only there.
double wide_noise(const SampleTree& tree, const Space& space, const std::vector<Probe>& probes, const Context& context) {
  std::vector<PlaneFit> fits((probes.size() + kWideEvery - 1) / kWideEvery);
  parallel_blocks(context, fits.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Moments m;
      for (const Vec3& p : tree.around(probes[i * kWideEvery].index, kWide)) m += Moments{1.0, p, Mat3::Zero()};
      fits[i] = fit_plane(m, space);
    }
  });
  std::vector<std::pair<double, double>> noise;  // by area
  for (std::size_t i = 0; i < fits.size(); ++i)
    if (fits[i].rms < kWideFlat * fits[i].spread_v) noise.emplace_back(fits[i].rms, std::pow(probes[i * kWideEvery].spacing, 2));
  return noise.empty() ? std::numeric_limits<double>::infinity() : weighted_quantile(std::move(noise), kMostNoise);
}

double noise_of(const std::vector<Probe>& probes, const Space& space) {
  return weighted_median(probes, space, [](const Probe& p) { return p.fit.rms; });
}

/// The scale (m) that spacing and noise ask for.
double scale_by(const std::vector<Probe>& probes, const Space& space) {
  const double spacing = weighted_median(probes, space, [](const Probe& p) { return p.spacing; });
  return std::max(kSpacing * spacing, kNoise * noise_of(probes, space));
}

}  // namespace

Scale estimate_scale(PointSource& source, const Survey& survey, const Space& space, Context& context, double pixel) {
  const SampleTree tree(survey);
  std::vector<Probe> probes = survey.share < 1.0 ? probe_source(source, survey, tree, space, kProbes, kMostNeighbours, context)
                                                 : probe_sample(survey, tree, space, kProbes, kMostNeighbours, context);
  const auto lines = std::count_if(probes.begin(), probes.end(), [](const Probe& p) { return p.reach > p.spacing; });
  if (static_cast<double>(lines) > kLines * static_cast<double>(probes.size()))
    for (Probe& p : probes) p.spacing = p.reach;
  if (!space.is_2d())
    if (std::vector<Probe> flat = flat_ones(probes, space);
        static_cast<double>(flat.size()) > kFewestFlat * static_cast<double>(probes.size()) && kPlants * scale_by(flat, space) < scale_by(probes, space))
      probes = std::move(flat);
  const double noise = noise_of(probes, space), scale = std::clamp(scale_by(probes, space), 1e-4 * survey.extent(), 0.1 * survey.extent());
  const double levels = step_of_levels(survey, space, probes, scale, context), step = std::max(levels, source.info().rounding);
  Scale result{scale, scale};
  if (levels == 0.0 && !space.is_2d() && kNoise * noise < scale)
    result.tolerance = std::min(scale, std::max(kLeastTolerance * scale, kNoise * wide_noise(tree, space, probes, context)));
  if (kStepsSpanned * step > scale) result = {kStepsSpanned * step, kStepsSpanned * step, step};
  if (pixel > 0.0)
    if (const double gap = gap_of_dashes(survey, space, pixel, kFarthestDash * scale); kSpacing * gap > scale) result = {kSpacing * gap, kSpacing * gap, 0.0, gap};
  return result;
}

Scale choose_scale(PointSource& source, const Survey& survey, const Space& space, const Options& options,
                   Context& context, double pixel) {
  const double extent = survey.extent();
  Scale scale;
  if (options.scale) {
    scale = {*options.scale, *options.scale};
  } else if (options.relative_scale) {
    scale = {*options.relative_scale * extent, *options.relative_scale * extent};
  } else {
    scale = estimate_scale(source, survey, space, context, pixel);
    if (scale.step > 0.0)
      context.warn(fmt::format("the points lie on levels that are about {:.2g} m apart, as coarse depth leaves them: the scale is {:.1f} times that, "
                               "and what is smaller is lost", scale.step, kStepsSpanned));
    if (scale.gap > 0.0) context.warn(fmt::format("most lines are dashed: the scale spans their gaps of {:.2g}, and lines that are nearer to each other may become one", scale.gap));
  }
  if (!(scale.scale > 0)) throw InputError("", "scale", fmt::format("{} m", scale.scale), "more than 0");
  if (!(scale.scale <= extent))
    throw InputError("", "scale", fmt::format("{} m", scale.scale),
                     fmt::format("less than the scene's extent, {:.6g} m", extent));
  return scale;
}

bool normals_usable(const Survey& survey, const Space& space, const Context& context) {
  if (!survey.has_normals() || 2 * survey.without_normal > survey.finite) return false;
  const std::vector<Probe> probes = probe_few(survey, space, kNormalProbes, context);
  return weighted_median(probes, space, [&](const Probe& p) {
           const Vec3 n = survey.sample_normals[p.index].cast<double>();
           return n.norm() > 0.5 ? line_angle(n, p.fit.normal) : kPi / 2;
         }) < radians(30.0);
}

}  // namespace unseen::planes
