// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// From a film to all values.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "unseen/collision/collision.h"
#include "unseen/collision/evaluate.h"
#include "unseen/collision/synth.h"
#include "unseen/io/write_video.h"

namespace unseen::collision {
namespace {

TEST(Film, BodiesAreNotTurnedToMakeUpForAWrongDistance) {
  SynthOptions options;
  options.scene = "mesh";
  options.seed = 5;  // with the distances that flights alone have, one of the two seems turned by 116°
  options.width = 640;
  options.height = 360;
  options.fps = 120;
  SynthShot scene = simulate(options);
  const std::filesystem::path folder = testing::TempDir() + std::to_string(::getpid()) + "film";
  std::filesystem::create_directories(folder);
  scene.shot.video = folder / "shot.mp4";
  Context context;
  io::VideoFile video(scene.shot.video, options.width, options.height, options.fps);
  render(scene, options, context, [&](int, const std::vector<std::uint8_t>& bgr) { video.add(bgr); });
  video.close();
  const Reconstruction found = reconstruct(scene.shot, {}, context);
  std::filesystem::remove_all(folder);
  const Evaluation e = evaluate(found, scene.truth);
  ASSERT_EQ(e.motions.size(), 2u);
  for (const auto& motion : e.motions) EXPECT_LT(degrees(motion.rotation.value_or(kPi)), 8.0) << motion.name;
  ASSERT_TRUE(found.restitution);
  EXPECT_NEAR(found.restitution->value, scene.truth.impacts.front().restitution.value, 0.08);
}

}  // namespace
}  // namespace unseen::collision
