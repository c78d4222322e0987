// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/surfaces/enclosure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "cuboids/surfaces/cut_off.h"
#include "unseen/core/convex.h"
#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr double kWallShare = 0.25;        // of the square of the scene's radius
constexpr double kMostBehindWall = 0.03;   // of the points
constexpr double kSureTilt = 0.05;         // rad, of a wall of which no more than a strip is seen
constexpr double kClearly = 0.05;          // m off a plane, besides noise
constexpr double kOver = 0.25, kBeside = 1.0;  // of a wall's height and width: how far from it its background tells where it ends

double scene_radius(const Scan& scan) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& p : scan.points) mean += p;
  mean /= static_cast<double>(scan.points.size());
  std::vector<double> distance;
  for (std::size_t i = 0; i < scan.points.size(); i += 7) distance.push_back((scan.points[i] - mean).norm());
  return quantile(std::move(distance), 0.9);
}

/// Whether (almost) nothing was seen behind a plane within its outline.
bool bounds_the_scene(const Scan& scan, const Level& level, const Vec3& u, const Vec3& v) {
  std::size_t behind = 0, before = 0;
  for (std::size_t i = 0; i < scan.points.size(); i += 5) {
    const double d = level.plane.signed_distance(scan.points[i]);
    if (std::abs(d) < kOffPlane * scan.graph.sigma[i]) continue;
    const Vec2 place(u.dot(scan.points[i]), v.dot(scan.points[i]));
    if (!inside_convex(level.outline, place, 0.0)) continue;
    ++(d < 0 ? behind : before);
  }
  return static_cast<double>(behind) <= kMostBehindWall * static_cast<double>(behind + before);
}

/// Beyond which edges of an upright surface something that lies behind it was seen, along most of the edge.
struct Ends {
  bool above = false, left = false, right = false;
};

/// What lies behind counts where it is, or, `as_seen`, where its view ray passes the surface's plane.
Ends ends_of(const Scan& scan, const Level& level, const Vec3& across, const Vec3& along, bool as_seen) {
  constexpr int kEdgeParts = 20;
  Vec2 low = level.outline.front(), high = low;
  for (const Vec2& p : level.outline) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec2 size = high - low;
  const double before = level.plane.signed_distance(Vec3::Zero());
  std::array<std::array<char, kEdgeParts>, 3> behind{};  // parts of the edges: above, left, right
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const double noise = kOffPlane * scan.graph.sigma[i], distance = level.plane.signed_distance(scan.points[i]), slack = as_seen ? 0.0 : noise;
    if (distance >= -std::max(noise, kClearly)) continue;
    const Vec3 at = scan.points[i] * (as_seen ? before / (before - distance) : 1.0);
    const Vec2 p(across.dot(at), along.dot(at)), share = (p - low).cwiseQuotient(size);
    const auto within = [&](int k) { return share[k] > 0.0 && share[k] < 1.0; };
    const auto mark = [&](int edge, int k) { behind[edge][static_cast<std::size_t>(share[k] * kEdgeParts)] = 1; };
    if (within(0) && p.y() >= high.y() - slack && share.y() <= 1.0 + kOver) mark(0, 0);
    if (within(1) && p.x() <= low.x() + slack && share.x() >= -kBeside) mark(1, 1);
    if (within(1) && p.x() >= high.x() - slack && share.x() <= 1.0 + kBeside) mark(2, 1);
  }
  const auto ends = [&](int edge) { return 2 * std::count(behind[edge].begin(), behind[edge].end(), 1) > kEdgeParts; };
  return {ends(0), ends(1), ends(2)};
}

/// Whether an upright surface is the front of a cupboard or of a box, not a wall: what lies behind it is as high as its upper edge, or beyond both
/// upright ones; or it stands on the ground and the picture shows what lies behind past both upright edges, and over the upper one nothing that does.
bool ends_before_its_background(const Scan& scan, const Level& level, const Plane& ground, const Vec3& across, const Vec3& along) {
  const Ends placed = ends_of(scan, level, across, along, false);
  if (placed.above || (placed.left && placed.right)) return true;
  if (!scan.is_image) return false;
  const Ends seen = ends_of(scan, level, across, along, true);
  double height = std::numeric_limits<double>::infinity();  // of its lower edge
  for (const Vec3& p : lifted(level, across, along)) height = std::min(height, ground.signed_distance(p));
  return !seen.above && seen.left && seen.right && std::abs(height) < kClearly;
}

/// Whether the picture shows but a strip of a wall, enough to tell how it stands, and not a piece of one that was found.
bool is_strip_of_wall(const Scan& scan, const Level& level, const std::vector<Enclosing>& found) {
  const std::vector<int> points = points_of(scan, level.faces);
  const auto is_of = [&](const Enclosing& wall) {
    const auto is_on = [&](int i) { return std::abs(wall.level.plane.signed_distance(scan.points[i])) < kOffPlane * scan.graph.sigma[i]; };
    const auto on = std::count_if(points.begin(), points.end(), is_on);
    return 2 * static_cast<std::size_t>(on) > points.size();
  };
  return goes_on_beyond_picture(scan, level) && tilt_error(scan, points) < kSureTilt && std::none_of(found.begin(), found.end(), is_of);
}

/// Walls go down to the ground, behind what hides them there.
void extend_down(Level& wall, const Plane& ground, const Vec3& across, const Vec3& along) {
  std::vector<Vec2> corners = wall.outline;
  for (const Vec2& p : wall.outline) {
    const double height = ground.signed_distance(wall.plane.project(p.x() * across + p.y() * along));
    corners.emplace_back(p.x(), p.y() - std::max(0.0, height) / along.dot(ground.normal));
  }
  wall.outline = convex_hull(std::move(corners));
}

}  // namespace

std::vector<Enclosing> find_enclosure(const Scan& scan, const std::vector<int>& upright, const std::vector<int>& downward, const Plane& ground) {
  const Vec3& up = ground.normal;
  std::vector<Enclosing> found;
  const double smallest = kWallShare * std::pow(scene_radius(scan), 2);
  for (Level& wall : coplanar(scan, upright)) {
    if (wall.area < smallest && !is_strip_of_wall(scan, wall, found)) continue;
    const Vec3 across = up.cross(wall.plane.normal).normalized(), along = wall.plane.normal.cross(across);
    set_outline(scan, wall, across, along);
    if (!bounds_the_scene(scan, wall, across, along) || ends_before_its_background(scan, wall, ground, across, along)) continue;
    extend_down(wall, ground, across, along);
    std::vector<Vec3> outline = lifted(wall, across, along);
    found.push_back({SupportKind::wall, std::move(wall), std::move(outline)});
  }
  const Vec3 u = any_orthogonal(up), v = up.cross(u);
  for (Level& ceiling : coplanar(scan, downward)) {
    if (ceiling.area < smallest) continue;
    set_outline(scan, ceiling, u, v);
    if (!bounds_the_scene(scan, ceiling, u, v)) continue;
    std::vector<Vec3> outline = lifted(ceiling, u, v);
    found.push_back({SupportKind::ceiling, std::move(ceiling), std::move(outline)});
  }
  return found;
}

}  // namespace unseen::cuboids
