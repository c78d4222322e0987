// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "perception_scenes.h"

namespace unseen::cuboids::test {
namespace {

TEST(DepthNoise, OfABetterSensorIsMeasured) {
  Scene scene;
  scene.boxes = {upright(-0.15, 0.9, 0, {0.2, 0.15, 0.1}, 20)};
  for (const double noise : {0.0006, 0.0008, 0.001}) {
    scene.noise = noise;
    const double found = depth_noise(render(scene), {});
    EXPECT_GT(found, noise);
    EXPECT_LT(found, 1.5 * noise);
  }
  scene.noise = 0.004;
  EXPECT_EQ(depth_noise(render(scene), {}), 0.0015);
  Options given;
  given.noise = 0.01;
  EXPECT_EQ(depth_noise(render(scene), given), 0.01);
}

TEST(DepthNoise, ThatIsMoreThanBoxesAreToldApartWithIsSaid) {
  Scene scene;
  scene.boxes = {upright(-0.15, 0.9, 0, {0.2, 0.15, 0.1}, 20)};
  for (const double noise : {0.0015, 0.0027}) {
    scene.noise = noise;
    Context context;
    EXPECT_EQ(*with_depth_noise(render(scene), {}, context).noise, 0.0015);
    const std::vector<std::string> warnings = context.take_warnings();
    ASSERT_EQ(warnings.size(), noise > 0.002 ? 1u : 0u);
    if (!warnings.empty()) {
      EXPECT_NE(warnings[0].find("scatters by 2."), std::string::npos) << warnings[0];
    }
  }
}

TEST(DepthNoise, OfNextToNothingIsThatOfAKinect) {
  RgbdFrame frame = render(Scene());
  for (std::size_t i = 0; i < frame.depth.size(); ++i)
    if (i % 3 != 0) frame.depth[i] = 0.0f;
  EXPECT_EQ(depth_noise(frame, {}), 0.0015);
}

TEST(DepthNoise, IsNeverLessThanWhatAPixelHides) {
  Scene scene;
  scene.noise = 0.0;
  EXPECT_EQ(depth_noise(render(scene), {}), 0.0006);
}

TEST(DepthNoise, OfSmoothedDepthIsThatOfAKinect) {
  RgbdFrame frame = render(Scene());
  const std::vector<float> sharp = frame.depth;
  const int width = frame.camera.width;
  for (int y = 2; y + 2 < frame.camera.height; ++y)
    for (int x = 2; x + 2 < width; ++x) {
      float sum = 0;
      for (int k = 0; k < 25; ++k) sum += sharp[static_cast<std::size_t>((y + k / 5 - 2) * width + x + k % 5 - 2)];
      frame.depth[static_cast<std::size_t>(y * width + x)] = sum / 25.0f;
    }
  EXPECT_EQ(depth_noise(frame, {}), 0.0015);
}

/// Errors of block matching are alike over its blocks; of a stereo camera they are larger than those of a Kinect.
TEST(DepthNoise, OfStereoCountsThoughItIsSmooth) {
  Scene scene;
  scene.noise = 0.0;
  scene.boxes = {upright(0, 0.8, 0, {0.3, 0.2, 0.15}, 20)};
  RgbdFrame frame = render(scene);
  const int width = frame.camera.width;
  Random random(4);
  std::vector<double> white;
  for (std::size_t i = 0; i < frame.depth.size(); ++i) white.push_back(random.normal());
  for (int y = 2; y + 2 < frame.camera.height; ++y)
    for (int x = 2; x + 2 < width; ++x) {
      double sum = 0;
      for (int k = 0; k < 25; ++k) sum += white[static_cast<std::size_t>((y + k / 5 - 2) * width + x + k % 5 - 2)];
      float& depth = frame.depth[static_cast<std::size_t>(y * width + x)];
      depth += static_cast<float>(0.0035 * depth * depth * sum / 5.0);
    }
  const double noise = depth_noise(frame, {});
  EXPECT_GT(noise, 0.002);
  EXPECT_LT(noise, 0.0035);
  Context context;
  with_depth_noise(frame, {}, context);
  EXPECT_EQ(context.take_warnings().size(), 1u);
}

TEST(DepthNoise, OfCoarseStepsIsAsWideAsThese) {
  Scene scene;
  scene.noise = 0.0003;
  scene.boxes = {upright(0, 0.8, 0, {0.3, 0.2, 0.15}, 20)};
  RgbdFrame frame = render(scene);
  for (float& depth : frame.depth) depth = std::round(depth * 100.0f) / 100.0f;
  const double noise = depth_noise(frame, {});
  EXPECT_GT(noise, 0.0015);
  EXPECT_LT(noise, 0.01 / std::sqrt(12.0) / (0.6 * 0.6));
  EXPECT_EQ(perceive(frame).parts.size(), 1u);
  Context context;
  with_depth_noise(frame, {}, context);
  EXPECT_EQ(context.take_warnings().size(), 1u);
}

}  // namespace
}  // namespace unseen::cuboids::test
