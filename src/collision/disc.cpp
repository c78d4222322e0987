// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/disc.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

constexpr double kWhole = 0.93;        // share of the bounding circle: nothing is missing
constexpr int kDraws = 150;
constexpr double kNear = 1.0, kNearShare = 0.01;  // px, and of the radius: on the circle
constexpr double kOn = 0.45;           // share of the outline that is on it
constexpr double kOutside = 0.04;      // share of the outline that may be outside
constexpr int kSectors = 36, kSeen = 11;  // sectors of the circle, and how many of them must be seen
constexpr double kLargest = 2.5;       // times the bounding circle
constexpr double kSmallest = 12.0;     // px: too small to tell

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
  return static_cast<double>(on) > kOn * count && static_cast<double>(outside) < kOutside * count && std::count(seen.begin(), seen.end(), true) >= kSeen;
}

}  // namespace

std::optional<Disc> covered_disc(const Region& region) {
  if (region.circle < kSmallest || region.mask.empty() || region.at_border) return std::nullopt;
  if (region.area > kWhole * 0.25 * kPi * region.circle * region.circle) return std::nullopt;
  const std::vector<Vec2> outline = outline_of(region);
  if (outline.size() < 16) return std::nullopt;
  const double largest = kLargest * region.circle;
  const Circle circle = best_circle(outline, largest);
  if (circle.radius <= 0.0 || 2.0 * circle.radius > largest || !holds(outline, circle)) return std::nullopt;
  constexpr double kHalfPixel = 0.5;  // the outline runs through the middles of the outermost pixels
  return Disc{circle.center + Vec2(region.box.x, region.box.y), 2.0 * (circle.radius + kHalfPixel)};
}

}  // namespace unseen::collision
