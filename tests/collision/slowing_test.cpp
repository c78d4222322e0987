// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "collision/solve/flight.h"
#include "unseen/collision/collision.h"
#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

constexpr double kSlowed = 0.25, kBack = 0.75, kRatio = 1.6;  // m/s²; restitution; mass of the second puck to that of the first
constexpr double kPuckRadius = 0.04;                              // m

/// Small steps of what friction slows until it lies still, forwards.
void step(PointState<double>& state, double slowing, double dt) {
  const double speed = state.v.norm(), left = std::max(0.0, speed - slowing * dt);
  state.p += state.v * dt;
  if (speed > 0.0) state.v *= left / speed;
}

TEST(Slowing, OfASlideIsThatOfSmallSteps) {
  for (const double length : {0.4, 3.0}) {  // s: it lies still after 2 s
    PointState<double> state{Vec3(0.1, 0.2, 1.0), Vec3(0.3, -0.4, 0.0)};
    const PointState<double> start = state, end = slide(start, kSlowed, length);
    constexpr int kSteps = 100000;
    for (int i = 0; i < kSteps; ++i) step(state, kSlowed, length / kSteps);
    EXPECT_LT((end.p - state.p).norm(), 2e-5) << length;
    EXPECT_LT((end.v - state.v).norm(), 2e-3) << length;
    if (length > 1.0) continue;
    EXPECT_LT((slide(end, kSlowed, -length).p - start.p).norm(), 1e-5);
  }
}

/// A table without gravity across the view, for two bodies.
Shot table() {
  Shot shot;
  shot.name = "table.shot.json";
  shot.fps = 60;
  shot.gravity = 0.0;
  shot.camera.camera = {800, 800, 640, 360, 1280, 720};
  shot.bodies.resize(2);
  return shot;
}

/// Two pucks on a table that meet aslant, seen from 1 m above; sightings are off by 0.2 px.
Shot sliding(double slowing) {
  Shot shot = table();
  shot.bodies[0].name = "one", shot.bodies[1].name = "other";
  for (Body& body : shot.bodies) body.radius = kPuckRadius;
  Random random(4);
  std::array<PointState<double>, 2> pucks{{{Vec3(-0.5, -0.1, 1.0), Vec3(0.9, 0.1, 0.0)}, {Vec3(0.5, 0.12, 1.0), Vec3(-0.8, -0.2, 0.0)}}};
  bool met = false;
  for (int f = 0; f < 72; ++f) {
    for (int o = 0; o < 2; ++o) {
      const Vec2 off(random.normal(), random.normal());
      shot.observations.push_back({f, Vec2(shot.camera.camera.project(pucks[o].p)) + 0.2 * off, 800 * kPuckRadius, o});
    }
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) {
      for (PointState<double>& puck : pucks) step(puck, slowing, 1.0 / (60.0 * kSteps));
      const Vec3 apart = pucks[0].p - pucks[1].p;
      if (met || apart.norm() > 2.0 * kPuckRadius) continue;
      met = true;
      const Vec3 n = apart.normalized(), impulse = n * (-(1.0 + kBack) * n.dot(pucks[0].v - pucks[1].v) / (1.0 + 1.0 / kRatio));
      pucks[0].v += impulse;
      pucks[1].v -= impulse / kRatio;
    }
  }
  EXPECT_TRUE(met);
  return shot;
}

/// A puck that slides for long, off a cushion.
Shot cushioned(double slowing, int frames) {
  Shot shot = table();
  shot.bodies[0].name = "puck", shot.bodies[0].radius = kPuckRadius;
  shot.bodies[1].name = "cushion", shot.bodies[1].shape = Shape::fixed, shot.bodies[1].normal = Vec3(-1, 0, 0);
  Random random(6);
  PointState<double> puck{Vec3(-0.6, -0.1, 1.0), Vec3(1.1, 0.15, 0.0)};
  for (int f = 0; f < frames; ++f) {
    shot.observations.push_back({f, Vec2(shot.camera.camera.project(puck.p)) + 0.2 * Vec2(random.normal(), random.normal()), 800 * kPuckRadius, 0});
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) {
      step(puck, slowing, 1.0 / (60.0 * kSteps));
      if (puck.p.x() > 0.5 && puck.v.x() > 0.0) puck.v.x() *= -kBack;
    }
  }
  return shot;
}

// Far back, a body that is slowed too much comes from far away: the search for the slowing must not be led astray by that.
TEST(Slowing, OfALongFlightIsEstimated) {
  for (const double slowing : {0.0, 0.15, 0.4}) {
    Context context;
    const Reconstruction r = reconstruct(cushioned(slowing, 150), {}, context);
    ASSERT_TRUE(r.restitution && r.slowing) << slowing;
    EXPECT_NEAR(*r.slowing, slowing, 0.02);
    EXPECT_NEAR(r.restitution->value, kBack, 0.01) << slowing;
  }
}

TEST(Slowing, IsLeftToTheAirWhereThatIsAskedFor) {
  Shot shot = sliding(0.1);
  Options options;
  options.drag = "estimate";
  Context context;
  const Reconstruction r = reconstruct(shot, options, context);
  EXPECT_FALSE(r.slowing);
  ASSERT_TRUE(r.drag);
  EXPECT_LT(*r.drag, 0.5);
}

TEST(Slowing, ByATableIsEstimated) {
  for (const double slowing : {0.0, 0.1, kSlowed}) {
    Context context;
    const Reconstruction r = reconstruct(sliding(slowing), {}, context);
    ASSERT_TRUE(r.restitution && r.mass_ratio && r.slowing) << slowing;
    EXPECT_NEAR(*r.slowing, slowing, 0.03);
    EXPECT_NEAR(r.restitution->value, kBack, 0.02) << slowing;
    EXPECT_NEAR(r.mass_ratio->value, kRatio, 0.03 * kRatio) << slowing;
    EXPECT_TRUE(r.restitution->low <= kBack && kBack <= r.restitution->high) << slowing;
    EXPECT_TRUE(r.mass_ratio->low <= kRatio && kRatio <= r.mass_ratio->high) << slowing;
  }
}

/// A ball that comes back from a rail, or a floor, at y = 0.3 m, and is drawn there by this acceleration (m/s²), which the shot does not know of.
Shot drawn(double acceleration) {
  Shot shot = table();
  shot.bodies[0].name = "ball", shot.bodies[1].name = "rail";
  shot.bodies[0].radius = kPuckRadius;
  shot.bodies[1].shape = Shape::fixed;
  Random random(4);
  Vec2 p(-0.4, -0.2), v(0.5, 0.9);
  for (int f = 0; f < 60; ++f) {
    shot.observations.push_back({f, Vec2(640, 360) + 800.0 * p + 0.2 * Vec2(random.normal(), random.normal()), 800 * kPuckRadius, 0});
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) {
      v.y() += acceleration / (60.0 * kSteps);
      p += v / (60.0 * kSteps);
      if (p.y() > 0.3 && v.y() > 0.0) v.y() *= -kBack;
    }
  }
  return shot;
}

TEST(Slowing, IsNoFallAndNoSlope) {
  const auto warnings = [](double acceleration) {
    Context context;
    const Reconstruction r = reconstruct(drawn(acceleration), {}, context);
    EXPECT_EQ(r.restitution.has_value(), acceleration < 0.3) << acceleration;
    std::string all;
    for (const std::string& warning : r.summary.warnings) all += warning + "\n";
    return all;
  };
  EXPECT_EQ(warnings(0.0).find("bend alike"), std::string::npos);
  EXPECT_NE(warnings(0.15).find("though \"gravity\" is 0"), std::string::npos);
  EXPECT_NE(warnings(1.2).find("though \"gravity\" is 0"), std::string::npos);
}

}  // namespace
}  // namespace unseen::collision
