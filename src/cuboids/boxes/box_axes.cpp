// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/boxes/box_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/linear.h"
#include "cuboids/boxes/outline.h"
#include "cuboids/boxes/upright_sides.h"
#include "cuboids/surfaces/supports.h"
#include "unseen/core/convex.h"
#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

const double kMostAskew = radians(8.0), kAlignedCosine = std::cos(kMostAskew);
const double kSteepest = std::cos(radians(45.0));  // of a support on which things stand
const double kLeastSlant = radians(2.0), kMostLean = radians(15.0);
constexpr double kTurningArea = 0.1;  // of the largest face, that tells how it is turned within its plane …
const double kStandingSine = std::sin(radians(30.0)), kTurnedSine = std::sin(radians(5.0));  // … by so much, where it is so far from level
constexpr double kSystematic = 0.02;        // rad, of a measured normal whatever its noise: warps of the sensor
constexpr double kLeanSigmas = 4.0;         // standard errors: a largest face that leans by less is level …
constexpr double kSlantSigmas = 2.0;        // … and so is what only two faces together say is slanted …
const double kVagueLean = radians(4.0);     // … and a face whose direction noise leaves as open: slivers between edges
constexpr double kEnoughExplained = 0.6, kMuchMore = 0.2;  // shares of the points, for axes that are not level
constexpr double kShortestForYaw = 0.03;    // m, of an upright face along the ground
constexpr double kEnoughInformation = 1.0 / (0.03 * 0.03);
constexpr std::size_t kMostRectanglePoints = 1500;
constexpr int kTurns = 6;                   // in a quarter, near which straight edges are sought …
constexpr double kClearer = 1.5;            // … that must tell so many times more than those near the other turns

Mat3 turned(double yaw) {
  Mat3 axes = Mat3::Identity();
  axes(0, 0) = axes(1, 1) = std::cos(yaw);
  axes(1, 0) = std::sin(yaw);
  axes(0, 1) = -std::sin(yaw);
  return axes;
}

/// Turn of the rectangle of least area around points in a plane, their outermost percent left out.
double rectangle_turn(const std::vector<Vec2>& points) {
  const std::size_t step = points.size() / kMostRectanglePoints + 1;
  const auto area = [&](double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    std::vector<double> x, y;
    for (std::size_t i = 0; i < points.size(); i += step) {
      x.push_back(c * points[i].x() + s * points[i].y());
      y.push_back(-s * points[i].x() + c * points[i].y());
    }
    return (quantile(x, 0.99) - quantile(x, 0.01)) * (quantile(y, 0.99) - quantile(y, 0.01));
  };
  double best = 0, best_area = std::numeric_limits<double>::infinity();
  for (int degree = 0; degree < 90; degree += 3)
    if (const double a = area(radians(degree)); a < best_area) best_area = a, best = radians(degree);
  for (const double step_size : {1.0, 0.3})
    for (int k = -3; k <= 3; ++k)
      if (const double a = area(best + radians(step_size * k)); a < best_area) best_area = a, best += radians(step_size * k);
  return best;
}

/// The face with the most points, if it is flat and has at least half of them.
const Face* largest_face(std::span<const int> points, std::span<const Face* const> faces) {
  const Face* largest = nullptr;
  for (const Face* face : faces)
    if (!largest || face->points.size() > largest->points.size()) largest = face;
  return largest && largest->points.size() * 2 >= points.size() && largest->rms <= 2.0 ? largest : nullptr;
}

/// m: standard deviation of a face's points along a direction.
double spread_along(const Observation& seen, const Face& face, const Vec3& along) {
  double mean = 0, squares = 0;
  for (const int i : face.points) {
    const double a = along.dot(seen.points[i] - face.center);
    mean += a;
    squares += a * a;
  }
  const double count = static_cast<double>(face.points.size());
  return std::sqrt(std::max(squares / count - mean * mean / (count * count), 0.0));
}

/// Standard errors (rad) of a face's direction in the plane of its normal and `along`.
struct DirectionError {
  double noise = 0, systematic = 0;
  double all() const { return std::hypot(noise, systematic); }
};

/// Noise of neighbouring pixels is not independent: about one point in ten counts.
DirectionError direction_error(const Observation& seen, const Face& face, const Vec3& along) {
  double sigma = 0;
  for (const int i : face.points) sigma += seen.graph.sigma[i];
  const double count = static_cast<double>(face.points.size()), spread = spread_along(seen, face, along);
  return {sigma / count / (spread * std::sqrt(count / 10.0)), kSystematic * 0.05 / spread};
}

/// The level or upright direction that a face's normal leans from, if it clearly leans.
std::optional<Vec3> leans_from(const Observation& seen, const Face& face, double sigmas) {
  const Vec3& n = face.plane.normal;
  const bool flat = std::abs(n.z()) > 0.5;
  const Vec3 level = flat ? Vec3(0, 0, n.z() < 0.0 ? -1.0 : 1.0) : Vec3(n.x(), n.y(), 0.0).normalized();
  const double lean = line_angle(level, n);
  const DirectionError error = direction_error(seen, face, (level - level.dot(n) * n).normalized());
  if (lean < kLeastSlant || lean < sigmas * error.all() || error.noise > kVagueLean) return std::nullopt;
  return level;
}

/// Up-aligned axes turned to a largest face that leans, if it clearly does.
Mat3 leant(const Observation& seen, std::span<const int> points, std::span<const Face* const> faces, const Mat3& axes) {
  const Face* largest = largest_face(points, faces);
  const auto level = largest ? leans_from(seen, *largest, kLeanSigmas) : std::nullopt;
  if (!level || line_angle(*level, largest->plane.normal) > kMostLean) return axes;
  return turn_between(*level, largest->plane.normal).toRotationMatrix() * axes;
}

/// How far faces are from lying across axes, in standard errors: the sum of the squares. What lies along none of them counts as if it just did.
double misfit(const Observation& seen, std::span<const Face* const> faces, const Mat3& axes) {
  double sum = 0;
  for (const Face* face : faces) {
    const Vec3& n = face->plane.normal;
    int nearest = 0;
    (axes.transpose() * n).cwiseAbs().maxCoeff(&nearest);
    const Vec3 axis = axes.col(nearest), off = axis - axis.dot(n) * n;
    if (off.norm() > 1e-9) sum += std::pow(std::min(line_angle(axis, n), kMostAskew) / direction_error(seen, *face, off.normalized()).all(), 2);
  }
  return sum;
}

/// The ground or desk on which things at a place stand: the nearest below it.
const Support* carrier_of(const Observation& seen, const Vec3& place) {
  const Support* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const Support& support : seen.supports) {
    if (support.kind != SupportKind::ground && support.kind != SupportKind::desk) continue;
    const double above = support.plane.signed_distance(place);
    if (support.plane.normal.z() < kSteepest || above < 0.0 || above >= least) continue;
    const std::vector<Vec2> plan = plan_of(support);
    if (support.kind == SupportKind::desk && !plan.empty() && !inside_convex(plan, place.head<2>())) continue;
    least = above, nearest = &support;
  }
  return nearest;
}

/// Up-aligned axes, or the same turned like what carries these faces, if that slopes and they follow it as well.
Mat3 as_carried(const Observation& seen, std::span<const Face* const> faces, const Mat3& level, const Mat3& axes) {
  if (faces.empty()) return axes;
  Vec3 place = Vec3::Zero();
  for (const Face* face : faces) place += face->center / static_cast<double>(faces.size());
  const Support* carrier = carrier_of(seen, place);
  if (!carrier || line_angle(carrier->plane.normal, Vec3::UnitZ()) < kLeastSlant) return axes;
  const Mat3 carried = turn_between(Vec3::UnitZ(), carrier->plane.normal).toRotationMatrix() * level;
  return misfit(seen, faces, carried) <= misfit(seen, faces, axes) ? carried : axes;
}

/// Axes of the two largest orthogonal faces, or of the largest and the rectangle around its points.
Mat3 free_axes(const Observation& seen, std::vector<const Face*> faces) {
  std::stable_sort(faces.begin(), faces.end(), [](const Face* a, const Face* b) { return a->area > b->area; });
  const Vec3 primary = faces.front()->plane.normal;
  // What stands or leans is hardly turned within its plane: that takes more than a small face to tell.
  const Vec3 level = Vec3::UnitZ().cross(primary);
  const auto is_turned = [&](const Face& face) {
    const double along = std::abs(level.normalized().dot(face.plane.normal));
    return std::min(along, std::sqrt(1.0 - std::min(along * along, 1.0))) > kTurnedSine;
  };
  Vec3 secondary = Vec3::Zero();
  for (std::size_t f = 1; f < faces.size() && secondary.isZero(); ++f) {
    const Face& face = *faces[f];
    if (std::abs(face.plane.normal.dot(primary)) >= kUprightSine || face.width <= 0.004) continue;
    secondary = level.norm() > kStandingSine && face.area < kTurningArea * faces.front()->area && is_turned(face) ? level : face.plane.normal;
  }
  if (secondary.isZero()) {
    const Vec3 u = any_orthogonal(primary), v = primary.cross(u);
    std::vector<Vec2> flat;
    for (const int i : faces.front()->points) flat.emplace_back(u.dot(seen.points[i]), v.dot(seen.points[i]));
    const double turn = rectangle_turn(flat);
    secondary = std::cos(turn) * u + std::sin(turn) * v;
  }
  secondary = (secondary - secondary.dot(primary) * primary).normalized();
  const std::array<Vec3, 3> raw{primary, secondary, primary.cross(secondary)};
  const auto z = std::max_element(raw.begin(), raw.end(), [](const Vec3& a, const Vec3& b) { return std::abs(a.z()) < std::abs(b.z()); });
  Mat3 axes;
  axes.col(2) = z->z() < 0.0 ? Vec3(-*z) : *z;
  axes.col(0) = raw[(z - raw.begin() + 1) % 3];
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

/// What upright faces tell of the turn of a level box.
Vec2 turn_of_faces(const Observation& seen, std::span<const Face* const> faces) {
  Vec2 sum = Vec2::Zero();
  for (const Face& side : upright_sides(seen, faces)) {
    const Vec3& n = side.plane.normal;
    const Vec3 along(-n.y(), n.x(), 0.0);
    if (spread_along(seen, side, along) * std::sqrt(12.0) < kShortestForYaw) continue;
    const double error = direction_error(seen, side, along).all();
    sum += quarter_turn(std::atan2(n.y(), n.x()), 1.0 / (error * error));
  }
  return sum;
}

Mat3 level_axes(const Observation& seen, const DepthView& view, std::span<const int> points, std::span<const Face* const> faces) {
  const auto angle = [](const Vec2& sum) { return 0.25 * std::atan2(sum.y(), sum.x()); };
  const Vec2 turn = turn_of_faces(seen, faces);
  double yaw = angle(turn);
  Vec2 told = turn_of_outline(seen, view, faces, yaw);
  if (turn.norm() < kEnoughInformation) {
    std::vector<Vec2> flat;
    for (const int i : points) flat.emplace_back(seen.points[i].x(), seen.points[i].y());
    const double rectangle = rectangle_turn(flat);
    const Vec2 other = turn_of_outline(seen, view, faces, rectangle);
    if (told.isZero() || (turn + other).norm() > (turn + told).norm()) yaw = rectangle, told = other;
    Vec2 clearest = told;  // the rectangle follows the picture's border where that cuts the top off
    for (int k = 0; k < kTurns; ++k)
      if (const Vec2 edges = turn_of_outline(seen, view, faces, 0.5 * kPi * k / kTurns); (turn + edges).norm() > (turn + clearest).norm()) clearest = edges;
    if ((turn + clearest).norm() > kClearer * (turn + told).norm()) told = clearest;
  }
  if (!told.isZero()) yaw = angle(turn + told);
  const Mat3 level = turned(std::remainder(yaw, 0.5 * kPi));
  return as_carried(seen, faces, level, leant(seen, points, faces, level));
}

}  // namespace

bool is_along(const Face& face, const Mat3& axes) { return (axes.transpose() * face.plane.normal).cwiseAbs().maxCoeff() > kAlignedCosine; }

double explained_share(std::span<const int> points, std::span<const Face* const> faces, const Mat3& axes) {
  std::size_t count = 0;
  for (const Face* face : faces)
    if (is_along(*face, axes)) count += face->points.size();
  return static_cast<double>(count) / static_cast<double>(points.size());
}

Mat3 box_axes(const Observation& seen, const DepthView& view, std::span<const int> points, std::span<const Face* const> faces, bool free_orientation) {
  if (faces.empty()) return level_axes(seen, view, points, faces);
  const Mat3 free = free_axes(seen, {faces.begin(), faces.end()});
  if (free_orientation) return free;
  const Mat3 level = level_axes(seen, view, points, faces);
  const double share = explained_share(points, faces, free);
  if (share < kEnoughExplained || share < explained_share(points, faces, level) + kMuchMore) return level;
  const bool leans = std::any_of(faces.begin(), faces.end(), [&](const Face* face) { return leans_from(seen, *face, kSlantSigmas).has_value(); });
  if (leans) return free;
  const Mat3 flat = turned(std::atan2(free(1, 0), free(0, 0)));
  return as_carried(seen, faces, flat, flat);
}

}  // namespace unseen::cuboids
