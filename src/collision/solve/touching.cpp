// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/touching.h"

#include <cmath>
#include <limits>

#include "collision/solve/minkowski.h"

namespace unseen::collision {
namespace {

constexpr double kGrazing = 1e-3;  // cosine between direction and normal

}  // namespace

Touchings::Touchings(const Solid& a, const Quat& q_a, const Solid& b, const Quat& q_b)
    : a_(a), b_(b), q_a_(q_a), q_b_(q_b), tolerance_(0.01 * (a.mass.extent + b.mass.extent)) {
  if (!a.is_sphere() && !b.is_sphere()) faces_ = minkowski_faces(a.hull, q_a, b.hull, q_b);
}

/// A ray from inside leaves the Minkowski difference through the nearest face.
std::optional<Proximity> Touchings::of_polytopes(const Vec3& direction, double& distance) const {
  const MinkowskiFace* first = nullptr;
  distance = std::numeric_limits<double>::infinity();
  for (const MinkowskiFace& face : faces_) {
    const double slope = face.normal.dot(direction);
    if (slope > kGrazing && face.reach < distance * slope) distance = face.reach / slope, first = &face;
  }
  if (!first) return std::nullopt;
  return contact_along(a_, distance * direction, q_a_, b_, Vec3::Zero(), q_b_, *first, tolerance_);
}

/// From far off, where the gap is convex along the ray: Newton's steps come down from one side.
std::optional<Proximity> Touchings::with_a_sphere(const Vec3& direction, double& distance) const {
  constexpr int kSteps = 24;
  const double size = a_.mass.extent + b_.mass.extent, near_enough = 1e-9 * size;
  distance = size;
  for (int step = 0; step < kSteps; ++step) {
    const std::optional<Proximity> near = nearest(a_, distance * direction, q_a_, b_, Vec3::Zero(), q_b_, tolerance_);
    if (!near || std::abs(near->gap) < near_enough) return near;
    const double slope = near->normal.dot(direction);
    if (slope < kGrazing) return std::nullopt;
    distance -= near->gap / slope;
  }
  return std::nullopt;
}

std::optional<Touching> Touchings::along(const Vec3& direction) const {
  double distance = 0.0;
  const std::optional<Proximity> near = faces_.empty() ? with_a_sphere(direction, distance) : of_polytopes(direction, distance);
  if (!near) return std::nullopt;
  const Vec3 x = 0.5 * (near->point_a + near->point_b), offset = distance * direction;
  return Touching{offset, x - offset, x, near->normal};
}

}  // namespace unseen::collision
