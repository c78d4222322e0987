// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/surfaces/levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/linear.h"
#include "unseen/core/convex.h"
#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr std::size_t kMostFitPoints = 15000;

/// m: how far a point may lie from a support that it belongs to.
double tolerance_at(const Scan& scan, const Face& face) {
  return 4.0 * scan.graph.sigma[face.points[face.points.size() / 2]];
}

/// The plane of a given normal through the middle of points.
Plane plane_through(const Scan& scan, const std::vector<int>& points, const Vec3& normal) {
  std::vector<double> heights;
  for (const int i : points) heights.push_back(normal.dot(scan.points[i]));
  return {normal, median(std::move(heights))};
}

}  // namespace

std::vector<int> points_of(const Scan& scan, const std::vector<int>& faces) {
  std::vector<int> points;
  for (const int f : faces)
    points.insert(points.end(), scan.faces.faces[f].points.begin(), scan.faces.faces[f].points.end());
  return points;
}

double tilt_error(const Scan& scan, std::span<const int> points) {
  constexpr double kIndependent = 0.1;       // of the points: noise of neighbours is alike
  constexpr double kSystematic = 0.001;      // m, across the points: warps of the sensor
  const double count = static_cast<double>(points.size());
  Vec3 mean = Vec3::Zero();
  double sigma = 0;
  for (const int i : points) mean += scan.points[i] / count, sigma += scan.graph.sigma[i] / count;
  Mat3 second = Mat3::Zero();
  for (const int i : points) second += (scan.points[i] - mean) * (scan.points[i] - mean).transpose() / count;
  const double spread = std::sqrt(std::max(symmetric_eigen(second).values[1], 1e-12));
  return std::hypot(sigma / (spread * std::sqrt(kIndependent * count)), kSystematic / spread);
}

std::vector<Level> coplanar(const Scan& scan, std::vector<int> faces) {
  std::stable_sort(faces.begin(), faces.end(),
                   [&](int a, int b) { return scan.faces.faces[a].area > scan.faces.faces[b].area; });
  std::vector<Level> levels;
  for (const int f : faces) {
    const Face& face = scan.faces.faces[f];
    auto level = std::find_if(levels.begin(), levels.end(), [&](const Level& l) {
      return l.plane.normal.dot(face.plane.normal) > kHorizontal &&
             std::abs(l.plane.signed_distance(face.center)) < std::max(tolerance_at(scan, face), 0.005);
    });
    if (level == levels.end()) level = levels.insert(level, Level{face.plane, 0, 0, {}, {}});
    level->faces.push_back(f);
    level->area += face.area;
  }
  for (Level& level : levels) level.plane = fit_support(scan, points_of(scan, level.faces));
  return levels;
}

double level_with_surest(const Scan& scan, const std::vector<Level>& levels, Level& ground) {
  constexpr double kVague = 0.015, kSurer = 0.5;  // rad; of the ground's error
  const std::vector<int> points = points_of(scan, ground.faces);
  const double own = tilt_error(scan, points);
  if (own < kVague) return own;
  double least = kSurer * own;
  const Level* surest = nullptr;
  for (const Level& level : levels)
    if (const double error = tilt_error(scan, points_of(scan, level.faces)); error < least) least = error, surest = &level;
  if (surest == nullptr) return own;
  ground.plane = plane_through(scan, points, surest->plane.normal);
  return least;
}

void level_with_ground(const Scan& scan, const Vec3& normal, double error, Level& desk) {
  constexpr double kLeaning = 6.0 * kPi / 180.0;
  if (line_angle(desk.plane.normal, normal) > kLeaning) return;
  const std::vector<int> points = points_of(scan, desk.faces);
  if (tilt_error(scan, points) > error) desk.plane = plane_through(scan, points, normal);
}

Plane fit_support(const Scan& scan, std::span<const int> points) {
  const std::size_t step = points.size() / kMostFitPoints + 1;
  Vec3 solution = Vec3::Zero();
  Plane plane;
  double scale = std::numeric_limits<double>::infinity();
  for (int round = 0; round < 3; ++round) {
    Mat3 normal_matrix = Mat3::Zero();
    Vec3 right = Vec3::Zero(), mean = Vec3::Zero();
    Mat3 second = Mat3::Zero();
    double weights = 0;
    std::vector<double> residuals;
    const Vec3 origin = scan.points[points[0]];
    for (std::size_t k = 0; k < points.size(); k += step) {
      const Vec3& p = scan.points[points[k]];
      const double w = 1.0 / (double(scan.graph.sigma[points[k]]) * scan.graph.sigma[points[k]]);
      const Vec3 ray = p / p.z();
      const double r = round == 0 ? 0.0
                       : scan.is_image ? std::abs(ray.dot(solution) - 1.0 / p.z())
                                       : std::abs(plane.signed_distance(p)) * std::sqrt(w);
      residuals.push_back(r);
      if (r > 3.0 * scale) continue;
      normal_matrix += ray * ray.transpose();
      right += ray / p.z();
      const Vec3 d = p - origin;
      mean += w * d;
      second += w * d * d.transpose();
      weights += w;
    }
    if (scan.is_image) {
      solution = solve_symmetric(normal_matrix, right);
      plane = {-solution.normalized(), -1.0 / solution.norm()};
    } else {
      mean /= weights;
      Vec3 n = symmetric_eigen<3>(second / weights - mean * mean.transpose()).vectors.col(0);
      if (n.dot(origin + mean) > 0.0) n = -n;
      plane = {n, n.dot(origin + mean)};
    }
    if (round > 0) scale = 1.4826 * median(std::move(residuals));
  }
  return plane;
}

void set_outline(const Scan& scan, Level& level, const Vec3& u, const Vec3& v) {
  constexpr int kColumns = 512;
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

std::vector<Vec3> lifted(const Level& level, const Vec3& u, const Vec3& v) {
  const Vec3 along = u.cross(v);  // the outline was seen along it: the plane may lean against it
  std::vector<Vec3> outline;
  for (const Vec2& p : level.outline) {
    const Vec3 place = p.x() * u + p.y() * v;
    outline.push_back(place - level.plane.signed_distance(place) / level.plane.normal.dot(along) * along);
  }
  return outline;
}

}  // namespace unseen::cuboids
