// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "planes/arrange.h"

namespace unseen::planes {
namespace {

constexpr double kCarriedAway = 0.1;  // of the tolerance: how far points one standard deviation from the centre may be turned off, and no less than the rms of
                                      // the surface's own fit, which is what it is not flat by
constexpr double kPlain = 0.7 * kPi / 180.0, kRougher = 3.0;  // a surface that is turned by more may be off by so many times the rms of its own fit only, where the scale is coarse;
constexpr double kProven = 100.0;  // χ² by its noise, ten standard errors: by no more than that rms
constexpr double kHides = 0.5;     // of that rms: together with others, what is turned off its points by more would hide it
constexpr double kOneDirection = 0.03;  // of the tolerance: the same for surfaces set free that share a direction

/// How far (m) a plane of this normal turns off the points of a patch one standard deviation from its centre; 0 where noise may explain it.
double turned_off(const Patch& patch, const Vec3& n) {
  const PlaneFit& fit = patch.fit;
  if (noise_chi2(patch, n) < kCertain) return 0.0;
  const double across = std::max(std::abs(n.dot(fit.normal)), 1e-9), u = n.dot(fit.u) / across, v = n.dot(fit.v) / across;
  return std::hypot(u * fit.spread_u, v * fit.spread_v);
}

/// How far points may be turned off (m).
double most_turned_off(const Surface& surface, const Vec3& n, double tolerance) {
  const PlaneFit& fit = surface.support.fit;
  const double carried = kCarriedAway * tolerance;
  if (line_angle(n, fit.normal) < kPlain) return std::max(fit.rms, carried);
  return noise_chi2(surface.support, n) > kProven ? fit.rms : std::max(fit.rms, std::min(carried, kRougher * fit.rms));
}

}  // namespace

bool is_turned_out(const Patch& patch, const Vec3& n) { return turned_off(patch, n) > kHides * patch.fit.rms; }

void refit_held(Model& model, double tolerance, const Space& space) {
  const std::size_t shared = model.frames.size();
  for (std::size_t round = 0; round <= model.surfaces.size(); ++round) {
    refit(model);
    if (space.is_2d()) return;
    Surface* farthest = nullptr;
    double most = 0;
    for (Surface& s : model.surfaces)
      if (const double off = turned_off(s.support, model.normal(s)); s.frame < static_cast<int>(shared) && off > std::max(most, most_turned_off(s, model.normal(s), tolerance)))
        most = off, farthest = &s;
    if (farthest == nullptr) return;
    farthest->local = 0;
    farthest->frame = static_cast<int>(shared);
    while (farthest->frame < static_cast<int>(model.frames.size()) && turned_off(farthest->support, model.normal(*farthest)) > kOneDirection * tolerance) ++farthest->frame;
    if (farthest->frame == static_cast<int>(model.frames.size())) model.frames.push_back(open_frame(farthest->support.fit.normal, space));
  }
}

}  // namespace unseen::planes
