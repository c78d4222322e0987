// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Light bodies that carry heavy ones, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>

#include "cuboids/stacks.h"
#include "cuboids/statics/contact_loads.h"
#include "cuboids/statics/statics.h"

namespace unseen::cuboids {
namespace {

using test::RigidBox;
using test::RigidScene;
using test::Statics;
using test::statics_of;

constexpr double kStands = 1e-6;

RigidBox rigid_box(const Vec3& center, const Vec3& size, double density = 300.0) {
  return {{center, Mat3::Identity(), 0.5 * size}, density, -1, false};
}

Statics cube_on_cube(double ratio) {
  return statics_of({{rigid_box({0, 0, 0.5}, {1, 1, 1}, 1.0), rigid_box({0, 0, 1.5}, {1, 1, 1}, ratio)}, {Plane{}}, 0.7});
}

double margin_of(const Statics& s) {
  return margin(s.bodies, s.contacts, kStands);
}

TEST(HeavyLoads, CubeOfAnyDensityStandsOnItsLike) {
  for (const double ratio : {1e-5, 1e-2, 1.0, 1e2, 2e2, 4e2, 1e3, 2e3, 1e4, 1e5}) {
    const Statics s = cube_on_cube(ratio);
    const Balance b = balance(s.bodies, s.contacts);
    EXPECT_LT(b.residual, kStands) << ratio;
    double carried = 0.0;
    for (std::size_t i = 0; i < s.contacts.size(); ++i)
      if (s.contacts[i].a == 0) carried += b.forces[i].z();
    EXPECT_NEAR(carried / (9.81 * (1.0 + ratio)), 1.0, 1e-6) << ratio;
    // Both tip together where their common centre leaves the base.
    EXPECT_NEAR(margin_of(s), std::min(0.7, 0.5 * (1.0 + ratio) / (0.5 + 1.5 * ratio)), 2e-3) << ratio;
    EXPECT_EQ(friction_needed(s.bodies, s.contacts, kStands), 0.0) << ratio;
  }
}

TEST(HeavyLoads, WhatIsPushedTooHardFallsByAMotionThatNothingBrakes) {
  for (const double ratio : {1e2, 1e3, 1e4, 1e5})
    for (const double push : {0.34, 0.5, 0.8, 1.0}) {
      const Statics s = cube_on_cube(ratio);
      const Vec3 gravity(push, 0.0, -1.0);
      const Balance b = balance(s.bodies, s.contacts, gravity);
      EXPECT_GT(b.residual, 1e-3) << ratio << " " << push;
      EXPECT_LT(b.residual, 1.0) << ratio << " " << push;
      double power = 0.0, speed = 0.0;
      for (std::size_t i = 1; i < s.bodies.size(); ++i) {
        const Body& body = s.bodies[i];
        power += body.weight * b.velocity(static_cast<int>(i), body).dot(gravity);
        speed = std::max(speed, b.velocity(static_cast<int>(i), body).norm());
      }
      EXPECT_GT(power, 0.0);
      for (const ContactPoint& c : s.contacts) {
        const auto at = [&](int i) -> Vec3 {
          return b.velocity(i, s.bodies[i]) +
                 b.angular_velocity(i, s.bodies[i]).cross(c.position - s.bodies[i].center);
        };
        const Vec3 v = at(c.b) - at(c.a);
        const double apart = v.dot(c.normal);
        EXPECT_GE(apart - c.friction * (v - apart * c.normal).norm(), -2e-4 * speed) << ratio << " " << push;
      }
    }
}

TEST(HeavyLoads, CubeOnASmallOneTipsOverItsEdge) {
  for (const double size : {0.2, 0.1, 0.05, 0.03}) {
    const Statics s = statics_of(
        {{rigid_box({0, 0, 0.5 * size}, {size, size, size}), rigid_box({0, 0, size + 0.5}, {1, 1, 1})}, {Plane{}}, 0.7});
    EXPECT_LT(balance(s.bodies, s.contacts).residual, kStands) << size;
    const double small = size * size * size;
    EXPECT_NEAR(margin_of(s), 0.5 * size * (1.0 + small) / (size + 0.5 + 0.5 * size * small), 2e-3) << size;
  }
}

TEST(HeavyLoads, SlabOnFourSmallFeetSlips) {
  for (const double size : {0.1, 0.05, 0.02}) {
    RigidScene scene{{rigid_box({0, 0, size + 0.25}, {1, 1, 0.5})}, {Plane{}}, 0.7};
    for (const double x : {-0.4, 0.4})
      for (const double y : {-0.4, 0.4}) scene.boxes.push_back(rigid_box({x, y, 0.5 * size}, {size, size, size}));
    const Statics s = statics_of(scene);
    EXPECT_LT(balance(s.bodies, s.contacts).residual, kStands) << size;
    EXPECT_NEAR(margin_of(s), 0.7, 2e-3) << size;
  }
}

TEST(HeavyLoads, TallStackTipsAtOneOverItsHeight) {
  RigidScene scene{{}, {Plane{}}, 0.7};
  for (int i = 0; i < 100; ++i) scene.boxes.push_back(rigid_box({0, 0, 0.1 * i + 0.05}, {0.1, 0.1, 0.1}));
  EXPECT_NEAR(margin_of(statics_of(scene)), 0.01, 1.5e-3);
}

TEST(HeavyLoads, LoadsGoDownByAllWays) {
  // 1000 N on two bodies of 1 N, one on the ground by a single contact, the other by two.
  const std::vector<Body> bodies = {{0, Vec3::Zero(), 0, true},
                                    {1, Vec3::Zero(), 1, false},
                                    {1, Vec3::Zero(), 1, false},
                                    {1000, Vec3::Zero(), 1, false}};
  std::vector<ContactPoint> contacts;
  for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {0, 2}, {1, 3}, {2, 3}})
    contacts.push_back({a, b, Vec3::Zero(), Vec3::UnitZ(), 0.7});
  const std::vector<double> loads = contact_loads(bodies, contacts);
  EXPECT_NEAR(loads[0] + loads[1] + loads[2], 1002.0, 0.1);
  EXPECT_NEAR(loads[3] + loads[4], 1000.0, 0.1);
  EXPECT_NEAR(loads[1], loads[2], 1e-9);
  EXPECT_NEAR(loads[3] * 2.0, loads[4] * 1.5, 2.0);  // by resistance
}

}  // namespace
}  // namespace unseen::cuboids
