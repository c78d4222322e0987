// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/surfaces/supports.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "cuboids/surfaces/enclosure.h"
#include "unseen/core/convex.h"

namespace unseen::cuboids {
namespace {

constexpr double kSmallestGroundShare = 0.2;  // of the largest horizontal area, or of its pixels
constexpr double kCarryShare = 1.0 / 3.0;     // of what the surface that carries most carries
constexpr double kDeskShare = 0.1;            // … of a desk that no mask names
constexpr double kCarryHeight = 0.5;          // m
constexpr double kDeskArea = 0.4;             // m²; what is flat and as large may carry things itself
constexpr double kBelow = 0.1, kBelowShare = 0.05;  // m below the ground, share of the points

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
      if (height > kOffPlane * scan.graph.sigma[i] && height < least && inside_convex(level.outline, place, 0.0)) {
        least = height;
        carrier = &level;
      }
    }
    if (carrier) carrier->carried += 1.0;
  }
}

/// Whether much that lies below a level was seen through its outline, as a belt between rails.
bool is_seen_through(const Scan& scan, const Level& level, const Vec3& u, const Vec3& v) {
  constexpr double kMuch = 0.3, kBelowAtLeast = 0.01;  // of the level's points; m
  constexpr std::size_t kStep = 3;
  std::size_t through = 0;
  for (std::size_t i = 0; i < scan.points.size(); i += kStep) {
    const Vec3& p = scan.points[i];
    if (level.plane.signed_distance(p) > -(kBelowAtLeast + kOffPlane * scan.graph.sigma[i])) continue;
    const Vec3 at = level.plane.offset / level.plane.normal.dot(p) * p;  // where its ray meets the level
    through += inside_convex(level.outline, Vec2(u.dot(at), v.dot(at)), 0.0);
  }
  return static_cast<double>(kStep * through) > kMuch * static_cast<double>(points_of(scan, level.faces).size());
}

/// The faces of levels that were seen through become levels of their own: nothing stands on what is between them.
void part_seen_through(const Scan& scan, const Vec3& u, const Vec3& v, std::vector<Level>& levels) {
  for (std::size_t l = 0; l < levels.size(); ++l) {
    if (levels[l].faces.size() < 2 || !is_seen_through(scan, levels[l], u, v)) continue;
    const std::vector<int> others(levels[l].faces.begin() + 1, levels[l].faces.end());
    levels[l].faces.resize(1);
    levels[l].area = scan.faces.faces[levels[l].faces[0]].area;
    set_outline(scan, levels[l], u, v);
    for (const int f : others) {
      levels.push_back(Level{levels[l].plane, scan.faces.faces[f].area, 0, {f}, {}});
      set_outline(scan, levels.back(), u, v);
    }
  }
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
  else if (scan.is_image) part_seen_through(scan, u, v, levels);
  weigh_levels(scan, levels, u, v);
  for (const Level& level : levels) most = std::max(most, level.carried);
  const double least = (unnamed ? kDeskShare : kCarryShare) * most;
  const auto height = [&](const Level& level) { return up.dot(level.plane.project(Vec3::Zero())); };
  std::stable_sort(levels.begin(), levels.end(), [&](const Level& a, const Level& b) { return height(a) < height(b); });
  const auto ground = std::find_if(levels.begin(), levels.end(),
                                   [&](const Level& level) { return level.carried >= least; });
  const Plane own = ground->plane;  // also that of what was parted from it
  const double error = level_with_surest(scan, levels, *ground);
  found.up = ground->plane.normal;
  // A surface that something was seen below ends where it was seen to end; another one goes on.
  const auto below = std::count_if(scan.points.begin(), scan.points.end(), [&](const Vec3& p) {
    return ground->plane.signed_distance(p) < -kBelow;
  });
  const bool ends = static_cast<double>(below) > kBelowShare * static_cast<double>(scan.points.size());
  add_support(found, scan, *ground, SupportKind::ground, ends ? lifted(*ground, u, v) : std::vector<Vec3>{});

  for (Level& level : levels)
    if (unnamed && &level > &*ground && level.carried >= least && level.plane.normal.dot(found.up) > kHorizontal && (level.plane.normal != own.normal || level.plane.offset != own.offset)) {
      level_with_ground(scan, found.up, error, level);
      add_support(found, scan, level, SupportKind::desk, lifted(level, u, v));
    }

  for (Enclosing& side : find_enclosure(scan, upright, downward, ground->plane))
    add_support(found, scan, side.level, side.kind, std::move(side.outline));
  return found;
}

}  // namespace unseen::cuboids
