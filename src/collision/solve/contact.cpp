// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/contact.h"

#include <algorithm>
#include <limits>

#include "collision/solve/minkowski.h"
#include "core/clip_convex.h"
#include "unseen/core/convex.h"

namespace unseen::collision {
namespace {

using Corners = std::vector<Vec3>;

Corners placed(const Solid& solid, const Vec3& p, const Quat& q) {
  Corners all;
  for (const Vec3& v : solid.hull.vertices) all.push_back(p + q * v);
  if (all.empty()) all.push_back(p);  // a sphere: its centre
  return all;
}

double lowest(const Corners& corners, const Vec3& n) {
  double low = std::numeric_limits<double>::infinity();
  for (const Vec3& c : corners) low = std::min(low, n.dot(c));
  return low;
}

/// The corners that are lowest along `n`, within the tolerance.
Corners lowest_corners(const Corners& corners, const Vec3& n, double tolerance) {
  const double limit = lowest(corners, n) + tolerance;
  Corners low;
  for (const Vec3& c : corners)
    if (n.dot(c) <= limit) low.push_back(c);
  return low;
}

constexpr double kFlat = 1e-14;  // m²: a corner nearer to a side than rounding

using Polygon = std::vector<Vec2>;

/// The part of a convex polygon (or segment, or point) within another convex one, widened by `margin`.
Polygon within(Polygon subject, const Polygon& window, double margin) {
  for (std::size_t i = 0; i < window.size() && window.size() >= 3; ++i) {
    const Vec2 along = (window[(i + 1) % window.size()] - window[i]).normalized(), inward(-along.y(), along.x());
    subject = clip_convex(subject, [&](const Vec2& p) { return -inward.dot(p - window[i]) - margin; });
  }
  return subject;
}

/// Where two segments cross, or come nearest.
Vec2 crossing(const Polygon& a, const Polygon& b) {
  const Vec2 u = a[1] - a[0], v = b[1] - b[0], w = b[0] - a[0];
  const double d = u.x() * v.y() - u.y() * v.x();
  const double s = std::clamp((w.x() * v.y() - w.y() * v.x()) / d, 0.0, 1.0), t = std::clamp((w.x() * u.y() - w.y() * u.x()) / d, 0.0, 1.0);
  return 0.5 * (a[0] + s * u + b[0] + t * v);
}

bool parallel(const Polygon& a, const Polygon& b) {
  const Vec2 u = (a[1] - a[0]).normalized(), v = (b[1] - b[0]).normalized();
  return std::abs(u.x() * v.y() - u.y() * v.x()) < 0.1;
}

/// What the two nearest features have in common, seen along the normal.
Polygon common(const Polygon& a, const Polygon& b, double tolerance) {
  if (a.size() == 1) return a;
  if (b.size() == 1) return b;
  if (a.size() == 2 && b.size() == 2 && !parallel(a, b)) return {crossing(a, b)};
  const Polygon &small = a.size() < b.size() ? a : b, &large = a.size() < b.size() ? b : a;
  if (large.size() >= 3) return within(small, large, tolerance);
  // two segments side by side: the part of one that lies beside the other
  const Vec2 along = (large[1] - large[0]).normalized();
  const auto at = [&](const Vec2& p) { return along.dot(p - large[0]); };
  const double length = at(large[1]);
  const double from = std::clamp(std::min(at(small[0]), at(small[1])), 0.0, length), to = std::clamp(std::max(at(small[0]), at(small[1])), 0.0, length);
  return {large[0] + along * from, large[0] + along * to};
}

/// A polygon of corners about the contact, as a feature.
Feature feature_of(const Polygon& polygon, const Vec2& center, const Vec3& point, const Vec3& n, const Vec3& e1, const Vec3& e2) {
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  for (const Vec2& p : polygon) spread += (p - center) * (p - center).transpose();
  const double turn = 0.5 * std::atan2(2.0 * spread(0, 1), spread(0, 0) - spread(1, 1));
  Feature feature;
  feature.point = point;
  feature.axes.col(0) = n;
  feature.axes.col(1) = std::cos(turn) * e1 + std::sin(turn) * e2;
  feature.axes.col(2) = n.cross(feature.axes.col(1));
  for (const Vec2& p : polygon) {
    const Vec3 off = e1 * (p - center).x() + e2 * (p - center).y();
    for (int i = 1; i < 3; ++i) feature.extent[i] = std::max(feature.extent[i], std::abs(feature.axes.col(i).dot(off)));
  }
  if (polygon.size() == 1) feature.extent.setZero();
  if (polygon.size() == 2) feature.extent[2] = 0.0;
  return feature;
}

/// Points and features of a contact along `n` between what is nearest to it.
void locate(const Corners& a, const Corners& b, double tolerance, Proximity& near) {
  const Vec3& n = near.normal;
  const Vec3 e1 = any_orthogonal(n), e2 = n.cross(e1);
  const auto flat = [&](const Corners& corners) {
    Polygon polygon;
    for (const Vec3& c : corners) polygon.push_back({e1.dot(c), e2.dot(c)});
    return convex_hull(polygon, kFlat);
  };
  const Polygon low = flat(lowest_corners(a, n, tolerance)), high = flat(lowest_corners(b, -n, tolerance));
  Polygon patch = common(low, high, tolerance);
  if (patch.empty()) patch = {0.5 * (low[0] + high[0])};
  Vec2 center = Vec2::Zero();
  for (const Vec2& p : patch) center += p / static_cast<double>(patch.size());
  const Vec3 middle = e1 * center.x() + e2 * center.y();
  near.point_a = middle + n * lowest(a, n);
  near.point_b = middle - n * lowest(b, -n);
  near.features = {feature_of(low, low.size() == 1 ? low[0] : center, low.size() == 1 ? Vec3(e1 * low[0].x() + e2 * low[0].y() + n * lowest(a, n)) : near.point_a, n, e1, e2),
                   feature_of(high, high.size() == 1 ? high[0] : center, high.size() == 1 ? Vec3(e1 * high[0].x() + e2 * high[0].y() - n * lowest(b, -n)) : near.point_b, n, e1, e2)};
}

}  // namespace

Proximity contact_along(const Solid& a, const Vec3& p_a, const Quat& q_a, const Solid& b, const Vec3& p_b, const Quat& q_b, const MinkowskiFace& face,
                        double tolerance) {
  Proximity near;
  near.normal = face.normal;
  near.law = face.law;
  near.gap = face.normal.dot(p_a - p_b) - face.reach - a.radius - b.radius;
  locate(placed(a, p_a, q_a), placed(b, p_b, q_b), tolerance, near);
  near.point_a -= a.radius * near.normal;
  near.point_b += b.radius * near.normal;
  return near;
}

std::optional<Proximity> nearest(const Solid& a, const Vec3& p_a, const Quat& q_a, const Solid& b, const Vec3& p_b, const Quat& q_b,
                                 double tolerance) {
  if (!a.known_shape || !b.known_shape) return std::nullopt;
  const Vec3 apart = p_a - p_b;
  std::vector<MinkowskiFace> faces = minkowski_faces(a.hull, q_a, b.hull, q_b);
  if (a.is_sphere() || b.is_sphere())
    for (const MinkowskiFace& face : round_faces(a, q_a, b, q_b, apart)) faces.push_back(face);
  const MinkowskiFace* best = nullptr;
  const auto gap = [&](const MinkowskiFace& face) { return face.normal.dot(apart) - face.reach; };
  for (const MinkowskiFace& face : faces)
    if (!best || gap(face) > gap(*best) + 1e-12) best = &face;
  if (!best) return std::nullopt;  // the centres of two spheres coincide
  return contact_along(a, p_a, q_a, b, p_b, q_b, *best, tolerance);
}

Proximity nearest_to_plane(const Solid& a, const Vec3& p_a, const Quat& q_a, const Vec3& normal, double tolerance) {
  Proximity near;
  near.normal = normal;
  near.law.a = normal;
  const Corners corners = placed(a, p_a, q_a), low = lowest_corners(corners, normal, tolerance);
  locate(corners, low, tolerance, near);
  near.point_a -= a.radius * normal;
  near.point_b = near.point_a;
  return near;
}

}  // namespace unseen::collision
