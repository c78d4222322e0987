// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

inline constexpr double kGravity = 9.81;  // m/s²

inline Cuboid sample_box(int id, const Vec3& center, double yaw, const Vec3& size) {
  Cuboid c;
  c.id = id;
  c.box = {center, Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix(), 0.5 * size};
  c.initial = c.box;
  c.visible_points = 100u + static_cast<std::size_t>(id);
  return c;
}

/// A contact at the corners of a level rectangle that bears `weight`.
inline Contact sample_contact(int a, int b, const Vec3& center, double half, double weight) {
  Contact t;
  t.a = a;
  t.b = b;
  for (const double x : {-half, half})
    for (const double y : {-half, half}) {
      t.points.push_back(center + Vec3(x, y, 0));
      t.forces.push_back({0, 0, weight / 4});
    }
  return t;
}

/// A table with two stacked boxes, the lower one completed down to the table, and a third box that is fixed to the
/// wall behind.
inline Completion sample_completion() {
  Completion c;
  const double tilt = 0.5;
  c.T_world_camera.rotation.col(0) = Vec3::UnitX();
  c.T_world_camera.rotation.col(1) = Vec3(0, -std::sin(tilt), -std::cos(tilt));
  c.T_world_camera.rotation.col(2) = Vec3(0, std::cos(tilt), -std::sin(tilt));
  c.T_world_camera.translation = {0, 0, 0.7};
  Support desk, wall;
  desk.id = 0;
  desk.kind = SupportKind::desk;
  desk.outline = {{-0.6, 0.5, 0}, {0.6, 0.5, 0}, {0.6, 1.5, 0}, {-0.6, 1.5, 0}};
  wall.id = 1;
  wall.kind = SupportKind::wall;
  wall.plane = {-Vec3::UnitY(), -1.6};
  c.supports = {desk, wall};
  c.cuboids = {sample_box(2, {0.1, 1.0, 0.1}, 0.3, {0.3, 0.2, 0.2}),
               sample_box(3, {0.1, 1.0, 0.27}, 0.5, {0.2, 0.16, 0.14}),
               sample_box(7, {-0.2, 1.5, 0.6}, 0.0, {0.4, 0.2, 0.05})};
  c.cuboids[0].initial.center.z() = 0.16;  // seen: the upper 8 cm
  c.cuboids[0].initial.half_size.z() = 0.04;
  c.cuboids[1].label = "tea & <co> \"1\"";
  c.cuboids[1].density = 1.0 / 3.0 * 1000.0;
  c.cuboids[2].by_symmetry = true;
  const double upper = c.cuboids[1].mass() * kGravity, lower = c.cuboids[0].mass() * kGravity;
  Contact hung;
  hung.a = 1;
  hung.b = 7;
  hung.kind = ContactKind::fixed;
  hung.direction = -Vec3::UnitY();
  hung.points = {{-0.2, 1.6, 0.6}};
  c.contacts = {sample_contact(0, 2, {0.1, 1.0, 0}, 0.09, lower + upper),
                sample_contact(2, 3, {0.1, 1.0, 0.2}, 0.07, upper), hung};
  c.stability = {1.0 / 3.0 * 1e-9, true, 0.25, 0.1};
  c.fixed_contacts = 1;
  c.extended_volume = 0.3 * 0.2 * 0.12;
  c.may_move = {3};
  c.search = {17, 5, true};
  c.summary.seconds = {{"observe", 0.25}};
  c.summary.energy = {{"residual", 0.1}};
  c.summary.counts = {{"boxes", 3}};
  c.summary.warnings = {"one \"quoted\" <warning>"};
  return c;
}

/// A tower of `count` cubes of 10 cm on the ground, each shifted by `shift` and turned by 0.2 rad from the one below.
inline Completion sample_tower(int count, double shift) {
  Completion c;
  Support ground;
  ground.id = 0;
  c.supports = {ground};
  for (int i = 0; i < count; ++i) {
    c.cuboids.push_back(sample_box(i + 1, {shift * i, 1.0, 0.05 + 0.1 * i}, 0.2 * i, {0.1, 0.1, 0.1}));
    c.contacts.push_back(sample_contact(i, i + 1, {shift * i, 1.0, 0.1 * i}, 0.04, 0.3 * kGravity * (count - i)));
  }
  c.stability.stable = true;
  return c;
}

}  // namespace unseen::cuboids
