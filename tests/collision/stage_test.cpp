// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/stage.h"

#include <gtest/gtest.h>

#include "unseen/collision/synth.h"
#include "unseen/core/error.h"

namespace unseen::collision {
namespace {

/// What a solver without error says of a simulated shot.
Reconstruction perfect(const Truth& truth) {
  Reconstruction r;
  r.T_world_camera = truth.T_world_camera;
  r.camera = truth.camera;
  r.fps = truth.fps;
  r.impacts = {truth.impacts.front()};
  r.restitution = Estimate{truth.impacts.front().restitution};
  if (truth.mass_ratio) r.mass_ratio = Estimate{*truth.mass_ratio, 0, *truth.mass_ratio, *truth.mass_ratio};
  r.frames = truth.frames;
  for (const Body& b : truth.bodies) {
    BodyResult result;
    result.name = b.name;
    result.fixed = b.shape == Shape::fixed;
    if (result.fixed) r.fixed = b.name;
    r.bodies.push_back(result);
  }
  // just before the impact: by the closed form from the last frame, which a short time turns but little
  const FramePose* last = nullptr;
  for (const FramePose& f : truth.frames)
    if (f.time < r.impacts.front().time) last = &f;
  for (std::size_t i = 0; i < 2; ++i) {
    if (r.bodies[i].fixed) continue;
    const double dt = r.impacts.front().time - last->time;
    const BodyState &s = *last->bodies[i], &earlier = *(last - 1)->bodies[i];
    const Eigen::AngleAxisd turn(s.q * earlier.q.conjugate());
    BodyState& before = r.bodies[i].before;
    before = s;
    before.p += s.v * dt - Vec3(0, 0, 0.5 * 9.81 * dt * dt);
    before.v -= Vec3(0, 0, 9.81 * dt);
    before.q = Quat(Eigen::AngleAxisd(turn.angle() * dt * truth.fps, turn.axis())) * s.q;
  }
  return r;
}

StagedCollision staged(const std::string& scene, int seed, double restitution, const std::string& name, double time, double friction = 0.0) {
  SynthOptions options;
  options.scene = scene;
  options.seed = seed;
  options.restitution = restitution;
  options.friction = friction;
  options.video = false;
  const SynthShot synth = simulate(options);
  StagedCollision c;
  c.name = name;
  c.shot = synth.shot;
  c.result = perfect(synth.truth);
  c.time = time;
  return c;
}

StagePlan plan_of(std::vector<StagedCollision> collisions, double duration) {
  StagePlan plan;
  plan.name = "list.toml";
  plan.collisions = std::move(collisions);
  plan.duration = duration;
  return plan;
}

/// Largest distance (px) between where the camera sees the centres in the new shot and in the truth, over the truth's frames.
double path_error(const StagedShot& shot, const StagedCollision& c) {
  const RigidTransform T = c.result.T_world_camera.inverse();
  double worst = 0;
  for (const FramePose& f : c.result.frames)
    for (const StagedFrame& g : shot.frames) {
      if (std::abs(g.time - (f.time - c.result.impacts.front().time + c.time)) > 1e-6) continue;
      for (std::size_t i = 0; i < g.bodies.size(); ++i)
        worst = std::max(worst, (c.result.camera.project(T * f.bodies[i]->p) - c.result.camera.project(T * g.bodies[i].p)).norm());
    }
  return worst;
}

class Resimulated : public testing::TestWithParam<std::tuple<std::string, int, double, double>> {};

TEST_P(Resimulated, KeepsRestitutionAndPath) {
  const auto& [scene, seed, restitution, friction] = GetParam();
  StagedCollision c = staged(scene, seed, restitution, "one", 0, friction);
  c.time = c.result.impacts.front().time;  // frames at the truth's times
  StagePlan plan = plan_of({c}, c.result.frames.back().time);
  plan.fps = c.result.fps;
  Context context;
  const StagedShot shot = stage(plan, context);
  ASSERT_FALSE(shot.impacts.empty());
  EXPECT_NEAR(shot.impacts[0].time, c.time, 1e-3);
  EXPECT_NEAR(shot.impacts[0].restitution, restitution, 0.01);
  EXPECT_LT(path_error(shot, c), 1.0);
}

INSTANTIATE_TEST_SUITE_P(Stage, Resimulated,
                         testing::Values(std::tuple("boxes", 1, 0.3, 0.0), std::tuple("boxes", 2, 0.8, 0.0), std::tuple("boxes", 3, 0.6, 0.3),
                                         std::tuple("box-ball", 1, 0.5, 0.2), std::tuple("balls", 1, 0.9, 0.0), std::tuple("offcentre", 1, 0.7, 0.0),
                                         std::tuple("spin", 1, 0.6, 0.0), std::tuple("spin", 1, 0.25, 0.3), std::tuple("mesh", 1, 0.6, 0.0),
                                         std::tuple("mesh", 3, 0.35, 0.3), std::tuple("boxes", 2, 0.3, 0.3), std::tuple("box-floor", 1, 0.5, 0.0)));

/// Three pairs side by side; of two of them a body each meets again.
StagePlan three_pairs() {
  StagePlan plan = plan_of({staged("boxes", 2, 0.6, "one", 0.4), staged("balls", 1, 0.8, "two", 0.5), staged("offcentre", 1, 0.4, "three", 0.6)}, 1.0);
  plan.collisions[1].translate = {3, 0, 0};
  plan.collisions[2].translate = {6, 0, 0};
  plan.meetings = {{{StagedBody{0, 1}, StagedBody{1, 0}}, 0.8, std::nullopt}};
  for (StagedCollision& c : plan.collisions) c.mass = 1.0;
  plan.fps = 240;
  return plan;
}

const StagedImpact* impact_of(const StagedShot& shot, const std::string& a, const std::string& b) {
  for (const StagedImpact& i : shot.impacts) {
    if (i.between[1] < 0) continue;
    const std::string &x = shot.actors[static_cast<std::size_t>(i.between[0])].name, &y = shot.actors[static_cast<std::size_t>(i.between[1])].name;
    if ((x == a && y == b) || (x == b && y == a)) return &i;
  }
  return nullptr;
}

TEST(Stage, ThreePairsCollideWhenAskedAndTwoOfThemAgain) {
  const StagePlan plan = three_pairs();
  Context context;
  const StagedShot shot = stage(plan, context);
  EXPECT_EQ(shot.summary.status, Status::solved);
  EXPECT_TRUE(shot.summary.warnings.empty());
  for (std::size_t i = 0; i < 3; ++i) {
    const StagedImpact* own = impact_of(shot, shot.actors[2 * i].name, shot.actors[2 * i + 1].name);
    ASSERT_NE(own, nullptr) << i;
    EXPECT_NEAR(own->time, plan.collisions[i].time, 1e-3);
    EXPECT_NEAR(own->restitution, plan.collisions[i].result.restitution->value, 0.01);
  }
  const StagedImpact* again = impact_of(shot, shot.actors[1].name, shot.actors[2].name);
  ASSERT_NE(again, nullptr);
  EXPECT_NEAR(again->time, 0.8, 1e-3);
  EXPECT_NEAR(again->restitution, std::sqrt(0.6 * 0.8), 0.01);
}

TEST(Stage, SaysWhereAMassIsAssumedThatMatters) {
  StagePlan plan = three_pairs();
  plan.collisions[1].mass = plan.collisions[2].mass = std::nullopt;  // the third meets nobody
  Context context;
  const std::vector<std::string> warnings = stage(plan, context).summary.warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].rfind("two: no mass is given", 0), 0U) << warnings[0];
}

TEST(Stage, ConservesMomentum) {
  const StagePlan plan = three_pairs();
  Context context;
  const StagedShot shot = stage(plan, context);
  const auto momentum = [&](const StagedFrame& f) {
    Vec3 sum = Vec3::Zero();
    double mass = 0;
    for (std::size_t i = 0; i < f.bodies.size(); ++i) {
      sum += shot.actors[i].mass * (f.bodies[i].v + Vec3(0, 0, 9.81 * f.time));
      mass += shot.actors[i].mass;
    }
    return Vec3(sum / mass);
  };
  for (const StagedFrame& f : shot.frames) EXPECT_LT((momentum(f) - momentum(shot.frames.front())).norm(), 1e-3) << f.time;
}

TEST(Stage, TurnedAndMovedIsTheSameMotionElsewhere) {
  StagePlan plan = plan_of({staged("boxes", 2, 0.6, "one", 0.4)}, 0.8);
  Context context;
  const StagedShot here = stage(plan, context);
  plan.collisions[0].translate = {1, 2, 3};
  plan.collisions[0].turn = 0.7;
  const StagedShot there = stage(plan, context);
  const RigidTransform& T = there.placements[0].T_new_filmed;
  const Vec3& x = plan.collisions[0].result.impacts[0].contact_point;
  EXPECT_LT((T * x - x - Vec3(1, 2, 3)).norm(), 1e-12);
  for (const std::size_t f : {std::size_t{0}, here.frames.size() - 1})
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LT((T * here.frames[f].bodies[i].p - there.frames[f].bodies[i].p).norm(), 1e-3);
      EXPECT_LT((Quat(T.rotation) * here.frames[f].bodies[i].q).angularDistance(there.frames[f].bodies[i].q), 1e-2);
    }
}

TEST(Stage, AnotherShapeKeepsMassVelocityAndSpin) {
  StagePlan plan = plan_of({staged("boxes", 2, 0.6, "one", 0.4)}, 0.8);
  Body ball;
  ball.name = "other";
  ball.radius = 0.05;
  plan.collisions[0].swaps[1] = ball;
  Context context;
  const StagedShot shot = stage(plan, context);
  ASSERT_FALSE(shot.impacts.empty());
  EXPECT_NEAR(shot.impacts[0].time, 0.4, 1e-3);
  EXPECT_NEAR(shot.impacts[0].restitution, 0.6, 0.01);
  EXPECT_NEAR(shot.actors[1].mass / shot.actors[0].mass, plan.collisions[0].result.mass_ratio->value, 1e-12);
  EXPECT_NEAR(shot.actors[1].inertia.x(), 0.4 * 0.05 * 0.05, 1e-15);
}

TEST(Stage, AFloorThrowsBodiesBackAsTheirCollisionDid) {
  StagePlan plan = plan_of({staged("balls", 1, 0.7, "one", 0.3)}, 1.5);
  plan.floor = plan.collisions[0].result.impacts[0].contact_point.z() - 1.0;
  Context context;
  const StagedShot shot = stage(plan, context);
  int bounces = 0;
  for (const StagedImpact& i : shot.impacts)
    if (i.between[1] < 0) {
      ++bounces;
      EXPECT_NEAR(i.restitution, 0.7, 0.01);
    }
  EXPECT_GE(bounces, 2);
  for (const StagedFrame& f : shot.frames)
    for (std::size_t i = 0; i < 2; ++i) EXPECT_GT(f.bodies[i].p.z(), *plan.floor + shot.actors[i].body.radius - 2e-3);
}

TEST(Stage, SaysWhatCannotBe) {
  Context context;
  StagePlan plan = three_pairs();
  plan.meetings[0].bodies[1] = {0, 0};
  EXPECT_THROW(stage(plan, context), InputError);  // two of one collision
  plan = three_pairs();
  plan.meetings[0].time = 0.3;
  EXPECT_THROW(stage(plan, context), InputError);  // before their own impacts
  plan = three_pairs();
  plan.collisions[1].result.impacts.clear();
  EXPECT_THROW(stage(plan, context), InputError);
  plan = three_pairs();
  plan.collisions[2] = plan.collisions[0];  // in the way of the first
  plan.collisions[2].translate = {0.01, 0, 0};
  plan.meetings.clear();
  const StagedShot shot = stage(plan, context);
  EXPECT_EQ(shot.summary.status, Status::infeasible);
  EXPECT_FALSE(shot.summary.warnings.empty());
}

}  // namespace
}  // namespace unseen::collision
