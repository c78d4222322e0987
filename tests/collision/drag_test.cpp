// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/drag.h"

#include <gtest/gtest.h>

#include <cmath>

#include "collision/solve/flight.h"
#include "unseen/collision/collision.h"
#include "unseen/core/error.h"
#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

constexpr double kRadius = 0.02, kMass = 0.0027;  // m, kg: of a table-tennis ball
constexpr double kDrag = 0.5 * 1.2 * 0.47 * kPi * kRadius * kRadius / kMass;  // 1/m
constexpr double kBack = 0.85;                    // coefficient of restitution

/// A camera that looks along y, 2.2 m in front of the bodies and 0.6 m above the floor; sightings are off by 0.2 px.
struct Filming {
  Random random{3};
  Sighting see(int frame, const Vec3& place, int body) {
    const double depth = 2.2 + place.y();
    const Vec2 off(random.normal(), random.normal());
    return {frame, Vec2(640 + 1100 * place.x() / depth, 360 + 1100 * (0.6 - place.z()) / depth) + 0.2 * off, 1100 * kRadius / depth, body};
  }
};

Shot shot_of(const char* second) {
  Shot shot;
  shot.name = "drag.shot.json";
  shot.fps = 120;
  shot.camera.camera = {1100, 1100, 640, 360, 1280, 720};
  shot.down = Vec3::UnitY();
  shot.bodies.resize(2);
  shot.bodies[0].name = "ball";
  shot.bodies[1].name = second;
  for (Body& body : shot.bodies) body.radius = kRadius;
  return shot;
}

PointState<double> flown(const PointState<double>& from, double dt, double drag) { return fly<double>(from, Vec3(0, 0, -9.81), {drag}, dt); }

/// A ball falls from 1.1 m and bounces on a floor, with this drag; `speed` (m/s) along it.
Shot bouncing(double drag, double speed = 1.1) {
  Shot shot = shot_of("floor");
  shot.bodies[1].shape = Shape::fixed;
  Filming camera;
  PointState<double> state{Vec3(-0.9, 0.0, 1.1), Vec3(speed, 0.0, 0.0)};
  constexpr int kSteps = 40;
  for (int f = 0; f < 160; ++f) {
    shot.observations.push_back(camera.see(f, state.p, 0));
    for (int i = 0; i < kSteps; ++i) {
      state = flown(state, 1.0 / (120.0 * kSteps), drag);
      if (state.p.z() < kRadius && state.v.z() < 0.0) state.v.z() *= -kBack;
    }
  }
  return shot;
}

/// Two balls that fly fast and meet head on, with this drag.
Shot colliding(double drag) {
  Shot shot = shot_of("other");
  Filming camera;
  const std::array<PointState<double>, 2> before{{{Vec3(-kRadius, 0, 0.7), Vec3(4.0, 0, 1.5)}, {Vec3(kRadius, 0, 0.7), Vec3(-3.5, 0, 1.2)}}};
  std::array<PointState<double>, 2> after = before;
  const double sum = 4.0 - 3.5, apart = kBack * 7.5;
  after[0].v.x() = 0.5 * (sum - apart);
  after[1].v.x() = 0.5 * (sum + apart);
  for (int f = 0; f < 72; ++f)
    for (int o = 0; o < 2; ++o) {
      const double t = f / 120.0 - 0.3021;
      const Vec3 place = flown(t < 0 ? before[o] : after[o], t, drag).p;
      if (std::abs(place.x()) < 1.1) shot.observations.push_back(camera.see(f, place, o));
    }
  return shot;
}

bool warned(const Reconstruction& r, const std::string& word) {
  return std::any_of(r.summary.warnings.begin(), r.summary.warnings.end(), [&](const std::string& w) { return w.find(word) != std::string::npos; });
}

bool listed(const Reconstruction& r) {
  return std::any_of(r.ambiguous.begin(), r.ambiguous.end(), [](const Alternative& a) { return a.what.find("drag") != std::string::npos; });
}

TEST(Drag, IsSaidWithoutAMass) {
  Context context;
  const Reconstruction r = reconstruct(bouncing(kDrag), {}, context);
  EXPECT_TRUE(warned(r, "the air slows it down"));
  EXPECT_TRUE(listed(r));
  ASSERT_TRUE(r.restitution);
  EXPECT_LE(r.restitution->low, kBack);
  EXPECT_GE(r.restitution->high, kBack);
}

/// Whether the interval holds the restitution that the ball has.
bool holds(const Reconstruction& r) { return r.restitution && r.restitution->low <= kBack && kBack <= r.restitution->high; }

// What the air does to a tennis ball is less than its flights tell of, and more than their interval.
TEST(Drag, ThatTheMassGivesAndTheFlightsCannotTellIsInTheInterval) {
  constexpr double kTennis = 0.13 * kDrag;  // 1/m
  Shot shot = bouncing(kTennis);
  Random random(5);
  for (Sighting& s : shot.observations) s.pixel += 0.6 * Vec2(random.normal(), random.normal()), s.radius = 0.0;
  Context context;
  const Reconstruction bare = reconstruct(shot, {}, context);
  ASSERT_TRUE(bare.restitution);
  EXPECT_FALSE(holds(bare));
  EXPECT_TRUE(warned(bare, "no mass is given"));
  shot.bodies[0].mass = kMass * kDrag / kTennis;
  const Reconstruction r = reconstruct(shot, {}, context);
  EXPECT_TRUE(holds(r));
  EXPECT_TRUE(r.fits);
  EXPECT_FALSE(warned(r, "no mass"));
}

// Balls as large are hollow: a basketball of which nobody gave the mass.
TEST(Drag, OfALargeBallIsInTheInterval) {
  constexpr double kLarge = 0.12, kBasketball = 0.62;  // m, kg
  const auto thrown = [](double drag) {
    Shot shot = bouncing(drag);
    shot.bodies[0].radius = kLarge;
    for (Sighting& s : shot.observations) s.radius = 0.0;
    return shot;
  };
  Context context;
  const Reconstruction r = reconstruct(thrown(0.5 * 1.2 * 0.47 * kPi * kLarge * kLarge / kBasketball), {}, context);
  ASSERT_TRUE(r.restitution);
  EXPECT_TRUE(holds(r));
  EXPECT_TRUE(warned(r, "as a large ball's"));
  EXPECT_LT(2.0 * r.restitution->value - r.restitution->low, kBack);  // by the flights alone it would not be
}

TEST(Drag, ThatIsEstimatedLeavesItsDoubtInTheInterval) {
  Shot shot = bouncing(kDrag);
  shot.bodies[0].mass = kMass;
  shot.frames = {0, 99};  // one bounce
  Options on, estimate;
  on.drag = "on";
  estimate.drag = "estimate";
  Context context;
  const Reconstruction known = reconstruct(shot, on, context), fitted = reconstruct(shot, estimate, context);
  ASSERT_TRUE(known.restitution && fitted.restitution);
  EXPECT_TRUE(holds(fitted));
  EXPECT_GT(fitted.restitution->sd, 1.3 * known.restitution->sd);
}

// Drag looks like gravity that leans back: a table-tennis ball that flies fast, and `down` as it is.
TEST(Drag, IsNotTakenForAWrongDown) {
  for (const double speed : {2.0, 3.0}) {
    Context context;
    const Reconstruction r = reconstruct(bouncing(kDrag, speed), {}, context);
    EXPECT_TRUE(warned(r, "the air slows it down")) << speed;
    EXPECT_FALSE(warned(r, "away from where it is given")) << speed;
  }
}

TEST(Drag, IsNotSaidOfAHeavyBall) {
  Context context;
  const Reconstruction r = reconstruct(bouncing(0.0), {}, context);
  EXPECT_FALSE(warned(r, "the air"));
  EXPECT_FALSE(listed(r));
  EXPECT_TRUE(r.fits);
}

TEST(Drag, AModelWithoutItDoesNotFitWhereTheMassTellsOfIt) {
  Shot shot = bouncing(kDrag);
  shot.bodies[0].mass = kMass;
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  EXPECT_TRUE(warned(r, "use --drag on"));
  EXPECT_TRUE(listed(r));
  EXPECT_FALSE(r.fits);
  Options on;
  on.drag = "on";
  const Reconstruction with = reconstruct(shot, on, context);
  EXPECT_TRUE(with.fits);
  ASSERT_TRUE(with.restitution);
  EXPECT_NEAR(with.restitution->value, kBack, 0.02);
}

TEST(Drag, FromTheMassNeedsAMass) {
  Options on;
  on.drag = "on";
  Context context;
  try {
    reconstruct(bouncing(kDrag), on, context);
    ADD_FAILURE() << "no error";
  } catch (const InputError& e) {
    EXPECT_EQ(e.field, "bodies");
    EXPECT_NE(e.found.find("ball"), std::string::npos);
  }
}

TEST(Drag, OfTwoFreeBodiesIsFound) {
  Context context;
  Shot shot = colliding(kDrag);
  EXPECT_TRUE(warned(reconstruct(shot, {}, context), "the air slows them down"));
  Options estimate;
  estimate.drag = "estimate";
  const Reconstruction r = reconstruct(shot, estimate, context);
  ASSERT_TRUE(r.drag);
  EXPECT_NEAR(*r.drag / kDrag, 1.0, 0.25);
  ASSERT_TRUE(r.mass_ratio);
  EXPECT_NEAR(r.mass_ratio->value, 1.0, 0.05);
  ASSERT_TRUE(r.restitution);
  EXPECT_NEAR(r.restitution->value, kBack, 0.04);
}

}  // namespace
}  // namespace unseen::collision
