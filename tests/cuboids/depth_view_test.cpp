// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/surfaces/depth_view.h"

#include <gtest/gtest.h>

namespace unseen::cuboids {
namespace {

using Space = DepthView::Space;

/// A wall at 2 m, with one pixel that was not measured.
RgbdFrame wall() {
  RgbdFrame frame;
  frame.camera = {100, 100, 49.5, 49.5, 100, 100};
  frame.depth.assign(100 * 100, 2.0f);
  frame.depth[50 * 100 + 50] = 0.0f;
  return frame;
}

TEST(DepthView, TellsFreeFromHiddenSpace) {
  const DepthView view(wall(), {}, 0.0015);  // sigma at 2 m: 6 mm
  EXPECT_EQ(view.at({0.2, 0.2, 1.5}), Space::free);
  EXPECT_EQ(view.at({0.2, 0.2, 1.99}), Space::surface);
  EXPECT_EQ(view.at({0.2, 0.2, 2.5}), Space::hidden);
  EXPECT_EQ(view.at({0.005, 0.005, 1.0}), Space::missing);  // not measured
  EXPECT_EQ(view.at({5.0, 0.0, 1.0}), Space::outside);    // outside
  EXPECT_EQ(view.at({0.0, 0.0, -1.0}), Space::outside);   // behind
  EXPECT_NEAR(view.sigma({0, 0, 2}), 0.006, 1e-12);
}

TEST(DepthView, TakesAFusedCloudFromItsViewpoint) {
  RgbdFrame frame;
  for (int i = 0; i < 400; ++i)
    for (int j = 0; j < 400; ++j) frame.cloud.positions.emplace_back(0.005 * i - 1.0, 3.0, 0.005 * j);
  const Vec3 eye(0, 0, 1);
  const DepthView view(frame, {Mat3::Identity(), Vec3::Zero()}, 0.0015);
  const DepthView moved(frame, {Mat3::Identity(), eye}, 0.0015);
  EXPECT_EQ(view.at({0.1, 1.5, 0.5}), Space::free);
  EXPECT_EQ(view.at({0.2, 6.0, 1.0}), Space::hidden);
  EXPECT_EQ(view.at({0.0, -1.0, 0.0}), Space::missing);
  EXPECT_LT((moved.viewpoint() - eye).norm(), 1e-12);
}

}  // namespace
}  // namespace unseen::cuboids
