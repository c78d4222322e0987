// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Boxes that by noise do not quite touch what they rest on.
#include <gtest/gtest.h>

#include "box_problems.h"
#include "cuboids/search/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kLeft = 0.0004;  // m that may be left of a gap

std::vector<OrientedBox> settled(const Problem& problem) {
  Context context;
  Arrangement arrangement = arrange(problem, {});
  settle(problem, std::vector<char>(problem.bodies(), 0), arrangement, context);
  return arrangement.boxes;
}

double lowest(const OrientedBox& b) {
  double z = INFINITY;
  for (const Vec3& v : solid_of(b).vertices) z = std::min(z, v.z());
  return z;
}

TEST(Settle, WhatHoversComesDown) {
  const auto boxes = settled(problem_of({box({0, 0, 0.104}, {0.2, 0.3, 0.2}), box({0.02, 0, 0.257}, {0.1, 0.1, 0.1})}));
  EXPECT_NEAR(boxes[0].center.z(), 0.1, kLeft);
  EXPECT_NEAR(boxes[1].center.z(), 0.25, 2 * kLeft);
  EXPECT_NEAR(boxes[1].center.x(), 0.02, kLeft);
}

TEST(Settle, WhatIsAskewLiesFlat) {
  for (const double angle : {0.02, 0.05}) {
    OrientedBox b = box({0, 0, 0}, {0.2, 0.2, 0.1});
    b.axes = Eigen::AngleAxisd(angle, Vec3(1, 0.5, 0).normalized()).toRotationMatrix();
    b.center.z() -= lowest(b);
    const auto boxes = settled(problem_of({b}));
    EXPECT_LT(line_angle(boxes[0].axes.col(2), Vec3::UnitZ()), kLeft / 0.1) << angle;
    EXPECT_NEAR(lowest(boxes[0]), 0.0, kLeft) << angle;
  }
}

TEST(Settle, APlankRestsOnBothOfItsPiers) {
  const auto boxes = settled(problem_of({box({-0.25, 0, 0.1}, {0.1, 0.1, 0.2}), box({0.25, 0, 0.0975}, {0.1, 0.1, 0.195}), box({0, 0, 0.22}, {0.6, 0.1, 0.04})}));
  // It turns about the inner edge of the higher one until it meets the outer edge of the lower one.
  EXPECT_NEAR(line_angle(boxes[2].axes.col(2), Vec3::UnitZ()), 0.005 / 0.5, 0.0008);
  for (int pier : {0, 1}) EXPECT_TRUE(boxes[pier].axes.isApprox(Mat3::Identity(), 1e-9));
}

TEST(Settle, WhatWouldToppleStaysAsItWasSeen) {
  OrientedBox card = box({0, 0, 0}, {0.02, 0.1, 0.2});
  card.axes = Eigen::AngleAxisd(0.15, Vec3::UnitY()).toRotationMatrix();
  card.center.z() -= lowest(card);
  const auto boxes = settled(problem_of({card, box({0.5, 0, 0.053}, {0.1, 0.1, 0.1})}));
  EXPECT_EQ(boxes[0].axes, card.axes);
  EXPECT_EQ(boxes[0].center, card.center);
  EXPECT_NEAR(boxes[1].center.z(), 0.05, kLeft);  // the other one comes down all the same
}

}  // namespace
}  // namespace unseen::cuboids
