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

class Resimulated : public testing::TestWithParam<std::tuple<const char*, int, double, double>> {};

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
  std::printf("%s %d: c %.4f of %.4f, t %+.5f, path %.3f px, %zu impacts\n", scene, seed, shot.impacts[0].restitution, restitution,
              shot.impacts[0].time - c.time, path_error(shot, c), shot.impacts.size());
}

INSTANTIATE_TEST_SUITE_P(Stage, Resimulated,
                         testing::Values(std::tuple("boxes", 1, 0.3, 0.0), std::tuple("boxes", 2, 0.8, 0.0), std::tuple("boxes", 3, 0.6, 0.3),
                                         std::tuple("box-ball", 1, 0.5, 0.2), std::tuple("balls", 1, 0.9, 0.0), std::tuple("offcentre", 1, 0.7, 0.0),
                                         std::tuple("spin", 1, 0.6, 0.0), std::tuple("mesh", 1, 0.6, 0.0), std::tuple("box-floor", 1, 0.5, 0.0)));

}  // namespace
}  // namespace unseen::collision
