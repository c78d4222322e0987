// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/linear.h"
#include "planes/result/describe.h"
#include "planes/result/walled.h"
#include "unseen/core/quantile.h"

namespace unseen::planes {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::infinity();
constexpr double kLevel = 1.5 * kPi / 180.0;  // floors fall a little, walls lean
constexpr double kLarge = 0.2;    // of the largest level plane's area: less is a table, or a step, unless there are walls around it
constexpr double kWalled = 0.6;   // of what is around it that walls rise from, or hang from
constexpr double kAtEnd = 0.15;   // of the scene's height, from its lowest or highest point
constexpr double kSlab = 0.25;    // of the room's height: how thick what lies between two storeys is, at most
constexpr double kOverlap = 0.3;  // of the smaller one, for one to lie above the other
constexpr double kWall = 0.5;     // of the room's height
constexpr double kRoomy = 0.04;   // of the largest level plane's width: where all is lower, there is no ceiling
constexpr double kNarrow = 0.1;   // of the room's height: what is narrower in the mean is a post, or a seam
constexpr double kPlumb = 0.5 * kPi / 180.0;  // a wall that leans by more does not speak for a vertical
constexpr double kSpeak = 0.5;    // of the most area of walls that speak for one: as much speaks for another as well
constexpr double kSteep = 75 * kPi / 180.0;  // from a direction: walls, plumb along it or not
constexpr double kSomeWalls = 0.05;  // of the area of these: what is less speaks for nothing, as a crate that lies askew before a facade
constexpr double kSliver = 0.02;  // of the largest level plane's area, and of the walls': what is smaller, as ghosts of a mirror below a floor, ends no scene
constexpr std::size_t kMostUps = 20;  // directions with the most area that may be the vertical

/// What a plane's outline reaches, along two level axes and upward.
struct Bounds {
  Vec3 low = Vec3::Constant(kNowhere), high = Vec3::Constant(-kNowhere);
  double height() const { return 0.5 * (low.z() + high.z()); }
};

/// What speaks for a direction as the vertical, m²: walls along it that are turned against each other, and level planes.
struct Votes {
  double plumb = 0, level = 0;
};

Votes votes_for(const Vec3& up, const Arrangement& result) {
  const Vec3 u = any_orthogonal(up), v = up.cross(u);
  Eigen::Matrix2d walls = Eigen::Matrix2d::Zero();
  Votes votes;
  double steep = 0;
  for (const ArrangedPlane& p : result.planes) {
    const Vec3& n = p.plane.normal;
    const Eigen::Vector2d across(n.dot(u), n.dot(v));
    if (line_angle(n, up) > kPi / 2 - kPlumb) walls += p.area * across * across.transpose();
    if (line_angle(n, up) < kLevel) votes.level += p.area;
    if (line_angle(n, up) > kSteep) steep += p.area;
  }
  if (const double across = symmetric_eigen(walls).values[0]; across > kSomeWalls * steep) votes.plumb = across;
  return votes;
}

/// The direction of a plane within 15° of +z, or +z itself, that walls speak for; between those that walls do not part the one with most level area.
/// Ground that falls has two walls of each house along its normal, but not those across.
Vec3 up_of(const Arrangement& result) {
  std::map<int, double> area;
  for (const ArrangedPlane& p : result.planes)
    if (line_angle(p.plane.normal, Vec3::UnitZ()) < kPi / 12) area[p.direction] += p.area;
  std::vector<std::pair<int, double>> largest(area.begin(), area.end());
  std::stable_sort(largest.begin(), largest.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  if (largest.size() > kMostUps) largest.resize(kMostUps);
  std::vector<Vec3> ups;
  for (const auto& [direction, a] : largest) {
    const Vec3& n = result.directions[direction].normal;
    ups.push_back(n.z() < 0 ? Vec3(-n) : n);
  }
  ups.push_back(Vec3::UnitZ());
  std::vector<Votes> votes;
  double plumb = 0;
  for (const Vec3& up : ups) {
    votes.push_back(votes_for(up, result));
    plumb = std::max(plumb, votes.back().plumb);
  }
  std::size_t best = ups.size();
  for (std::size_t i = 0; i < ups.size(); ++i)
    if (votes[i].plumb >= kSpeak * plumb && (best == ups.size() || votes[i].level > (1.0 + 1e-9) * votes[best].level)) best = i;
  return ups[best];
}

Bounds bounds_of(const ArrangedPlane& p, const Mat3& axes) {
  Bounds e;
  if (p.polygon.empty()) return e;
  for (const Vec3& c : p.polygon.front()) {
    e.low = e.low.cwiseMin(axes.transpose() * c);
    e.high = e.high.cwiseMax(axes.transpose() * c);
  }
  return e;
}

/// A level plane that may be a floor or a ceiling.
struct Level {
  std::size_t plane = 0;
  Bounds bounds;
  double area = 0;            ///< m²
  Rings rings;                ///< seen from above
  std::vector<Vec2> samples;  ///< of what lies inside
};

/// Whether enough of the smaller plane lies above or below the other one: ground around a pit lies beside the pit's floor.
bool lie_above_each_other(const Level& a, const Level& b) {
  const Level &small = a.area < b.area ? a : b, &large = &small == &a ? b : a;
  if (!small.rings.box.intersects(large.rings.box)) return false;
  const auto common = std::count_if(small.samples.begin(), small.samples.end(), [&](const Vec2& s) { return large.rings.contains(s); });
  return static_cast<double>(common) > kOverlap * static_cast<double>(small.samples.size());
}

/// How far it is to the next level plane above and below that is not much smaller; infinite without one.
struct Gaps {
  double above = kNowhere, below = kNowhere;
};

Gaps gaps_at(const Level& level, const std::vector<const Level*>& levels) {
  Gaps gaps;
  for (const Level* other : levels) {
    if (other == &level || other->area < kLarge * level.area || !lie_above_each_other(level, *other)) continue;
    const double higher = other->bounds.height() - level.bounds.height();
    double& gap = higher > 0 ? gaps.above : gaps.below;
    gap = std::min(gap, std::abs(higher));
  }
  return gaps;
}

/// Whether walls rise from a level plane to the next one above, or hang from it to the next below; to the scene's ends without one.
struct Walled {
  bool up = false, down = false;
};

Walled walled_at(const ArrangedPlane& p, const Gaps& gaps, double to_bottom, double to_top, const Vec3& up, const std::vector<Wall>& walls) {
  const auto most = [&](double gap, double end, double sign) { return walled_share(p, sign * (std::isfinite(gap) ? gap : end), up, walls) > kWalled; };
  return {most(gaps.above, to_top, 1.0), most(gaps.below, to_bottom, -1.0)};
}

/// Below a floor is nothing, or the ceiling of the storey beneath; above a ceiling nothing, or the next floor, and its own floor below, unless nothing
/// level is seen there: ground beside a pit has neither. Where they do not end the scene, walls tell floors and ceilings from stages and roofs, unless all is too
/// low for a ceiling (`from_top` is infinite).
std::string tag_of_level(const Gaps& gaps, double from_bottom, double from_top, bool lowest, const Walled& walled) {
  const bool floor = std::isinf(gaps.below) ? from_bottom < kAtEnd || walled.up : gaps.below < kSlab * gaps.above && std::isfinite(gaps.above);
  const bool hangs = from_top < kAtEnd ? lowest || std::isfinite(gaps.below) : walled.down && std::isfinite(gaps.below) && std::isfinite(from_top);
  const bool ceiling = std::isinf(gaps.above) ? hangs : gaps.above < kSlab * gaps.below && std::isfinite(gaps.below);
  if (floor && !(ceiling && from_top < from_bottom)) return "floor";
  return ceiling ? "ceiling" : "horizontal";
}

/// Where the scene ends, m, and how large its largest level plane is, m².
struct Ends {
  double low = kNowhere, high = -kNowhere, largest = 0;
  double span() const { return std::max(high - low, 1e-300); }
  bool is_large(const Level& level) const { return level.area > kLarge * largest; }
};

Ends ends_of(const Arrangement& result, const std::vector<Bounds>& bounds, const Vec3& up) {
  Ends ends;
  double walls = 0;
  for (const ArrangedPlane& p : result.planes) {
    if (line_angle(p.plane.normal, up) < kLevel) ends.largest = std::max(ends.largest, p.area);
    if (line_angle(p.plane.normal, up) > kPi / 2 - kLevel) walls += p.area;
  }
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (result.planes[i].area < kSliver * std::min(ends.largest, walls)) continue;
    ends.low = std::min(ends.low, bounds[i].low.z());
    ends.high = std::max(ends.high, bounds[i].high.z());
  }
  return ends;
}

/// Tags level planes: of the small ones those with walls around, and then floors and ceilings alone end the rooms of large ones. Returns the rooms' heights, m.
std::vector<double> tag_levels(const std::vector<Level>& levels, const std::vector<Wall>& walls, const Ends& ends, const Vec3& up, Arrangement& result) {
  double lowest = kNowhere;
  for (const Level& level : levels)
    if (ends.is_large(level)) lowest = std::min(lowest, level.bounds.height());
  const bool roomy = ends.span() > kRoomy * std::sqrt(ends.largest);
  std::vector<double> rooms;
  const auto tag = [&](const Level& level, const std::vector<const Level*>& others) {
    ArrangedPlane& plane = result.planes[level.plane];
    const Gaps gaps = gaps_at(level, others);
    const double to_bottom = level.bounds.low.z() - ends.low, to_top = ends.high - level.bounds.high.z();
    const Walled walled = walled_at(plane, gaps, to_bottom, to_top, up, walls);
    plane.tag = "horizontal";
    if (ends.is_large(level) || walled.up || walled.down)
      plane.tag = tag_of_level(gaps, to_bottom / ends.span(), roomy ? to_top / ends.span() : kNowhere, level.bounds.height() - lowest < kAtEnd * ends.span(), walled);
    if (plane.tag == "floor" && std::isfinite(gaps.above)) rooms.push_back(gaps.above);
    return plane.tag != "horizontal";
  };
  std::vector<const Level*> all, of_rooms;
  for (const Level& level : levels) all.push_back(&level);
  for (const Level& level : levels)
    if (ends.is_large(level) || tag(level, all)) of_rooms.push_back(&level);
  for (const Level& level : levels)
    if (ends.is_large(level)) tag(level, of_rooms);
  return rooms;
}

}  // namespace

void tag_planes(Arrangement& result) {
  if (result.two_dimensional) return;
  const Vec3 up = up_of(result), u = any_orthogonal(up);
  Mat3 axes;
  axes << u, up.cross(u), up;
  std::vector<Bounds> bounds;
  for (const ArrangedPlane& p : result.planes) bounds.push_back(bounds_of(p, axes));
  const Ends ends = ends_of(result, bounds, up);
  std::vector<Level> levels;
  std::vector<Wall> walls;
  for (std::size_t i = 0; i < result.planes.size(); ++i) {
    const ArrangedPlane& p = result.planes[i];
    const double angle = line_angle(p.plane.normal, up);
    if (angle > kPi / 2 - kLevel) walls.push_back(wall_of(p, up));
    if (angle >= kLevel || p.area < kSliver * ends.largest) continue;
    levels.push_back({i, bounds[i], p.area, rings_of(p, axes.col(0), axes.col(1)), {}});
    levels.back().samples = levels.back().rings.samples();
  }
  std::vector<double> rooms = tag_levels(levels, walls, ends, up, result);
  const double room = rooms.empty() ? ends.high - ends.low : median(std::move(rooms));
  for (std::size_t i = 0; i < result.planes.size(); ++i) {
    ArrangedPlane& p = result.planes[i];
    if (!p.tag.empty()) continue;
    const double angle = line_angle(p.plane.normal, up);
    if (angle < kLevel) p.tag = "horizontal";
    else if (angle < kPi / 2 - kLevel) p.tag = "sloped";
    else {
      const double tall = bounds[i].high.z() - bounds[i].low.z();
      p.tag = tall > kWall * room && p.area > kNarrow * room * tall ? "wall" : "vertical";
    }
  }
}

}  // namespace unseen::planes
