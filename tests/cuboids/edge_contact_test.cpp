// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Boxes that meet along parallel edges.
#include "cuboids/statics/edge_contact.h"

#include <gtest/gtest.h>

#include "cuboids/stacks.h"
#include "cuboids/statics/statics.h"

namespace unseen::cuboids {
namespace {

constexpr double kStable = 1e-6;

Mat3 turn(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

/// A slab of 1 m with its lower edge on the ground, leaning to the right (or, mirrored, to the left) at an
/// angle from the horizontal; its outermost edge is at x = 0.
OrientedBox leaning(double angle, double thick, bool mirrored) {
  OrientedBox slab{Vec3::Zero(), turn(Vec3::UnitY(), -angle), 0.5 * Vec3(1.0, 0.2, thick)};
  slab.center.x() = -0.5 * (std::cos(angle) + thick * std::sin(angle));
  slab.center.z() = 0.5 * (std::sin(angle) + thick * std::cos(angle));
  if (mirrored) {
    slab.axes = turn(Vec3::UnitY(), angle);
    slab.center.x() *= -1.0;
  }
  return slab;
}

TEST(EdgeContact, LeaningSlabsMeetAlongAnEdgeWithALevelNormal) {
  for (const double degrees : {30.0, 50.0, 60.0, 75.0})
    for (const double thick : {0.001, 0.01, 0.05}) {
      const ConvexSolid left = solid_of(leaning(radians(degrees), thick, false));
      const ConvexSolid right = solid_of(leaning(radians(degrees), thick, true));
      const auto met = interface_of(left, right, 5e-5), back = interface_of(right, left, 5e-5);
      ASSERT_TRUE(met && back) << degrees << " " << thick;
      EXPECT_LT((met->normal - Vec3::UnitX()).norm(), 1e-9) << degrees << " " << thick;
      EXPECT_LT((met->normal + back->normal).norm(), 1e-9);
      EXPECT_NEAR(met->gap, 0.0, 1e-9);
      ASSERT_EQ(met->points.size(), 2u) << degrees << " " << thick;
      EXPECT_NEAR((met->points[0] - met->points[1]).norm(), 0.2, 1e-9);
      for (const Vec3& p : met->points) EXPECT_NEAR(p.x(), 0.0, 1e-9);
    }
}

TEST(EdgeContact, ThinCardHouseStandsWithFrictionOfHalfTheCotangent) {
  for (const double degrees : {50.0, 60.0, 70.0})
    for (const double share : {0.97, 1.03}) {
      const double angle = radians(degrees);
      test::RigidScene scene{{}, {Plane{}}, share * 0.5 / std::tan(angle)};
      for (const bool mirrored : {false, true})
        scene.boxes.push_back({leaning(angle, 1e-4, mirrored), 300.0, -1, false});
      const test::Statics s = test::statics_of(scene);
      const bool stands = balance(s.bodies, s.contacts).residual < kStable;
      EXPECT_EQ(stands, share > 1.0) << degrees << " " << share;
    }
}

TEST(EdgeContact, CornersOfAnyGridCarryNothing) {
  for (const double degrees : {0.0, 20.0, 45.0}) {
    const Mat3 axes = turn(Vec3::UnitY(), radians(degrees));
    const auto at = [&](double x, double y, double z) {
      return solid_of(OrientedBox{axes * Vec3(x, y, z), axes, {0.1, 0.12, 0.05}});
    };
    for (const double y : {0.0, 0.1}) {
      EXPECT_FALSE(interface_of(at(0, 0, 0), at(0.2, y, 0.1), 1e-6)) << degrees;
      EXPECT_FALSE(interface_of(at(0, 0, 0), at(0.2, y, -0.1), 1e-6)) << degrees;
      EXPECT_FALSE(interface_of(at(0, 0, 0), at(0.203, y, 0.103), 0.008)) << degrees;
    }
  }
}

TEST(EdgeContact, NeedsEdgesThatPassEachOtherAndAreNear) {
  const OrientedBox left = leaning(radians(60.0), 0.05, false);
  OrientedBox right = leaning(radians(60.0), 0.05, true);
  right.center.y() = 0.15;
  const auto part = interface_of(solid_of(left), solid_of(right), 5e-5);
  ASSERT_TRUE(part);
  EXPECT_NEAR((part->points[0] - part->points[1]).norm(), 0.05, 1e-9);
  right.center.y() = 0.2001;
  EXPECT_FALSE(interface_of(solid_of(left), solid_of(right), 5e-5));
  right.center = Vec3(right.center.x() + 4e-5, 0.0, right.center.z());
  const auto near = interface_of(solid_of(left), solid_of(right), 5e-5);
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->gap, 4e-5, 1e-9);
  right.center.x() += 2e-5;
  EXPECT_FALSE(interface_of(solid_of(left), solid_of(right), 5e-5));
}

}  // namespace
}  // namespace unseen::cuboids
