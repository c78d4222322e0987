// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/selection/doubt.h"

#include <gtest/gtest.h>

#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

/// Walls of one frame that are off it by `sd` degrees each, the first of an area of its own, and small sides of a thing that is turned by 2 degrees.
double shown_by_walls(double sd, std::size_t count, std::size_t turned = 0, double largest = 1) {
  Random random(3);
  Patches patches;
  Selection s;
  s.frames = {{Mat3::Identity(), true}};
  for (std::size_t i = 0; i < count + turned; ++i) {
    Patch p;
    const int axis = static_cast<int>(i % 3);
    p.fit.normal = Eigen::AngleAxisd(radians(sd) * random.normal(), Vec3::Unit((axis + 1) % 3)) *
                   (Eigen::AngleAxisd(radians(sd) * random.normal(), Vec3::Unit((axis + 2) % 3)) * Vec3(Vec3::Unit(axis)));
    if (i >= count) p.fit.normal = Eigen::AngleAxisd(radians(2), Vec3(Vec3::UnitZ())) * p.fit.normal;
    p.fit.u = any_orthogonal(p.fit.normal);
    p.fit.v = p.fit.normal.cross(p.fit.u);
    p.area = i == 0 ? largest : i < count ? 1 : 0.02;
    p.systematic_u = p.systematic_v = std::pow(radians(0.5), 2);
    p.doubt_u = p.doubt_v = 1.01 * p.systematic_u;
    patches.patches.push_back(p);
    s.frame_of_patch.push_back(0);
    s.local_of_patch.push_back(axis);
  }
  return shown_doubt(patches, s, local_directions(make_angles({radians(90)}), {}));
}

TEST(Doubt, FollowsTheScatterOfWalls) {
  EXPECT_EQ(shown_by_walls(0.0, 60), 0.1);
  EXPECT_NEAR(shown_by_walls(0.1, 60), 2.4 * 0.2, 0.12);
  EXPECT_EQ(shown_by_walls(0.5, 60), 1.0);
  EXPECT_EQ(shown_by_walls(0.0, 4), 1.0);  // too few to tell
  EXPECT_EQ(shown_by_walls(0.5, 60, 0, 1000), 1.0);  // a roof that turns the frame with itself says nothing
  EXPECT_LT(shown_by_walls(0.0, 6, 5), 0.3);  // walls tell, not what is in their frame by chance
}

/// Boxes that are turned by half a degree against each other, each of patches that adjoin at angles which are off by `sd` degrees.
double shown_by_edges(double sd, std::size_t boxes) {
  Random random(4);
  Patches patches;
  for (std::size_t b = 0; b < boxes; ++b) {
    const Mat3 axes = Eigen::AngleAxisd(radians(0.5) * random.normal(), Vec3::UnitZ()).toRotationMatrix();
    for (int a = 0; a < 3; ++a) {
      Patch p;
      p.fit.normal = Eigen::AngleAxisd(radians(sd) * random.normal(), axes.col((a + 1) % 3)) * Vec3(axes.col(a));
      p.fit.u = any_orthogonal(p.fit.normal);
      p.fit.v = p.fit.normal.cross(p.fit.u);
      p.area = 1;
      p.systematic_u = p.systematic_v = std::pow(radians(0.5), 2);
      p.doubt_u = p.doubt_v = 1.01 * p.systematic_u;
      for (int other = 0; other < a; ++other) patches.adjoining.emplace_back(static_cast<int>(patches.patches.size()) - a + other, static_cast<int>(patches.patches.size()));
      patches.patches.push_back(p);
    }
  }
  return doubt_at_edges(patches, make_angles({radians(90)}));
}

TEST(Doubt, IsWhatEdgesShow) {
  EXPECT_EQ(shown_by_edges(0.0, 20), 0.1);
  EXPECT_NEAR(shown_by_edges(0.1, 40), 2.4 * 0.1 / 0.5 / std::sqrt(2.0), 0.12);  // one of the two turns about the edge
  EXPECT_EQ(shown_by_edges(0.8, 40), 1.0);
  EXPECT_EQ(shown_by_edges(0.0, 3), 1.0);  // too few to tell
}

}  // namespace
}  // namespace unseen::planes
