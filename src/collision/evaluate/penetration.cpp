// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/evaluate/penetration.h"

#include <BulletCollision/CollisionShapes/btConvexHullShape.h>
#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>

#include <algorithm>
#include <limits>

#include "unseen/collision/body_mesh.h"

namespace unseen::collision {
namespace {

/// The convex hull of points, grown by a radius: a ball is a point that is grown.
struct Rounded {
  std::vector<Vec3> points;
  double radius = 0;
};

Rounded rounded(const Body& body) {
  if (body.shape == Shape::sphere) return {{Vec3::Zero()}, body.radius};
  if (body.shape == Shape::size) return {{Vec3::Zero()}, 0.5 * body.size};
  return {body_mesh(body, body.name).vertices, 0.0};
}

btTransform transform_of(const RigidTransform& pose) {
  const Mat3& R = pose.rotation;
  const Vec3& p = pose.translation;
  const btMatrix3x3 axes(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2));
  return btTransform(axes, {p.x(), p.y(), p.z()});
}

btConvexHullShape hull_of(const std::vector<Vec3>& points) {
  btConvexHullShape hull;
  for (const Vec3& p : points) hull.addPoint({p.x(), p.y(), p.z()}, false);
  hull.recalcLocalAabb();
  hull.setMargin(0);
  return hull;
}

}  // namespace

double penetration(const Body& a, const RigidTransform& pose_a, const Body& b, const RigidTransform& pose_b) {
  const Rounded first = rounded(a), second = rounded(b);
  const btConvexHullShape hull_a = hull_of(first.points), hull_b = hull_of(second.points);
  const btTransform at_a = transform_of(pose_a), at_b = transform_of(pose_b);
  const Vec3 apart = pose_a.translation - pose_b.translation;
  const btVector3 guess(apart.x(), apart.y(), apart.z());
  btGjkEpaSolver2::sResults found;
  double distance = 0.0;
  if (btGjkEpaSolver2::Distance(&hull_a, at_a, &hull_b, at_b, guess, found))
    distance = found.distance;
  else if (btGjkEpaSolver2::Penetration(&hull_a, at_a, &hull_b, at_b, guess, found, false))
    distance = -std::abs(found.distance);
  return first.radius + second.radius - distance;
}

double penetration(const Body& body, const RigidTransform& pose, const Plane& plane) {
  const Rounded shape = rounded(body);
  double lowest = std::numeric_limits<double>::infinity();
  for (const Vec3& p : shape.points) lowest = std::min(lowest, plane.signed_distance(pose * p));
  return shape.radius - lowest;
}

}  // namespace unseen::collision
