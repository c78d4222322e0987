// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/disc.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

constexpr double kWhole = 0.9;         // share of the bounding circle: nothing is missing
constexpr double kMissing = 0.94;      // share of the disc: more is as good without
constexpr double kAlikeDiameters = 1.08;        // ratio of diameters
constexpr int kFewestAlike = 3;
constexpr int kDraws = 150;
constexpr double kNear = 0.7, kNearShare = 0.01;  // px, and of the radius: on the circle
constexpr double kOn = 0.45;           // share of the outline that is on it
constexpr double kOutside = 0.04;      // share of the outline that may be outside
constexpr int kSectors = 36, kSeen = 11, kStray = 2;  // sectors of the circle; how many must be seen in a row, and at most elsewhere
constexpr double kLargest = 2.5;       // times the bounding circle
constexpr double kSmallestDisc = 20.0;     // px: too small to tell

struct Circle {
  Vec2 center = Vec2::Zero();
  double radius = 0;
  double off(const Vec2& p) const { return (p - center).norm() - radius; }
  double reach() const { return kNear + kNearShare * radius; }
};

/// Least squares of |p|² = 2 c·p + (r² − |c|²) (Kåsa 1976).
template <class Points>
bool fit(const Points& points, Circle& circle) {
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (const Vec2& p : points) {
    const Vec3 row(2.0 * p.x(), 2.0 * p.y(), 1.0);
    normal += row * row.transpose();
    right += row * p.squaredNorm();
  }
  if (std::abs(normal.determinant()) < 1e-6) return false;
  const Vec3 x = normal.inverse() * right;
  circle.center = x.head<2>();
  circle.radius = std::sqrt(std::max(0.0, x[2] + circle.center.squaredNorm()));
  return true;
}

std::vector<Vec2> outline_of(const Region& region) {
  cv::Mat padded;
  cv::copyMakeBorder(region.mask, padded, 1, 1, 1, 1, cv::BORDER_CONSTANT, cv::Scalar(0));
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(padded, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  std::vector<Vec2> points;
  for (const auto& outline : outlines)
    for (const cv::Point& p : outline) points.push_back({p.x - 1.0, p.y - 1.0});
  return points;
}

std::size_t count_on(const std::vector<Vec2>& outline, const Circle& circle) {
  return static_cast<std::size_t>(std::count_if(outline.begin(), outline.end(), [&](const Vec2& p) { return std::abs(circle.off(p)) < circle.reach(); }));
}

/// The circle that most of the outline is on.
Circle best_circle(const std::vector<Vec2>& outline, double largest) {
  Random random(1);
  Circle best;
  std::size_t most = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    const std::array<Vec2, 3> three = {outline[random.index(outline.size())], outline[random.index(outline.size())], outline[random.index(outline.size())]};
    Circle circle;
    if (!fit(three, circle) || circle.radius > 0.5 * largest) continue;
    const std::size_t on = count_on(outline, circle);
    if (on > most) most = on, best = circle;
  }
  for (int round = 0; round < 4 && most > 0; ++round) {
    std::vector<Vec2> near;
    for (const Vec2& p : outline)
      if (std::abs(best.off(p)) < best.reach()) near.push_back(p);
    Circle circle;
    if (near.size() < 8 || !fit(near, circle)) break;
    best = circle;
  }
  return best;
}

/// Whether the sectors that are seen are enough, and in one row but for single gaps: the two caps of a blurred ball are no disc.
bool seen_in_a_row(const std::array<bool, kSectors>& seen) {
  const auto at = [&](int i) { return seen[static_cast<std::size_t>((i + kSectors) % kSectors)]; };
  int longest = 0, all = 0;
  for (int begin = 0; begin < kSectors; ++begin) {
    all += at(begin);
    int length = 0;
    for (int i = begin; length < kSectors && (at(i) || at(i + 1)); ++i) ++length;
    if (at(begin)) longest = std::max(longest, length);
  }
  const int within = std::min(longest, all);
  return within >= kSeen && all - within <= kStray;
}

/// Whether the outline is mostly on the circle, all around enough, and elsewhere inside.
bool holds(const std::vector<Vec2>& outline, const Circle& circle) {
  std::array<bool, kSectors> seen{};
  std::size_t on = 0, outside = 0;
  for (const Vec2& p : outline) {
    const double off = circle.off(p);
    outside += off > circle.reach();
    if (std::abs(off) >= circle.reach()) continue;
    ++on;
    const Vec2 d = p - circle.center;
    seen[static_cast<std::size_t>((std::atan2(d.y(), d.x()) / (2.0 * kPi) + 0.5) * kSectors) % kSectors] = true;
  }
  const auto count = static_cast<double>(outline.size());
  return static_cast<double>(on) > kOn * count && static_cast<double>(outside) < kOutside * count && seen_in_a_row(seen);
}

/// The disc whose edge most of the outline is, with the rest inside; nothing if there is none.
std::optional<Disc> disc_around(const Region& region) {
  if (region.circle < kSmallestDisc || region.mask.empty() || region.at_border) return std::nullopt;
  const std::vector<Vec2> outline = outline_of(region);
  if (outline.size() < 16) return std::nullopt;
  const double largest = kLargest * region.circle;
  const Circle circle = best_circle(outline, largest);
  if (circle.radius <= 0.0 || 2.0 * circle.radius > largest || !holds(outline, circle)) return std::nullopt;
  constexpr double kHalfPixel = 0.5;  // the outline runs through the middles of the outermost pixels
  return Disc{circle.center + Vec2(region.box.x, region.box.y), 2.0 * (circle.radius + kHalfPixel)};
}

/// Whether hardly anything of a disc is missing.
bool is_most_of(const Region& region, const Disc& disc) { return region.area > kMissing * 0.25 * kPi * disc.diameter * disc.diameter; }

bool known_size(double diameter, const std::vector<double>& wholes) {
  const auto from = std::lower_bound(wholes.begin(), wholes.end(), diameter / kAlikeDiameters), to = std::upper_bound(wholes.begin(), wholes.end(), diameter * kAlikeDiameters);
  return to - from >= kFewestAlike;
}

}  // namespace

bool is_disc(const Region& region) {
  return region.circle >= kSmallestDisc && !region.at_border && region.area > kWhole * 0.25 * kPi * region.circle * region.circle;
}

bool is_nearly_whole(const Region& region) {
  const std::optional<Disc> disc = disc_around(region);
  return disc && is_most_of(region, *disc);
}

std::optional<Disc> covered_disc(const Region& region, const std::vector<double>& wholes) {
  const std::optional<Disc> disc = wholes.empty() ? std::nullopt : disc_around(region);
  return disc && !is_most_of(region, *disc) && known_size(disc->diameter, wholes) ? disc : std::nullopt;
}

}  // namespace unseen::collision
