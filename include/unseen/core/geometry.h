// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

namespace unseen {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Vec3f = Eigen::Vector3f;
using Mat3 = Eigen::Matrix3d;

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double degrees(double radians) { return radians * (180.0 / kPi); }
inline constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }

/// Infinite plane { p : normal·p = offset }. `normal` has unit length, `offset` is in metres.
struct Plane {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0.0;

  double signed_distance(const Vec3& p) const { return normal.dot(p) - offset; }
  Vec3 project(const Vec3& p) const { return p - signed_distance(p) * normal; }
};

/// Angle between two lines (directions without sign), in [0, π/2] radians. Accurate for tiny angles,
/// where acos of the dot product is not.
inline double line_angle(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), std::abs(a.dot(b)));
}

/// The matrix of v × ·.
inline Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// Area of the parallelogram of two vectors in the plane; positive if b lies to the left of a.
inline double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Twice the area of a triangle in the plane; positive if its corners run counter-clockwise.
inline double turn(const Vec2& a, const Vec2& b, const Vec2& c) { return cross(b - a, c - a); }

/// A unit vector orthogonal to unit vector `n`; the same one for the same `n` on every machine.
inline Vec3 any_orthogonal(const Vec3& n) {
  const Vec3 axis = std::abs(n.x()) <= std::abs(n.y()) && std::abs(n.x()) <= std::abs(n.z()) ? Vec3::UnitX()
                    : std::abs(n.y()) <= std::abs(n.z())                                    ? Vec3::UnitY()
                                                                                            : Vec3::UnitZ();
  return n.cross(axis).normalized();
}

/// Rigid transform: x ↦ rotation·x + translation. Named by what it maps, e.g. `T_world_camera` takes
/// camera coordinates to world coordinates.
struct RigidTransform {
  Mat3 rotation = Mat3::Identity();
  Vec3 translation = Vec3::Zero();

  Vec3 operator*(const Vec3& p) const { return rotation * p + translation; }
  RigidTransform operator*(const RigidTransform& o) const {
    return {rotation * o.rotation, rotation * o.translation + translation};
  }
  RigidTransform inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
  /// True if `rotation` is orthonormal and right-handed within `tolerance` and everything is finite.
  bool is_rigid(double tolerance = 1e-3) const {
    return rotation.allFinite() && translation.allFinite() &&
           (rotation.transpose() * rotation - Mat3::Identity()).cwiseAbs().maxCoeff() < tolerance &&
           rotation.determinant() > 0.0;
  }
};

/// Box with its own axes: columns of `axes` are unit and right-handed; `half_size` in metres.
struct OrientedBox {
  Vec3 center = Vec3::Zero();
  Mat3 axes = Mat3::Identity();
  Vec3 half_size = Vec3::Zero();

  bool contains(const Vec3& p) const {
    return ((axes.transpose() * (p - center)).cwiseAbs() - half_size).maxCoeff() <= 0.0;
  }
  double volume() const { return 8.0 * half_size.prod(); }
};

/// Pinhole camera, OpenCV convention: x right, y down, z forward; pixel (0,0) is the centre of the
/// first pixel. Focal lengths and principal point in pixels.
struct Camera {
  double fx = 0, fy = 0, cx = 0, cy = 0;
  int width = 0, height = 0;

  /// Camera coordinates (m) of pixel (u,v) at `depth` metres along the optical axis.
  Vec3 unproject(double u, double v, double depth) const {
    return {(u - cx) / fx * depth, (v - cy) / fy * depth, depth};
  }
  /// Pixel of a point in camera coordinates; the point must have z > 0.
  Vec2 project(const Vec3& p) const { return {fx * p.x() / p.z() + cx, fy * p.y() / p.z() + cy}; }
};

}  // namespace unseen
