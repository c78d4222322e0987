// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/boxes/outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/linear.h"

namespace unseen::cuboids {
namespace {

const double kLevelFace = std::cos(radians(10.0));
const double kOffSine = std::sin(radians(15.0));
const double kMostTurn = radians(10.0);     // an edge that is turned farther is not that of the side
const double kLeastLean = radians(2.0);
constexpr double kUpright = 1.0 - 1e-9;
constexpr double kLeanErrors = 4.0, kAlikeErrors = 2.0;
constexpr double kSliceSpacings = 2.5;
constexpr std::size_t kFewestSlices = 8;
constexpr double kShortestEdge = 0.03;      // m
constexpr std::array<double, 4> kBeyond = {2.0, 4.0, 6.0, 8.0};  // spacings: the first measurement there says whose end it is
constexpr double kTrim = 2.5;
constexpr int kTrimRounds = 4;
constexpr double kSmoothed = 4.0;           // slices, over which the ends of a sensor's faces wander together

/// The point of each slice of a face across `along` that lies outermost in direction `out`, if the face is seen to end there.
std::vector<Vec2> free_ends(const Observation& seen, const DepthView& view, const Face& face, const Vec3& along, const Vec3& out) {
  double low = std::numeric_limits<double>::infinity(), high = -low, spacing = 0;
  for (const int i : face.points) {
    low = std::min(low, along.dot(seen.points[i]));
    high = std::max(high, along.dot(seen.points[i]));
    spacing += seen.graph.spacing[i] / static_cast<double>(face.points.size());
  }
  if (high - low < kShortestEdge || spacing <= 0.0) return {};
  std::vector<int> outermost(static_cast<std::size_t>((high - low) / (kSliceSpacings * spacing)) + 1, -1);
  for (const int i : face.points) {
    int& end = outermost[static_cast<std::size_t>((along.dot(seen.points[i]) - low) / (kSliceSpacings * spacing))];
    if (end < 0 || out.dot(seen.points[i]) > out.dot(seen.points[end])) end = i;
  }
  std::vector<Vec2> ends;
  for (const int i : outermost) {
    if (i < 0) continue;
    DepthView::Space beyond = DepthView::Space::missing;
    for (const double step : kBeyond)
      if (beyond == DepthView::Space::missing) beyond = view.at(seen.points[i] + step * spacing * out);
    if (beyond == DepthView::Space::free) ends.emplace_back(along.dot(seen.points[i]), out.dot(seen.points[i]));
  }
  return ends;
}

struct Slope {
  double angle = 0, error = 0;  ///< rad
  double low = 0, high = 0;     ///< m: from where to where the ends reach
};

/// Regression line of ends, without those far off it.
std::optional<Slope> slope_of(std::vector<Vec2> ends) {
  for (int round = 0;; ++round) {
    if (ends.size() < kFewestSlices) return std::nullopt;
    const double count = static_cast<double>(ends.size());
    Vec2 mean = Vec2::Zero();
    for (const Vec2& e : ends) mean += e / count;
    double xx = 0, xy = 0;
    for (const Vec2& e : ends) xx += (e - mean).x() * (e - mean).x(), xy += (e - mean).x() * (e - mean).y();
    if (std::sqrt(12.0 * xx / count) < kShortestEdge) return std::nullopt;
    const double slope = xy / xx;
    double squares = 0;
    const auto off = [&](const Vec2& e) { return std::abs((e - mean).y() - slope * (e - mean).x()); };
    for (const Vec2& e : ends) squares += off(e) * off(e);
    const double rms = std::sqrt(squares / (count - 2.0));
    if (round == kTrimRounds) return Slope{std::atan(slope), rms * std::sqrt(kSmoothed / xx), ends.front().x(), ends.back().x()};
    std::erase_if(ends, [&](const Vec2& e) { return off(e) > kTrim * rms; });
  }
}

/// rad: how far an edge may turn before the pixels that see its ends step over one another; on a face that is seen along itself their rows are far apart.
/// An edge that crosses several rows or columns of them is known so much better.
double step_error(const DepthView& view, const Face& face, const Slope& edge, const Vec3& along, const Vec3& out) {
  const Vec3& n = face.plane.normal;
  const Vec3 ray = (face.center - view.viewpoint()).normalized(), away = (ray - ray.dot(n) * n).normalized(), beside = n.cross(away);
  const double column = view.spacing(face.center), row = column / std::max(std::abs(ray.dot(n)), 1e-3), length = edge.high - edge.low;
  const Vec3 run = length * (std::cos(edge.angle) * along + std::sin(edge.angle) * out);
  const auto error = [&](const Vec3& direction, double step) { return out.dot(direction) * step / (1.0 + std::abs(run.dot(direction)) / step); };
  return std::hypot(error(away, row), error(beside, column)) / (std::sqrt(6.0) * length);
}

/// By how much (tangent) the largest upright face across `out` leans toward it.
double lean_along(const Observation& seen, const DepthView& view, std::span<const Face* const> faces, const Vec3& out) {
  const Face* largest = nullptr;
  for (const Face* face : faces) {
    const Vec3& n = face->plane.normal;
    if (std::abs(n.z()) < kOffSine && std::abs(n.dot(out)) < kOffSine && (!largest || face->area > largest->area)) largest = face;
  }
  if (!largest) return 0.0;
  const auto one = slope_of(free_ends(seen, view, *largest, Vec3::UnitZ(), out));
  const auto other = slope_of(free_ends(seen, view, *largest, Vec3::UnitZ(), -out));
  if (!one || !other) return 0.0;
  const double lean = 0.5 * (one->angle - other->angle), error = std::hypot(one->error, other->error);
  const bool alike = std::abs(one->angle + other->angle) < kAlikeErrors * error;
  const bool clear = std::abs(lean) > std::max(kLeastLean, kLeanErrors * 0.5 * error) && std::abs(lean) < kMostTurn;
  return alike && clear ? std::tan(lean) : 0.0;
}

}  // namespace

Vec2 quarter_turn(double angle, double information) { return information * Vec2(std::cos(4.0 * angle), std::sin(4.0 * angle)); }

Vec2 turn_of_outline(const Observation& seen, const DepthView& view, std::span<const Face* const> faces, double yaw) {
  const Vec3 x(std::cos(yaw), std::sin(yaw), 0.0), y(-std::sin(yaw), std::cos(yaw), 0.0);
  Vec2 sum = Vec2::Zero();
  for (const Face* face : faces) {
    if (face->plane.normal.z() < kLevelFace) continue;
    for (const auto& [along, out] : {std::pair{x, y}, std::pair{y, Vec3(-x)}, std::pair{Vec3(-x), Vec3(-y)}, std::pair{Vec3(-y), x}}) {
      const auto slope = slope_of(free_ends(seen, view, *face, along, out));
      if (!slope || std::abs(slope->angle) > kMostTurn) continue;
      const double error = std::hypot(slope->error, step_error(view, *face, *slope, along, out));
      sum += quarter_turn(yaw + slope->angle, 1.0 / (error * error));
    }
  }
  return sum;
}

Vec2 lean_of_outline(const Observation& seen, const DepthView& view, std::span<const Face* const> faces, const Mat3& axes) {
  if (axes(2, 2) < kUpright) return Vec2::Zero();
  return {lean_along(seen, view, faces, axes.col(0)), lean_along(seen, view, faces, axes.col(1))};
}

Mat3 leaning_axes(const Observation& seen, const DepthView& view, std::span<const Face* const> faces, const Mat3& axes) {
  const Vec2 lean = lean_of_outline(seen, view, faces, axes);
  if (lean.isZero()) return axes;
  return turn_between(axes.col(2), axes * Vec3(lean.x(), lean.y(), 1.0)).toRotationMatrix() * axes;
}

}  // namespace unseen::cuboids
