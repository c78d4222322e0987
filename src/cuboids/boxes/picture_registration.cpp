// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/boxes/picture_registration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr double kLargestShift = 8.0;   // pixels
constexpr double kShiftCost = 0.04;     // pixels of mean distance a pixel of shift has to gain
constexpr double kMostRegistered = 2.0; // pixels of mean distance
constexpr double kFarFromEdge = 6.0;    // pixels: what is farther counts as so far
constexpr double kLeastScale = 0.9, kScaleStep = 0.01;
constexpr int kScaleSteps = 10, kShiftSteps = 8, kAxisTurns = 3;
constexpr double kRegistrationSteps[] = {1.0, 0.25};  // pixels of shift, and hundredths of scale
constexpr double kScaleGain = 0.85;     // of the mean distance, that another scale may leave …
constexpr double kClearGain = 0.7;      // … however little all parts of the picture agree
constexpr double kFits = 1.2;           // pixels of mean distance, at which nothing is off
constexpr std::size_t kMostScalePixels = 500;
constexpr std::size_t kFewestCreases = 30;

/// Pixels: mean distance to the picture's edges.
double distance(const ImageEdges& edges, const std::vector<Vec2>& pixels, const PictureRegistration& r) {
  double sum = 0;
  for (const Vec2& p : pixels) sum += std::min(edges.distance(r.to_picture(p)), kFarFromEdge);
  return sum / static_cast<double>(pixels.size());
}

/// The same, and what the shift costs.
double cost(const ImageEdges& edges, const std::vector<Vec2>& pixels, const PictureRegistration& r) { return distance(edges, pixels, r) + kShiftCost * r.shift.norm(); }

PictureRegistration shifted(const ImageEdges& edges, const std::vector<Vec2>& pixels, PictureRegistration r) {
  PictureRegistration best = r;
  double least = std::numeric_limits<double>::infinity();
  for (double dv = -kLargestShift; dv <= kLargestShift; ++dv)
    for (double du = -kLargestShift; du <= kLargestShift; ++du) {
      r.shift = {du, dv};
      if (const double c = cost(edges, pixels, r); c < least) least = c, best = r;
    }
  return best;
}

/// Scales and shifts, across and down in turns, in ever finer steps. A picture of larger scale looks like depth that falls short all round, and is not believed.
PictureRegistration scaled(const ImageEdges& edges, const std::vector<Vec2>& pixels, PictureRegistration best) {
  double least = cost(edges, pixels, best);
  for (const double step : kRegistrationSteps)
    for (int turn = 0; turn < 2 * kAxisTurns; ++turn) {
      const PictureRegistration from = best;
      PictureRegistration r = best;
      for (int k = -kScaleSteps; k <= kScaleSteps; ++k)
        for (int m = -kShiftSteps; m <= kShiftSteps; ++m) {
          r.scale[turn % 2] = from.scale[turn % 2] + kScaleStep * step * k;
          r.shift[turn % 2] = from.shift[turn % 2] + step * m;
          if (r.scale[turn % 2] > 1.0 || r.scale[turn % 2] < kLeastScale || std::abs(r.shift[turn % 2]) > kLargestShift) continue;
          if (const double c = cost(edges, pixels, r); c < least) least = c, best = r;
        }
    }
  return best;
}

/// Whether one registration leaves less than another in each quarter of the pixels: what but one thing asks for is no scale.
bool better_in_quarters(const ImageEdges& edges, const std::vector<Vec2>& pixels, const PictureRegistration& better, const PictureRegistration& than) {
  std::vector<double> x, y;
  for (const Vec2& p : pixels) x.push_back(p.x()), y.push_back(p.y());
  const Vec2 middle(median(std::move(x)), median(std::move(y)));
  std::array<std::vector<Vec2>, 4> quarters;
  for (const Vec2& p : pixels) quarters[(p.x() < middle.x()) + 2 * (p.y() < middle.y())].push_back(p);
  return std::all_of(quarters.begin(), quarters.end(), [&](const std::vector<Vec2>& quarter) {
    return quarter.empty() || distance(edges, quarter, better) < distance(edges, quarter, than);
  });
}

/// Whether a picture of another scale fits so much better than one that is shifted, and does not fit as it is.
bool is_scaled(const ImageEdges& edges, const std::vector<Vec2>& pixels, const PictureRegistration& stretched, const PictureRegistration& moved) {
  const double left = cost(edges, pixels, stretched), shifted = cost(edges, pixels, moved);
  if (shifted < kFits || left > kScaleGain * shifted) return false;
  return left < kClearGain * shifted || better_in_quarters(edges, pixels, stretched, moved);
}

}  // namespace

PictureRegistration register_picture(const ImageEdges& edges, const std::vector<Vec2>& creases, const std::vector<Vec2>& all, const Vec2& center) {
  const PictureRegistration as_it_is{center};
  if (creases.size() < kFewestCreases) return as_it_is;
  std::vector<Vec2> some;
  for (std::size_t k = 0; k < all.size(); k += all.size() / kMostScalePixels + 1) some.push_back(all[k]);
  const PictureRegistration moved = shifted(edges, some, as_it_is), stretched = scaled(edges, some, moved);
  if (is_scaled(edges, some, stretched, moved)) return stretched;
  const PictureRegistration on_creases = shifted(edges, creases, as_it_is);
  // Faint creases are in no picture's edges; then there is nothing to register.
  return cost(edges, creases, on_creases) < kMostRegistered ? on_creases : as_it_is;
}

}  // namespace unseen::cuboids
