// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/supports.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "cuboids/cut_off.h"
#include "unseen/core/convex.h"
#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr double kSmallestGroundShare = 0.2;  // of the largest horizontal area, or of its pixels
constexpr double kCarryShare = 1.0 / 3.0;     // of what the surface that carries most carries
constexpr double kDeskShare = 0.1;            // … of a desk that no mask names
constexpr double kCarryHeight = 0.5;          // m
constexpr double kWallShare = 0.25;           // of the square of the scene's radius
constexpr double kMostBehindWall = 0.03;      // of the points
constexpr double kSureTilt = 0.05;            // rad, of a wall of which no more than a strip is seen
constexpr double kOver = 0.25, kBeside = 1.0, kClearlyBehind = 0.05;  // of a wall's height and width; m
constexpr double kDeskArea = 0.4;  // m²; what is flat and as large may carry things itself
constexpr double kBelow = 0.1, kBelowShare = 0.05;  // m below the ground, share of the points
constexpr int kColumns = 512;

void set_outline(const Scan& scan, Level& level, const Vec3& u, const Vec3& v) {
  std::vector<Vec2> flat;
  for (const int f : level.faces)
    for (const int i : scan.faces.faces[f].points) flat.emplace_back(u.dot(scan.points[i]), v.dot(scan.points[i]));
  // Only the lowest and highest point of each thin column can be corners.
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec2& p : flat) low = std::min(low, p.x()), high = std::max(high, p.x());
  std::vector<Vec2> lowest(kColumns, Vec2(0, 1e30)), highest(kColumns, Vec2(0, -1e30)), corners;
  for (const Vec2& p : flat) {
    const int c = std::min(static_cast<int>((p.x() - low) / std::max(high - low, 1e-9) * kColumns), kColumns - 1);
    if (p.y() < lowest[c].y()) lowest[c] = p;
    if (p.y() > highest[c].y()) highest[c] = p;
  }
  for (int c = 0; c < kColumns; ++c)
    if (lowest[c].y() < 1e30) corners.insert(corners.end(), {lowest[c], highest[c]});
  level.outline = convex_hull(std::move(corners));
}

/// Points that stand on each level: it is the highest below them, and they are on no level themselves. They are counted as the
/// camera sees them: what it was pointed at matters, not what looms behind.
void weigh_levels(const Scan& scan, std::vector<Level>& levels, const Vec3& u, const Vec3& v) {
  std::vector<char> flat(scan.faces.faces.size(), 0);
  for (const Level& level : levels)
    if (level.area >= kDeskArea)
      for (const int f : level.faces) flat[f] = 1;
  for (std::size_t i = 0; i < scan.points.size(); i += 3) {
    const int f = scan.faces.face_of_point[i];
    if (f >= 0 && flat[f]) continue;
    const Vec2 place(u.dot(scan.points[i]), v.dot(scan.points[i]));
    Level* carrier = nullptr;  // the highest that is below
    double least = kCarryHeight;
    for (Level& level : levels) {
      const double height = level.plane.signed_distance(scan.points[i]);
      if (height > 6.0 * scan.graph.sigma[i] && height < least && inside_convex(level.outline, place, 0.0)) {
        least = height;
        carrier = &level;
      }
    }
    if (carrier) carrier->carried += 1.0;
  }
}

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
    if (std::abs(d) < 6.0 * scan.graph.sigma[i]) continue;
    const Vec2 place(u.dot(scan.points[i]), v.dot(scan.points[i]));
    if (!inside_convex(level.outline, place, 0.0)) continue;
    ++(d < 0 ? behind : before);
  }
  return static_cast<double>(behind) <= kMostBehindWall * static_cast<double>(behind + before);
}

/// Whether something that lies behind it was seen beyond most of its upper edge, or of both upright ones: the front of a cupboard or of a box, not a wall.
bool ends_before_its_background(const Scan& scan, const Level& level, const Vec3& across, const Vec3& along) {
  constexpr int kEdgeParts = 20;
  Vec2 low = level.outline.front(), high = low;
  for (const Vec2& p : level.outline) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  const Vec2 size = high - low;
  std::array<std::array<char, kEdgeParts>, 3> behind{};  // parts of the edges: above, left, right
  for (std::size_t i = 0; i < scan.points.size(); ++i) {
    const double noise = 6.0 * scan.graph.sigma[i];
    if (level.plane.signed_distance(scan.points[i]) >= -std::max(noise, kClearlyBehind)) continue;
    const Vec2 p(across.dot(scan.points[i]), along.dot(scan.points[i]));
    const Vec2 share = (p - low).cwiseQuotient(size);
    const auto within = [&](int k) { return share[k] > 0.0 && share[k] < 1.0; };
    const auto mark = [&](int edge, int k) { behind[edge][static_cast<std::size_t>(share[k] * kEdgeParts)] = 1; };
    if (within(0) && p.y() >= high.y() - noise && share.y() <= 1.0 + kOver) mark(0, 0);
    if (within(1) && p.x() <= low.x() + noise && share.x() >= -kBeside) mark(1, 1);
    if (within(1) && p.x() >= high.x() - noise && share.x() <= 1.0 + kBeside) mark(2, 1);
  }
  const auto ends = [&](int edge) { return 2 * std::count(behind[edge].begin(), behind[edge].end(), 1) > kEdgeParts; };
  return ends(0) || (ends(1) && ends(2));
}

/// Whether the picture shows but a strip of a wall, enough to tell how it stands, and not a piece of one that was found.
bool is_strip_of_wall(const Scan& scan, const Level& level, const std::vector<Support>& found) {
  const std::vector<int> points = points_of(scan, level.faces);
  const auto is_of = [&](const Support& wall) {
    const auto on = std::count_if(points.begin(), points.end(), [&](int i) { return std::abs(wall.plane.signed_distance(scan.points[i])) < 6.0 * scan.graph.sigma[i]; });
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

std::vector<Vec3> lifted(const Level& level, const Vec3& u, const Vec3& v) {
  std::vector<Vec3> outline;
  for (const Vec2& p : level.outline) outline.push_back(level.plane.project(p.x() * u + p.y() * v));
  return outline;
}

void add_support(FoundSupports& found, const Scan& scan, const Level& level, SupportKind kind, std::vector<Vec3> outline) {
  Support support;
  support.id = static_cast<int>(found.supports.size());
  support.kind = kind;
  support.plane = level.plane;
  support.outline = std::move(outline);
  found.supports.push_back(std::move(support));
  found.points.push_back(points_of(scan, level.faces));
}

}  // namespace

std::vector<Vec2> plan_of(const Support& support) {
  std::vector<Vec2> plan;
  for (const Vec3& p : support.outline) plan.push_back(p.head<2>());
  return plan;
}

FoundSupports find_supports(const Scan& scan, const Vec3& up, bool unnamed) {
  FoundSupports found;
  found.up = up;
  std::vector<int> upward, downward, upright;
  for (int f = 0; f < static_cast<int>(scan.faces.faces.size()); ++f) {
    const double c = scan.faces.faces[f].plane.normal.dot(up);
    if (c > kHorizontal) upward.push_back(f);
    if (c < -kHorizontal) downward.push_back(f);
    if (std::abs(c) < kVertical) upright.push_back(f);
  }
  std::vector<Level> levels = coplanar(scan, upward);
  const auto area = [&](const std::vector<int>& faces) {
    return std::accumulate(faces.begin(), faces.end(), 0.0, [&](double s, int f) { return s + scan.faces.faces[f].area; });
  };
  found.upside_down = area(downward) > 3.0 * area(upward);
  if (levels.empty() || found.upside_down) return found;

  const Vec3 u = any_orthogonal(up), v = up.cross(u);
  for (Level& level : levels) set_outline(scan, level, u, v);
  double largest = 0, most_pixels = 0, most = 0;
  const auto pixels = [&](const Level& level) { return static_cast<double>(points_of(scan, level.faces).size()); };
  for (const Level& level : levels) {
    largest = std::max(largest, level.area);
    most_pixels = std::max(most_pixels, pixels(level));
  }
  const auto small = [&](const Level& level) { return level.area < kSmallestGroundShare * largest && pixels(level) < kSmallestGroundShare * most_pixels; };
  // Where masks name the objects, a small table under them is none: what it carries counts.
  if (!unnamed) std::erase_if(levels, small);
  weigh_levels(scan, levels, u, v);
  for (const Level& level : levels) most = std::max(most, level.carried);
  const double least = (unnamed ? kDeskShare : kCarryShare) * most;
  const auto height = [&](const Level& level) { return up.dot(level.plane.project(Vec3::Zero())); };
  std::stable_sort(levels.begin(), levels.end(), [&](const Level& a, const Level& b) { return height(a) < height(b); });
  const auto ground = std::find_if(levels.begin(), levels.end(),
                                   [&](const Level& level) { return level.carried >= least; });
  level_with_surest(scan, levels, *ground);
  found.up = ground->plane.normal;
  // A surface that something was seen below ends where it was seen to end; another one goes on.
  const auto below = std::count_if(scan.points.begin(), scan.points.end(), [&](const Vec3& p) {
    return ground->plane.signed_distance(p) < -kBelow;
  });
  const bool ends = static_cast<double>(below) > kBelowShare * static_cast<double>(scan.points.size());
  add_support(found, scan, *ground, SupportKind::ground, ends ? lifted(*ground, u, v) : std::vector<Vec3>{});

  for (const Level& level : levels)
    if (unnamed && &level > &*ground && level.carried >= least && level.plane.normal.dot(found.up) > kHorizontal)
      add_support(found, scan, level, SupportKind::desk, lifted(level, u, v));

  const double smallest_wall = kWallShare * std::pow(scene_radius(scan), 2);
  for (Level& wall : coplanar(scan, upright)) {
    if (wall.area < smallest_wall && !is_strip_of_wall(scan, wall, found.supports)) continue;
    const Vec3 across = found.up.cross(wall.plane.normal).normalized(), along = wall.plane.normal.cross(across);
    set_outline(scan, wall, across, along);
    if (!bounds_the_scene(scan, wall, across, along) || ends_before_its_background(scan, wall, across, along)) continue;
    extend_down(wall, ground->plane, across, along);
    add_support(found, scan, wall, SupportKind::wall, lifted(wall, across, along));
  }
  for (Level& ceiling : coplanar(scan, downward)) {
    if (ceiling.area < smallest_wall) continue;
    set_outline(scan, ceiling, u, v);
    if (bounds_the_scene(scan, ceiling, u, v))
      add_support(found, scan, ceiling, SupportKind::ceiling, lifted(ceiling, u, v));
  }
  return found;
}

}  // namespace unseen::cuboids
