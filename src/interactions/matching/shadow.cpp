// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/matching/shadow.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace unseen::interactions {
namespace {

/// In the box's own axes: does the face of `axis` on side `sign` look at the camera?
bool looks_at(const Vec3& camera, const Vec3& half, int axis, double sign) { return sign * camera[axis] > half[axis]; }

}  // namespace

Shadow::Shadow(const OrientedBox& box, const Vec3& camera) {
  const Vec3 eye = box.axes.transpose() * (camera - box.center);
  const auto add = [&](const Vec3& normal, const Vec3& through) {
    const Vec3 world = box.axes * normal;
    planes_.push_back({world, world.dot(box.axes * through + box.center)});
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      if (looks_at(eye, box.half_size, axis, sign)) {
        const Vec3 normal = sign * Vec3::Unit(axis);
        add(normal, box.half_size[axis] * normal);
      }
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (const double su : {-1.0, 1.0})
      for (const double sv : {-1.0, 1.0}) {
        if (looks_at(eye, box.half_size, u, su) == looks_at(eye, box.half_size, v, sv)) continue;  // no edge of the outline
        Vec3 edge = Vec3::Zero();
        edge[u] = su * box.half_size[u];
        edge[v] = sv * box.half_size[v];
        Vec3 normal = Vec3::Unit(axis).cross(edge - eye);
        if (!(normal.norm() > 1e-12)) continue;
        normal.normalize();
        if (normal.dot(-eye) > 0) normal = -normal;  // the box's centre is inside
        add(normal, eye);
      }
  }
}

double Shadow::distance(const Vec3& point, Vec3* gradient) const {
  double largest = -1e9;
  for (const Plane& plane : planes_) {
    const double d = plane.signed_distance(point);
    if (d <= largest) continue;
    largest = d;
    if (gradient) *gradient = plane.normal;
  }
  return largest;
}

double occlusion_cost(const Vec3& joint, double confidence, const std::vector<Shadow>& shadows, Vec3* gradient) {
  constexpr double kFarthest = 1.0;  // m: "no objects" is no escape, and nothing is to pay more than that
  if (gradient) gradient->setZero();
  if (confidence >= 0.5) return 0;
  double nearest = kFarthest;
  Vec3 direction = Vec3::Zero();
  for (const Shadow& shadow : shadows) {
    Vec3 normal;
    const double d = shadow.distance(joint, &normal);
    if (d >= nearest) continue;
    nearest = d;
    direction = normal;
  }
  if (nearest <= 0) return 0;
  const double weight = (confidence - 0.5) * (confidence - 0.5);
  if (gradient && nearest < kFarthest) *gradient = 2 * weight * nearest * direction;
  return weight * nearest * nearest;
}

}  // namespace unseen::interactions
