// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/surfaces/smear.h"

#include <gtest/gtest.h>

#include "perception_scenes.h"
#include "unseen/cuboids/cuboids.h"

namespace unseen::cuboids::test {
namespace {

/// Two boxes before a phone's lidar of 256 × 192 pixels.
Scene phone() {
  Scene scene;
  scene.boxes = {upright(-0.3, 1.6, 0, {0.3, 0.25, 0.3}, 20), upright(0.35, 1.8, 0, {0.35, 0.3, 0.25}, -30)};
  scene.height = 1.1;
  scene.noise = 0.0005;
  scene.width = 256, scene.image_height = 192;
  scene.focal = 212;
  return scene;
}

/// The inverse depth blurred along rows, then columns, by a bell curve of 0.9 pixels.
RgbdFrame smeared(RgbdFrame frame) {
  const int width = frame.camera.width, height = frame.camera.height;
  for (const bool rows : {true, false}) {
    const std::vector<float> before = frame.depth;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        double sum = 0, weights = 0;
        for (int k = -4; k <= 4; ++k) {
          const int u = rows ? x + k : x, v = rows ? y : y + k;
          if (u < 0 || v < 0 || u >= width || v >= height || !(before[static_cast<std::size_t>(v) * width + u] > 0.0f)) continue;
          const double weight = std::exp(-0.5 * k * k / 0.81);
          sum += weight / before[static_cast<std::size_t>(v) * width + u], weights += weight;
        }
        float& depth = frame.depth[static_cast<std::size_t>(y) * width + x];
        if (depth > 0.0f) depth = static_cast<float>(weights / sum);
      }
  }
  return frame;
}

TEST(Smear, IsTakenBackAndSharpDepthIsLeft) {
  const RgbdFrame truth = render(phone()), blurred = smeared(truth);
  Context context;
  EXPECT_FALSE(without_smear(truth, context));
  EXPECT_FALSE(without_smear(render(Scene{phone().boxes}), context));
  const std::optional<RgbdFrame> sharp = without_smear(blurred, context);
  ASSERT_TRUE(sharp);
  std::size_t off_before = 0, off_after = 0;  // by more than 5 cm
  for (std::size_t i = 0; i < truth.depth.size(); ++i) {
    off_before += std::abs(blurred.depth[i] - truth.depth[i]) > 0.05f;
    off_after += std::abs(sharp->depth[i] - truth.depth[i]) > 0.05f;
  }
  EXPECT_GT(off_before, 300u);
  EXPECT_LT(2 * off_after, off_before);
}

TEST(Smear, LeavesBoxesTheirSizes) {
  const Scene scene = phone();
  Context context;
  const Completion c = complete_cuboids(smeared(render(scene)), {}, context);
  ASSERT_EQ(c.cuboids.size(), 2u);
  for (const OrientedBox& box : scene.boxes) EXPECT_LT(size_error(nearest(c.cuboids, box.center).box, box), 0.03);
  EXPECT_TRUE(std::any_of(c.summary.warnings.begin(), c.summary.warnings.end(), [](const std::string& w) { return w.find("smeared") != std::string::npos; }));
}

}  // namespace
}  // namespace unseen::cuboids::test
