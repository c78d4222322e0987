// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <limits>

#include "planes/arrange.h"

namespace unseen::planes {
namespace {

constexpr double kCarriedAway = 0.1;  // of the tolerance: how far points one standard deviation from the centre may be turned off, and no less than the rms of
                                      // the surface's own fit, which is what it is not flat by
constexpr double kPlain = 0.7 * kPi / 180.0, kRougher = 3.0;  // a surface that is turned by more may be off by so many times the rms of its own fit only, where the scale is coarse;
constexpr double kProven = 4.0;    // times the χ² from which that is certain (by default ten standard errors): by no more than that rms
constexpr double kHalf = 0.5;      // where it is turned by less than kPlain and that is proven: of what may be carried, or kRougher times the rms if that is more
constexpr double kHides = 0.5;     // of that rms: together with others, what is turned off its points by more would hide it
constexpr double kOneDirection = 0.03;  // of the tolerance: the same for surfaces set free that share a direction

/// How far (m) a plane of this normal turns off the points of a patch one standard deviation from its centre; 0 where noise may explain it.
double turned_off(const Model& model, const Patch& patch, const Vec3& n) {
  const PlaneFit& fit = patch.fit;
  if (noise_chi2(patch, n) < model.certain) return 0.0;
  const double across = std::max(std::abs(n.dot(fit.normal)), 1e-9), u = n.dot(fit.u) / across, v = n.dot(fit.v) / across;
  return std::hypot(u * fit.spread_u, v * fit.spread_v);
}

/// How far points may be turned off (m), infinite where a surface is not set free at all: lines that are turned by little, whose rms is the width of the stroke.
double most_turned_off(const Model& model, const Surface& surface, double tolerance, const Space& space) {
  const PlaneFit& fit = surface.support.fit;
  const Vec3 n = model.normal(surface);
  const bool plain = line_angle(n, fit.normal) > kPlain, proven = noise_chi2(surface.support, n) > kProven * model.certain;
  if (space.is_2d()) return plain ? kHides * fit.rms : std::numeric_limits<double>::infinity();
  const double carried = std::max(fit.rms, kCarriedAway * tolerance), rougher = std::min(carried, kRougher * fit.rms);
  if (plain) return proven ? fit.rms : rougher;
  return proven ? std::max(rougher, kHalf * carried) : carried;
}

}  // namespace

bool is_turned_out(const Model& model, const Patch& patch, const Vec3& n) { return turned_off(model, patch, n) > kHides * patch.fit.rms; }

void refit_held(Model& model, double tolerance, const Space& space) {
  const std::size_t shared = model.frames.size();
  for (std::size_t round = 0; round <= model.surfaces.size(); ++round) {
    refit(model);
    Surface* farthest = nullptr;
    double most = 0;
    for (Surface& s : model.surfaces)
      if (const double off = turned_off(model, s.support, model.normal(s)); s.frame < static_cast<int>(shared) && off > std::max(most, most_turned_off(model, s, tolerance, space)))
        most = off, farthest = &s;
    if (farthest == nullptr) return;
    farthest->local = 0;
    farthest->frame = static_cast<int>(shared);
    while (farthest->frame < static_cast<int>(model.frames.size()) && turned_off(model, farthest->support, model.normal(*farthest)) > kOneDirection * tolerance) ++farthest->frame;
    if (farthest->frame == static_cast<int>(model.frames.size())) model.frames.push_back(open_frame(farthest->support.fit.normal, space));
  }
}

}  // namespace unseen::planes
