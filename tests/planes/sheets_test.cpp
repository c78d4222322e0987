// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What is thinner than the scale and seen from both sides.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "planes/scenes.h"

namespace unseen::planes {
namespace {

/// A room with a door's leaf, 4 cm thick and open by `turn`, whose back only the upper half of is seen, and less densely.
double error_of_leaf(double turn, std::uint64_t seed) {
  Random random(seed);
  PointCloud cloud;
  const Mat3 axes = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
  const Vec3 hinge(2.0, 1.5, 0.02), along = axes.col(0), normal = axes.col(1);
  test::add_rectangle(cloud, hinge, 0.86 * along, {0, 0, 2.03}, 0.018, 0.0015, random);
  const std::size_t front = cloud.size();
  test::add_rectangle(cloud, hinge + 0.04 * normal + Vec3(0, 0, 0.9) + 0.3 * along, 0.56 * along, {0, 0, 1.13}, 0.022, 0.0015, random);
  test::add_rectangle(cloud, hinge + 0.86 * along, 0.04 * normal, {0, 0, 2.03}, 0.018, 0.0015, random);
  for (const Vec3& p : test::box_cloud(Vec3::Zero(), {5, 4, 2.6}, 0.04, 0.0015, seed).positions) cloud.positions.push_back(p);
  const test::Run r = test::run(cloud, test::with_scale(0.12));
  std::map<int, int> votes;
  for (std::size_t i = 0; i < front; ++i) ++votes[r.plane_of_point[i]];
  const auto most = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return most->first < 0 ? 90.0 : degrees(line_angle(r.result.planes[most->first].plane.normal, normal));
}

TEST(Sheets, ADoorsLeafHasTheDirectionOfTheSideThatIsSeenBest) {
  for (const double turn : {20.0, 37.0, 55.0})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) EXPECT_LT(error_of_leaf(radians(turn), seed), 0.3) << turn << ", " << seed;
}

}  // namespace
}  // namespace unseen::planes
