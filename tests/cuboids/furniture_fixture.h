// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <vector>

#include "cuboids/photo_fixture.h"
#include "unseen/core/random.h"

namespace unseen::cuboids::furniture_fixture {

using photo_fixture::box_at;

/// Seat, back and four legs; the back is at +y, the middle of the seat over the origin.
inline std::vector<OrientedBox> chair() {
  std::vector<OrientedBox> boxes = {box_at({0, 0, 0.42}, {0.46, 0.44, 0.05}), box_at({0, 0.2, 0.47}, {0.46, 0.04, 0.42})};
  for (const double x : {-0.2, 0.2})
    for (const double y : {-0.19, 0.19}) boxes.push_back(box_at({x, y, 0}, {0.05, 0.05, 0.42}));
  return boxes;
}

inline std::vector<OrientedBox> sofa() {
  return {box_at({0, 0, 0}, {1.6, 0.8, 0.4}), box_at({0, 0.32, 0.4}, {1.6, 0.16, 0.4}), box_at({-0.72, -0.08, 0.4}, {0.16, 0.64, 0.18}),
          box_at({0.72, -0.08, 0.4}, {0.16, 0.64, 0.18})};
}

inline std::vector<OrientedBox> table() {
  std::vector<OrientedBox> boxes = {box_at({0, 0, 0.68}, {1.2, 0.7, 0.04})};
  for (const double x : {-0.55, 0.55})
    for (const double y : {-0.3, 0.3}) boxes.push_back(box_at({x, y, 0}, {0.06, 0.06, 0.68}));
  return boxes;
}

inline std::vector<OrientedBox> moved(std::vector<OrientedBox> boxes, const RigidTransform& T) {
  for (OrientedBox& box : boxes) {
    box.center = T * box.center;
    box.axes = T.rotation * box.axes;
  }
  return boxes;
}

inline RigidTransform upright(double yaw, const Vec3& translation) {
  return {Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix(), translation};
}

/// Points spread over the outer faces.
inline std::vector<Vec3> samples(const std::vector<OrientedBox>& boxes, std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<double> up_to;
  double area = 0.0;
  for (const OrientedBox& box : boxes)
    for (int k = 0; k < 3; ++k) up_to.push_back(area += box.half_size[(k + 1) % 3] * box.half_size[(k + 2) % 3]);
  std::vector<Vec3> out;
  while (out.size() < count) {
    const std::size_t face = std::upper_bound(up_to.begin(), up_to.end(), random.uniform(0.0, area)) - up_to.begin();
    const OrientedBox& box = boxes[std::min(face, up_to.size() - 1) / 3];
    Vec3 p;
    for (int k = 0; k < 3; ++k) p[k] = random.uniform(-1.0, 1.0) * box.half_size[k];
    const int k = static_cast<int>(face % 3);
    p[k] = random.uniform() < 0.5 ? -box.half_size[k] : box.half_size[k];
    const Vec3 world = box.center + box.axes * p;
    const bool inside = std::any_of(boxes.begin(), boxes.end(), [&](const OrientedBox& other) {
      return ((other.axes.transpose() * (world - other.center)).cwiseAbs() - other.half_size).maxCoeff() < -1e-6;
    });
    if (!inside) out.push_back(world);
  }
  return out;
}

/// Stands 2 m south of the origin and looks at what stands there.
inline RigidTransform camera_pose() {
  const Vec3 eye(0.3, -2.3, 1.4), forward = (Vec3(0.0, 0.2, 0.35) - eye).normalized(), right = forward.cross(Vec3::UnitZ()).normalized();
  RigidTransform T;
  T.rotation << right, forward.cross(right), forward;
  T.translation = eye;
  return T;
}

}  // namespace unseen::cuboids::furniture_fixture
