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

/// The inverse depth blurred along rows, then columns, by a bell curve of this many pixels.
RgbdFrame smeared(RgbdFrame frame, double width_of_bell = 0.9) {
  const int width = frame.camera.width, height = frame.camera.height;
  for (const bool rows : {true, false}) {
    const std::vector<float> before = frame.depth;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        double sum = 0, weights = 0;
        for (int k = -4; k <= 4; ++k) {
          const int u = rows ? x + k : x, v = rows ? y : y + k;
          if (u < 0 || v < 0 || u >= width || v >= height || !(before[static_cast<std::size_t>(v) * width + u] > 0.0f)) continue;
          const double weight = std::exp(-0.5 * k * k / (width_of_bell * width_of_bell));
          sum += weight / before[static_cast<std::size_t>(v) * width + u], weights += weight;
        }
        float& depth = frame.depth[static_cast<std::size_t>(y) * width + x];
        if (depth > 0.0f) depth = static_cast<float>(weights / sum);
      }
  }
  return frame;
}

/// The depth of a frame of 256 × 192 pixels at 640 × 480, as users scale it to the size of the picture.
RgbdFrame enlarged(const RgbdFrame& small) {
  Scene large = phone();
  large.boxes.clear();
  large.width = 640, large.image_height = 480;
  large.focal *= 2.5;
  RgbdFrame frame = render(large);
  for (int y = 0; y < 480; ++y)
    for (int x = 0; x < 640; ++x) {
      const double u = std::clamp((x + 0.5) / 2.5 - 0.5, 0.0, 254.999), v = std::clamp((y + 0.5) / 2.5 - 0.5, 0.0, 190.999);
      const int left = static_cast<int>(u), top = static_cast<int>(v);
      const auto at = [&](int dx, int dy) { return static_cast<double>(small.depth[static_cast<std::size_t>((top + dy) * 256 + left + dx)]); };
      const double upper = std::lerp(at(0, 0), at(1, 0), u - left), lower = std::lerp(at(0, 1), at(1, 1), u - left);
      frame.depth[static_cast<std::size_t>(y * 640 + x)] = static_cast<float>(std::lerp(upper, lower, v - top));
    }
  return frame;
}

std::size_t off_by_5_cm(const RgbdFrame& frame, const RgbdFrame& truth) {
  std::size_t off = 0;
  for (std::size_t i = 0; i < truth.depth.size(); ++i) off += std::abs(frame.depth[i] - truth.depth[i]) > 0.05f;
  return off;
}

/// A smear of one pixel, and the same of two and a half.
TEST(Smear, IsAsWideAsItIs) {
  const auto expect_sharp = [](const RgbdFrame& frame, const RgbdFrame& truth) {
    Context context;
    const std::optional<RgbdFrame> sharp = without_smear(frame, context);
    ASSERT_TRUE(sharp);
    EXPECT_LT(2 * off_by_5_cm(*sharp, truth), off_by_5_cm(frame, truth));
  };
  const RgbdFrame narrow = smeared(render(phone()), 0.6);
  Scene large = phone();
  large.width = 640, large.image_height = 480;
  large.focal *= 2.5;
  expect_sharp(narrow, render(phone()));
  expect_sharp(enlarged(narrow), render(large));
}

TEST(Smear, IsTakenBackAndSharpDepthIsLeft) {
  const RgbdFrame truth = render(phone()), blurred = smeared(truth);
  Context context;
  EXPECT_FALSE(without_smear(truth, context));
  EXPECT_FALSE(without_smear(render(Scene{phone().boxes}), context));
  const std::optional<RgbdFrame> sharp = without_smear(blurred, context);
  ASSERT_TRUE(sharp);
  EXPECT_GT(off_by_5_cm(blurred, truth), 300u);
  EXPECT_LT(2 * off_by_5_cm(*sharp, truth), off_by_5_cm(blurred, truth));
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
