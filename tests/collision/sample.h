// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/collision/types.h"

namespace unseen::collision {

/// A shot of a box and a ball that meet, and one of a ball that a floor throws back, with what a solver could say of them.
struct Sample {
  Shot shot;
  Reconstruction result;
};

inline RigidTransform sample_camera() {
  RigidTransform T;  // looks along +y, 0.1 rad down
  const double c = std::cos(0.1), s = std::sin(0.1);
  T.rotation << 1, 0, 0, 0, -s, c, 0, -c, -s;
  return T;
}

/// Free flight that is at `p` with `v` when `t` is 0, turning about `axis`.
inline BodyState sample_flight(const Vec3& p, const Vec3& v, const Vec3& axis, double t) {
  BodyState s;
  s.p = p + v * t - Vec3(0, 0, 0.5 * 9.81 * t * t);
  s.v = v - Vec3(0, 0, 9.81 * t);
  if (axis.norm() > 0) s.q = Quat(Eigen::AngleAxisd(axis.norm() * t, axis.normalized()));
  return s;
}

inline Sample sample_base() {
  Sample s;
  s.shot.name = "shot.json";
  s.shot.fps = 120.0;
  s.shot.camera.camera = {900, 900, 319.5, 239.5, 640, 480};
  s.result.T_world_camera = sample_camera();
  s.result.camera = s.shot.camera.camera;
  s.result.fps = 120.0;
  s.result.fits = true;
  s.result.terms = {{"projection", 0.9, 1}, {"size", 1.1, 0.1}};
  s.result.observability = {"motion along the view ray: weak"};
  s.result.reprojection_rms = 0.31;
  s.result.held_out_rms = 0.35;
  s.result.summary.seconds = {{"solve", 0.5}};
  s.result.summary.counts = {{"frames", 61}};
  return s;
}

/// Adds the residuals that the flights have when each centre was seen a quarter of a pixel to the right.
inline void add_sample_residuals(Reconstruction& r) {
  const RigidTransform T = r.T_world_camera.inverse();
  for (const FramePose& f : r.frames)
    for (int b = 0; b < 2; ++b)
      if (const auto& body = f.bodies[static_cast<std::size_t>(b)]) {
        const Vec2 p = r.camera.project(T * body->p);
        r.residuals.push_back({f.frame, b, p + Vec2(0.25, 0), p, f.frame % 5 != 0});
      }
}

/// They meet at t = 0.255 s (frame 30.6).
inline Sample sample_two_bodies() {
  Sample s = sample_base();
  Body box, ball;
  box.name = "box";
  box.shape = Shape::box;
  box.box = {0.2, 0.12, 0.08};
  ball.name = "ball";
  ball.radius = 0.05;
  s.shot.bodies = {box, ball};
  Reconstruction& r = s.result;
  const double t0 = 0.255;
  const Vec3 pa(-0.1, 3, 0.1), pb(0.05, 3, 0.1), va(1, 0, 0.3), vb(-0.8, 0, 0.2), J(-1.5, 0, 0);
  for (int f = 0; f <= 60; ++f) {
    const double tau = f / 120.0 - t0;
    const bool after = tau > 0;
    FramePose pose;
    pose.frame = f;
    pose.time = f / 120.0;
    pose.bodies[0] = sample_flight(pa, after ? Vec3(va + J) : va, after ? Vec3(0, 3, 0) : Vec3(0, 0, 5), tau);
    if (f >= 3) pose.bodies[1] = sample_flight(pb, after ? Vec3(vb - J / 1.25) : vb, Vec3::Zero(), tau);
    r.frames.push_back(pose);
  }
  Impact impact;
  impact.time = t0;
  impact.frame = 120.0 * t0;
  impact.restitution = {0.6, 0.02, 0.55, 0.64};
  impact.tangential_restitution = -0.1;
  impact.impulse = J;
  impact.contact_point = {0, 3, 0.1};
  impact.normal = -Vec3::UnitX();
  r.impacts = {impact};
  r.restitution = impact.restitution;
  r.mass_ratio = Estimate{1.25, 0.03, 1.19, 1.31};
  r.ambiguous = {{"another turn of the box", 0.4, 1.2, 1.5}};
  r.bodies.resize(2);
  r.bodies[0].name = "box";
  r.bodies[0].inertia = Vec3(0.0017, 0.0039, 0.0045);
  r.bodies[0].before = sample_flight(pa, va, Vec3::Zero(), 0);
  r.bodies[0].after = sample_flight(pa, va + J, Vec3::Zero(), 0);
  r.bodies[1].name = "ball";
  r.bodies[1].inertia = Vec3::Constant(0.001);
  r.bodies[1].before = sample_flight(pb, vb, Vec3::Zero(), 0);
  r.bodies[1].after = sample_flight(pb, vb - J / 1.25, Vec3::Zero(), 0);
  r.energy_before = 0.9;
  r.energy_after = 0.7;
  r.drag = 0.01;
  add_sample_residuals(r);
  return s;
}

/// A ball of 5 cm that falls 0.4 m onto a floor 0.5 m below the camera and comes up with c = 0.8; bounces at 0.2 s and later.
inline Sample sample_bounces() {
  Sample s = sample_base();
  Body ball, floor;
  ball.name = "ball";
  ball.radius = 0.05;
  floor.name = "floor";
  floor.shape = Shape::fixed;
  s.shot.bodies = {ball, floor};
  Reconstruction& r = s.result;
  const double c = 0.8, first = 0.2, speed = 2.8, second = first + 2 * c * speed / 9.81;
  const Vec3 contact(-0.2, 3, -0.5), along(0.6, 0, 0);
  const Vec3 p1 = contact + Vec3(0, 0, 0.05), p2 = p1 + along * (second - first);
  for (int f = 0; f <= 100; ++f) {
    const double t = f / 120.0;
    FramePose pose;
    pose.frame = f;
    pose.time = t;
    if (t <= first)
      pose.bodies[0] = sample_flight(p1, along - Vec3(0, 0, speed), Vec3::Zero(), t - first);
    else if (t <= second)
      pose.bodies[0] = sample_flight(p1, along + Vec3(0, 0, c * speed), Vec3::Zero(), t - first);
    else
      pose.bodies[0] = sample_flight(p2, along + Vec3(0, 0, c * c * speed), Vec3::Zero(), t - second);
    r.frames.push_back(pose);
  }
  for (const double t : {first, second}) {
    Impact impact;
    impact.time = t;
    impact.frame = 120.0 * t;
    impact.restitution = {c, 0.01, 0.78, 0.82};
    impact.impulse = Vec3(0, 0, (t == first ? 1.0 : c) * (1 + c) * speed);
    impact.contact_point = contact + along * (t - first);
    r.impacts.push_back(impact);
  }
  r.restitution = Estimate{c, 0.007, 0.786, 0.814};
  r.fixed = "floor";
  r.bodies.resize(2);
  r.bodies[0].name = "ball";
  r.bodies[0].inertia = Vec3::Constant(0.001);
  r.bodies[0].before = sample_flight(p1, along - Vec3(0, 0, speed), Vec3::Zero(), 0);
  r.bodies[0].after = sample_flight(p1, along + Vec3(0, 0, c * speed), Vec3::Zero(), 0);
  r.bodies[1].name = "floor";
  r.bodies[1].fixed = true;
  r.energy_before = 4.1;
  r.energy_after = 2.7;
  add_sample_residuals(r);
  return s;
}

}  // namespace unseen::collision
