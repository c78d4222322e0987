// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/candidates.h"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <optional>

#include "collision/tracks/disc.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr double kColorSpread = 22.0;   // grey levels
constexpr double kSizeSpread = 0.22;    // of the logarithm of the diameter
constexpr double kCap = 16.0;           // σ²
constexpr std::size_t kMostCandidates = 30;       // candidates a frame, the largest
constexpr double kLargestShare = 0.15;  // of the picture
constexpr double kCaster = 0.3;         // of a shadow's area: what casts it has more

/// The pixel without lens distortion.
Vec2 undistorted(const Vec2& pixel, const ShotCamera& camera) {
  if (std::all_of(camera.distortion.begin(), camera.distortion.end(), [](double k) { return k == 0.0; })) return pixel;
  const Camera& c = camera.camera;
  const cv::Matx33d k(c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1);
  const std::vector<double> distortion(camera.distortion.begin(), camera.distortion.end());
  std::vector<cv::Point2d> from{{pixel.x(), pixel.y()}}, to;
  cv::undistortPoints(from, to, k, distortion, cv::noArray(), k);
  return {to[0].x, to[0].y};
}

/// Where a ball's centre projects to, from the middle of its outline: an ellipse that reaches farther out. With tan a = radius over
/// depth, the middle is 1 / (1 − tan² a) times as far from the principal point.
Vec2 projected_center(const Vec2& middle, double diameter, const Camera& camera) {
  const double tangent = 0.5 * diameter / std::sqrt(camera.fx * camera.fy);
  const Vec2 principal(camera.cx, camera.cy);
  return principal + (1.0 - tangent * tangent) * (middle - principal);
}

/// Diameters of the regions that are discs, ascending.
std::vector<double> whole_discs(const Footage& footage) {
  std::vector<double> diameters;
  for (const auto& frame : footage.regions)
    for (const Region& r : frame)
      if (is_disc(r)) diameters.push_back(2.0 * std::sqrt(r.area / kPi));
  std::sort(diameters.begin(), diameters.end());
  return diameters;
}

/// Whether the region is a shadow rather than a body.
bool is_shadow(const Region& region, const std::vector<Region>& frame, DarkBodies dark) {
  if (!region.shadow || region.sign == ShadowSign::texture) return region.shadow;
  const bool light = region.sign == ShadowSign::light, all = dark == DarkBodies::all;
  const bool cast = std::any_of(frame.begin(), frame.end(), [&](const Region& r) { return !r.shadow && r.area > kCaster * region.area; });
  return light ? cast && !all : cast || !all;
}

}  // namespace

Candidates candidates_of(const Footage& footage, const ShotCamera& camera, bool spheres, DarkBodies dark) {
  Candidates candidates(footage.regions.size());
  const double largest = kLargestShare * footage.width * footage.height;
  const std::vector<double> wholes = spheres ? whole_discs(footage) : std::vector<double>();
  for (std::size_t k = 0; k < footage.regions.size(); ++k) {
    if (footage.doubled[k]) continue;
    for (std::size_t i = 0; i < footage.regions[k].size() && candidates[k].size() < kMostCandidates; ++i) {
      const Region& r = footage.regions[k][i];
      if (r.area > largest) continue;
      Candidate c;
      c.frame = static_cast<int>(k);
      c.u = footage.times[k] * footage.fps;
      const std::optional<Disc> disc = spheres ? covered_disc(r, wholes) : std::nullopt;
      c.pixel = undistorted(disc ? disc->center : r.centroid, camera);
      if (!footage.shift.empty()) {
        const cv::Mat& m = footage.shift[k];
        c.pixel = {m.at<double>(0, 0) * c.pixel.x() + m.at<double>(0, 1) * c.pixel.y() + m.at<double>(0, 2),
                   m.at<double>(1, 0) * c.pixel.x() + m.at<double>(1, 1) * c.pixel.y() + m.at<double>(1, 2)};
      }
      c.diameter = disc ? disc->diameter : spheres ? r.diameter : 2.0 * std::sqrt(r.area / kPi);
      if (spheres) c.pixel = projected_center(c.pixel, c.diameter, camera.camera);
      c.area = disc ? 0.25 * kPi * disc->diameter * disc->diameter : r.area;
      if (spheres && !disc) c.round = std::min(1.0, r.diameter / r.circle);
      c.color = r.color;
      c.colored = true;
      c.whole = !r.at_border && (spheres ? !r.covered || disc || is_nearly_whole(r) : !r.clipped);
      c.shadow = is_shadow(r, footage.regions[k], dark);
      c.region = static_cast<int>(i);
      candidates[k].push_back(c);
    }
  }
  return candidates;
}

Candidates candidates_of(const std::vector<Sighting>& sightings, const ShotCamera& camera) {
  int last = -1;
  for (const Sighting& s : sightings) last = std::max(last, s.frame);
  Candidates candidates(static_cast<std::size_t>(last + 1));
  for (const Sighting& s : sightings) {
    if (s.frame < 0) continue;
    Candidate c;
    c.frame = s.frame;
    c.u = s.frame;
    c.pixel = undistorted(s.pixel, camera);
    c.diameter = 2.0 * s.radius;
    c.area = kPi * s.radius * s.radius;
    c.body = s.body;
    candidates[static_cast<std::size_t>(s.frame)].push_back(c);
  }
  return candidates;
}

std::vector<Candidate> sightings_of(const Candidates& candidates, int body) {
  std::vector<Candidate> all;
  for (const auto& frame : candidates)
    for (const Candidate& c : frame) {
      if (c.body >= 0 && c.body != body) continue;
      if (!all.empty() && all.back().frame == c.frame) return {};
      all.push_back(c);
    }
  return all;
}

Vec2 off_any_flight(const std::array<const Candidate*, 4>& seen) {
  Vec2 sum = Vec2::Zero();
  double squares = 0.0;
  for (const Candidate* c : seen) {
    double weight = 1.0;
    for (const Candidate* other : seen)
      if (other != c) weight /= c->u - other->u;
    sum += weight * c->pixel;
    squares += weight * weight;
  }
  return sum / std::sqrt(squares);
}

double unlikeness(const Candidate& a, const Candidate& b) {
  if (a.body >= 0 && b.body >= 0 && a.body != b.body) return kCap;
  double sum = 0.0;
  if (a.colored && b.colored) sum += (a.color - b.color).squaredNorm() / (3.0 * kColorSpread * kColorSpread);
  if (a.diameter > 0.0 && b.diameter > 0.0) {
    const double d = std::log(a.diameter / b.diameter) / kSizeSpread;
    sum += d * d;
  }
  return std::min(sum, kCap);
}

double typical_diameter(const std::vector<Candidate>& candidates) {
  std::vector<double> sizes;
  for (const Candidate& c : candidates)
    if (c.diameter > 0.0 && c.whole) sizes.push_back(c.diameter);
  return median(std::move(sizes));
}

std::vector<Candidate> without_odd_sizes(const std::vector<Candidate>& points, double least) {
  constexpr std::size_t kAbout = 8;  // points to either side that tell the usual size
  constexpr double kOddSigmas = 6.0;  // of the spread about that
  std::vector<double> off;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t begin = i < kAbout ? 0 : i - kAbout, end = std::min(points.size(), i + kAbout + 1);
    const double usual = typical_diameter({points.begin() + static_cast<std::ptrdiff_t>(begin), points.begin() + static_cast<std::ptrdiff_t>(end)});
    off.push_back(usual > 0.0 && points[i].diameter > 0.0 ? std::abs(std::log(points[i].diameter / usual)) : 0.0);
  }
  const double odd = std::max(least, kOddSigmas * 1.4826 * median(off));
  std::vector<Candidate> usual;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (off[i] <= odd) usual.push_back(points[i]);
  return usual.size() >= 3 ? usual : points;
}

}  // namespace unseen::collision
