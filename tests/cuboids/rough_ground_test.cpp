// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "perception_scenes.h"
#include "unseen/cuboids/cuboids.h"

namespace unseen::cuboids::test {
namespace {

/// The ground with bumps of this rms (m) that are 10 to 20 cm long; what stands on it stays as it is.
RgbdFrame with_bumps(const Scene& scene, double rms, std::uint64_t seed) {
  constexpr int kWaves = 20;
  Scene bare = scene;
  bare.boxes.clear();
  bare.noise = 0.0;
  RgbdFrame frame = render(scene);
  const std::vector<float> ground = render(bare).depth;
  const RigidTransform T = camera_of(scene);
  Random random(seed);
  std::vector<Vec3> waves;
  for (int k = 0; k < kWaves; ++k) {
    const double length = 0.1 + 0.1 * random.uniform(), towards = 2.0 * kPi * random.uniform();
    waves.emplace_back(2.0 * kPi / length * std::cos(towards), 2.0 * kPi / length * std::sin(towards), 2.0 * kPi * random.uniform());
  }
  for (int v = 0; v < frame.camera.height; ++v)
    for (int u = 0; u < frame.camera.width; ++u) {
      const auto i = static_cast<std::size_t>(v * frame.camera.width + u);
      if (!(ground[i] > 0.0f) || std::abs(frame.depth[i] - ground[i]) > 0.01f * ground[i] * ground[i]) continue;
      const Vec3 p = T * frame.camera.unproject(u, v, ground[i]);
      double bump = 0;
      for (const Vec3& w : waves) bump += std::cos(w.x() * p.x() + w.y() * p.y() + w.z());
      frame.depth[i] *= static_cast<float>(1.0 - rms * std::sqrt(2.0 / kWaves) * bump / scene.height);
    }
  return frame;
}

/// Grass is no set of low boxes, and a low box on a smooth floor is one.
TEST(RoughGround, HasNoThingsThatAreNoHigherThanItsBumps) {
  Scene scene;
  scene.boxes = {upright(-0.3, 1.3, 0, {0.3, 0.25, 0.3}, 20), upright(0.3, 1.4, 0, {0.35, 0.3, 0.25}, -30)};
  scene.height = 1.0;
  scene.noise = 0.0006;
  for (const std::uint64_t seed : {1, 2, 3}) {
    Context context;
    EXPECT_EQ(complete_cuboids(with_bumps(scene, 0.006, seed), {}, context).cuboids.size(), 2u);
  }
  scene.boxes.push_back(upright(0.0, 0.9, 0, {0.2, 0.15, 0.012}, 10));
  Context context;
  EXPECT_EQ(complete_cuboids(render(scene), {}, context).cuboids.size(), 3u);
}

}  // namespace
}  // namespace unseen::cuboids::test
