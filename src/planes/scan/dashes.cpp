// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/dashes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planes/scan/moments.h"
#include "planes/scan/voxel_builder.h"
#include "unseen/core/quantile.h"

namespace unseen::planes {
namespace {

constexpr double kTouching = 0.8;                     // of the points have one within a step of the raster: pixels, not scans whose coordinates are rounded
constexpr std::size_t kLookedAt = 5000;                 // of the points
constexpr double kElongated = 2.0;                     // times as long as wide is a dash
constexpr double kTowards = 15.0 * kPi / 180.0;         // of the next dash, and of the way to it: short ones in pixels know their direction no better
constexpr double kDashed = 0.5;                          // of the points are in dashes that another continues
constexpr std::size_t kFewestDashes = 12;                    // such dashes
constexpr double kWidest = 0.8;                        // of the gaps are no wider
constexpr std::size_t kMostDashes = 5000;              // to look for the next one of each

struct Dash {
  Vec3 middle, along;  ///< unit
  double length = 0;   ///< m
  double points = 0;
};

/// Pixels of a drawing.
struct Pixels {
  KeyTable table;
  std::vector<Vec3> place;
  int flat = 2;  ///< the axis along which a drawing has no extent

  Pixels(const Survey& survey, const Space& space, double width) {
    space.flat_axis->cwiseAbs().maxCoeff(&flat);
    table.reserve(survey.sample.size());
    place.reserve(survey.sample.size());
    for (const Vec3& p : survey.sample) {
      const Eigen::Array3d at = ((p - survey.low) / width).array().round();
      if (table.insert({static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z())}) == place.size()) place.push_back(p);
    }
  }

  /// Calls `visit` with the index of each pixel that touches this one, corners included.
  template <class Visit>
  void neighbours(std::size_t pixel, Visit visit) const {
    for (int n = 0; n < 9; ++n) {
      if (n == 4) continue;
      VoxelKey key = table.keys()[pixel];
      key[(flat + 1) % 3] += n % 3 - 1;
      key[(flat + 2) % 3] += n / 3 - 1;
      if (const int next = table.find(key); next >= 0) visit(static_cast<std::size_t>(next));
    }
  }
};

/// Sets of pixels that touch.
std::vector<Moments> strokes_of(const Pixels& pixels) {
  std::vector<char> seen(pixels.place.size(), 0);
  std::vector<Moments> strokes;
  std::vector<std::size_t> open;
  for (std::size_t start = 0; start < seen.size(); ++start) {
    if (seen[start]) continue;
    seen[start] = 1;
    open = {start};
    Moments stroke;
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      stroke += Moments{1.0, pixels.place[at], Mat3::Zero()};
      pixels.neighbours(at, [&](std::size_t next) {
        if (!seen[next]) seen[next] = 1, open.push_back(next);
      });
    }
    strokes.push_back(stroke);
  }
  return strokes;
}

std::vector<Dash> dashes_of(const std::vector<Moments>& strokes, const Space& space) {
  constexpr double kPoints = 4;
  std::vector<Dash> dashes;
  for (const Moments& stroke : strokes) {
    if (stroke.count < kPoints) continue;
    const PlaneFit fit = fit_plane(stroke, space);
    const Vec3 along = fit.normal.cross(*space.flat_axis).normalized();
    const double length = std::sqrt(12.0 * along.dot(stroke.scatter * along) / stroke.count);
    if (length > kElongated * std::sqrt(12.0) * fit.rms) dashes.push_back({stroke.mean, along, length, stroke.count});
  }
  return dashes;
}

/// The gap (m) to the nearest dash that goes on in this direction; infinite if there is none.
double gap_to_next(const std::vector<Dash>& dashes, const Dash& dash, const Vec3& ahead, double farthest) {
  double gap = std::numeric_limits<double>::infinity();
  for (const Dash& next : dashes) {
    const Vec3 way = next.middle - dash.middle;
    const double far = way.norm(), between = far - 0.5 * (dash.length + next.length);
    if (&next == &dash || between > std::min({gap, dash.length, next.length, farthest}) || between < 0.0) continue;
    if (way.dot(ahead) > std::cos(kTowards) * far && std::abs(next.along.dot(dash.along)) > std::cos(kTowards)) gap = between;
  }
  return gap;
}

}  // namespace

double pixel_of(const Survey& survey, const Space& space, double raster) {
  if (!space.is_2d() || raster == 0.0 || survey.share < 1.0) return 0.0;
  const Pixels pixels(survey, space, raster);
  const std::size_t stride = 1 + pixels.place.size() / kLookedAt;
  std::size_t touching = 0, all = 0;
  for (std::size_t i = 0; i < pixels.place.size(); i += stride, ++all) {
    bool touches = false;
    pixels.neighbours(i, [&](std::size_t) { touches = true; });
    touching += touches;
  }
  return static_cast<double>(touching) > kTouching * static_cast<double>(all) ? raster : 0.0;
}

double gap_of_dashes(const Survey& survey, const Space& space, double pixel, double farthest) {
  const std::vector<Dash> dashes = dashes_of(strokes_of(Pixels(survey, space, pixel)), space);
  if (dashes.size() < kFewestDashes || dashes.size() > kMostDashes) return 0.0;
  std::vector<double> gaps;
  double points = 0;
  for (const Dash& dash : dashes) {
    const double before = gap_to_next(dashes, dash, -dash.along, farthest), after = gap_to_next(dashes, dash, dash.along, farthest);
    if (!std::isfinite(std::min(before, after))) continue;
    points += dash.points;
    gaps.push_back(std::isfinite(std::max(before, after)) ? std::max(before, after) : std::min(before, after));
  }
  if (gaps.size() < kFewestDashes || points < kDashed * static_cast<double>(survey.sample.size())) return 0.0;
  return quantile(std::move(gaps), kWidest) + pixel;
}

}  // namespace unseen::planes
