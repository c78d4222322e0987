// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Equilibrium against closed forms, and the proofs that each verdict carries with it.
#include "cuboids/statics/statics.h"

#include <gtest/gtest.h>

#include "cuboids/stacks.h"
#include "unseen/core/error.h"

namespace unseen::cuboids {
namespace {

using test::RigidBox;
using test::RigidScene;
using test::Statics;
using test::statics_of;

constexpr double kStable = 1e-6;

RigidBox rigid_box(const Vec3& center, const Vec3& size, double density = 300.0) {
  return {{center, Mat3::Identity(), 0.5 * size}, density, -1, false};
}

double residual_of(const RigidScene& scene, const Vec3& gravity = -Vec3::UnitZ()) {
  const Statics s = statics_of(scene);
  return balance(s.bodies, s.contacts, gravity).residual;
}

Vec3 tilted(double angle, double yaw = 0.0) {
  return {std::sin(angle) * std::cos(yaw), std::sin(angle) * std::sin(yaw), -std::cos(angle)};
}

TEST(Statics, FloatingBlockFallsWithItsWholeWeight) {
  EXPECT_NEAR(residual_of({{rigid_box({0, 0, 1}, {0.08, 0.08, 0.08})}, {Plane{}}, 0.7}), 1.0, 1e-12);
}

TEST(Statics, StandingStackIsExact) {
  RigidScene scene;
  for (int i = 0; i < 12; ++i) scene.boxes.push_back(rigid_box({0.01 * (i % 2), 0, 0.1 * i + 0.05}, {0.2, 0.2, 0.1}));
  EXPECT_LT(residual_of(scene), 1e-10);
}

TEST(Statics, SlabSlipsAtTheAngleOfFrictionInEveryYaw) {
  for (const double friction : {0.3, 0.7, 1.0})
    for (int yaw = 0; yaw < 360; yaw += 7) {
      RigidScene scene;
      const double slope = std::atan(friction), turn = radians(yaw);
      for (const double off : {-0.1, 0.1}) {
        const double angle = slope + radians(off);
        const Mat3 rotation = Eigen::AngleAxisd(angle, Vec3::UnitY()).toRotationMatrix();
        RigidBox slab = rigid_box({0, 0, 0}, {0.4, 0.25, 0.02});
        slab.box.axes = rotation * Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
        slab.box.center = rotation * Vec3(0.1, 0.2, 0.01);
        const double residual = residual_of({{slab}, {Plane{rotation * Vec3::UnitZ(), 0.0}}, friction});
        EXPECT_EQ(residual < kStable, off < 0) << friction << " " << yaw << " " << off << ": " << residual;
      }
    }
}

TEST(Statics, StackOfCubesTipsWhereItsCentreLeavesTheBase) {
  for (int n = 2; n <= 8; ++n) {
    RigidScene scene;
    scene.friction = 5.0;
    for (int i = 0; i < n; ++i) scene.boxes.push_back(rigid_box({0, 0, 0.1 * i + 0.05}, {0.1, 0.1, 0.1}));
    const double tips = std::atan(1.0 / n);
    EXPECT_LT(residual_of(scene, tilted(tips - radians(0.05))), kStable) << n;
    EXPECT_GT(residual_of(scene, tilted(tips + radians(0.05))), kStable) << n;
  }
}

TEST(Statics, JammedBlockNeedsFrictionThatMeasuredScenesDoNotGrant) {
  RigidScene scene{{rigid_box({0, 0, 1}, {0.2, 0.2, 0.2})}, {{Vec3::UnitX(), -0.1}, {-Vec3::UnitX(), -0.1}}, 0.7};
  Statics s = statics_of(scene);
  EXPECT_LT(balance(s.bodies, s.contacts).residual, kStable);
  for (ContactPoint& c : s.contacts) c.friction = measured_friction(c.normal, c.friction);
  EXPECT_NEAR(balance(s.bodies, s.contacts).residual, 1.0, 1e-9);
  EXPECT_EQ(measured_friction(Vec3(0, std::sin(1.3), std::cos(1.3)), 0.7), 0.7);  // 15.5° from horizontal
}

/// Figure 2.2a of the thesis: two planks whose centres are outside of their pillars, and a beam across their inner
/// ends that holds both down but has nothing under its own centre. It stands if the beam's half weight times the
/// plank's way inwards is at least the plank's weight times its way outwards (without friction, which would thrust).
RigidScene held_together(double beam_density) {
  RigidScene scene;
  scene.friction = 0.0;
  for (const double side : {-1.0, 1.0}) {
    scene.boxes.push_back(rigid_box({side * 0.5, 0, 0.1}, {0.1, 0.1, 0.2}));   // pillar, outer edge at 0.55
    scene.boxes.push_back(rigid_box({side * 0.6, 0, 0.21}, {0.4, 0.1, 0.02}));  // plank from 0.4 to 0.8
  }
  scene.boxes.push_back(rigid_box({0, 0, 0.23}, {0.9, 0.1, 0.02}, beam_density));  // reaches 0.45
  return scene;
}

TEST(Statics, WholeStandsThoughEveryPairFalls) {
  // 0.5 · (0.9 · density) · 0.15 = (0.4 · 300) · 0.05
  const double least = 300.0 * 0.4 * 0.05 / (0.45 * 0.15);
  EXPECT_LT(residual_of(held_together(1.01 * least)), kStable);
  EXPECT_GT(residual_of(held_together(0.99 * least)), kStable);
  const RigidScene whole = held_together(1.5 * least);
  for (const auto& [low, high] : {std::pair{0, 1}, std::pair{2, 3}, std::pair{1, 4}, std::pair{3, 4}}) {
    RigidScene pair{{whole.boxes[low], whole.boxes[high]}, {}, 0.0};
    pair.boxes[0].is_static = true;
    EXPECT_GT(residual_of(pair), 0.05) << low << " " << high;
  }
}

TEST(Statics, WholeFallsThoughEveryPairStands) {  // Figure 2.2b: 3 blocks stand if each steps out by a third at most
  for (const double step : {0.33, 0.34, 0.45}) {
    RigidScene scene;
    for (int i = 0; i < 3; ++i) scene.boxes.push_back(rigid_box({step * i, 0, 0.1 * i + 0.05}, {1, 1, 0.1}));
    EXPECT_EQ(residual_of(scene) < kStable, step < 1.0 / 3.0) << step;
    for (int i = 0; i < 2; ++i) {
      RigidScene pair{{scene.boxes[i], scene.boxes[i + 1]}, {}, 0.7};
      pair.boxes[0].is_static = true;
      EXPECT_LT(residual_of(pair), kStable);
    }
  }
}

TEST(Statics, FixedPartsAreOneBody) {
  RigidScene scene{{rigid_box({0, 0, 0.1}, {0.2, 0.2, 0.2}), rigid_box({0.25, 0, 0.25}, {0.7, 0.2, 0.1})}, {Plane{}}, 0.7};
  EXPECT_GT(residual_of(scene), 0.01);
  scene.boxes[0].group = scene.boxes[1].group = 0;
  EXPECT_GT(residual_of(scene), 0.01);  // the centre of both is at 0.159
  scene.boxes[0].density = 900.0;       // now at 0.092
  EXPECT_LT(residual_of(scene), kStable);
  const Statics s = statics_of(scene);
  ASSERT_EQ(s.bodies.size(), 2u);
  EXPECT_NEAR(s.bodies[1].weight, 9.81 * (900 * 0.008 + 300 * 0.014), 1e-9);
  EXPECT_NEAR(s.bodies[1].center.x(), 0.25 * 300 * 0.014 / (900 * 0.008 + 300 * 0.014), 1e-12);
}

TEST(Statics, MarginAndLeastFrictionOfABlock) {
  const Statics slim = statics_of({{rigid_box({0, 0, 0.2}, {0.1, 0.3, 0.4})}, {Plane{}}, 0.7});
  EXPECT_NEAR(margin(slim.bodies, slim.contacts, kStable), 0.25, 2e-3);
  EXPECT_EQ(friction_needed(slim.bodies, slim.contacts, kStable), 0.0);
  const Statics flat = statics_of({{rigid_box({0, 0, 0.05}, {0.4, 0.3, 0.1})}, {Plane{}}, 0.7});
  EXPECT_NEAR(margin(flat.bodies, flat.contacts, kStable), 0.7, 2e-3);

  const double slope = radians(20.0);
  const Mat3 rotation = Eigen::AngleAxisd(slope, Vec3::UnitX()).toRotationMatrix();
  RigidBox slab = rigid_box(rotation * Vec3(0, 0, 0.01), {0.4, 0.3, 0.02});
  slab.box.axes = rotation;
  const Statics s = statics_of({{slab}, {Plane{rotation * Vec3::UnitZ(), 0.0}}, 0.7});
  EXPECT_NEAR(friction_needed(s.bodies, s.contacts, kStable), std::tan(slope), 3e-3);
  // Pushed down the slope it slips at tan(atan μ − slope).
  EXPECT_NEAR(margin(s.bodies, s.contacts, kStable), std::tan(std::atan(0.7) - slope), 2e-3);
}

TEST(Statics, MarginIsThatOfEveryDirectionTried) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const Statics s = statics_of(test::random_stack(seed).scene);
    const auto stands = [&](double push, int k) {
      const double angle = 2.0 * kPi * k / 16.0;
      return balance(s.bodies, s.contacts, Vec3(push * std::cos(angle), push * std::sin(angle), -1.0)).residual < kStable;
    };
    const double most = margin(s.bodies, s.contacts, kStable);
    bool falls_beyond = most >= 1.0;
    for (int k = 0; k < 16; ++k) {
      if (most > 0.0) {
        EXPECT_TRUE(stands(0.999 * most, k)) << seed;
      }
      falls_beyond |= !stands(most + 3e-3, k);
    }
    EXPECT_TRUE(falls_beyond) << seed;
  }
}

TEST(Statics, EveryVerdictProvesItself) {
  int standing = 0, falling = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    const RigidScene scene = test::random_stack(seed).scene;
    const Statics s = statics_of(scene);
    const Balance b = balance(s.bodies, s.contacts);
    std::vector<Vec6> sum(s.bodies.size(), Vec6::Zero());
    for (std::size_t i = 0; i < s.contacts.size(); ++i) {
      const ContactPoint& c = s.contacts[i];
      const double pressed = b.forces[i].dot(c.normal);
      const double across = (b.forces[i] - pressed * c.normal).norm();
      EXPECT_LE(across, c.friction * pressed + 1e-9 * (1.0 + pressed));
      sum[c.a].head<3>() -= b.forces[i];
      sum[c.a].tail<3>() -= (c.position - s.bodies[c.a].center).cross(b.forces[i]);
      sum[c.b].head<3>() += b.forces[i];
      sum[c.b].tail<3>() += (c.position - s.bodies[c.b].center).cross(b.forces[i]);
    }
    double worst = 0.0, power = 0.0, speed = 0.0;
    for (std::size_t i = 1; i < s.bodies.size(); ++i) {
      const Body& body = s.bodies[i];
      const Vec3 force = sum[i].head<3>() - body.weight * Vec3::UnitZ();
      worst = std::max({worst, force.norm() / body.weight, sum[i].tail<3>().norm() / (body.weight * body.half_size)});
      const Vec3 v = b.velocity(static_cast<int>(i), body), w = b.angular_velocity(static_cast<int>(i), body);
      power -= body.weight * v.z();
      speed = std::max({speed, v.norm(), w.norm() * body.half_size});
    }
    EXPECT_NEAR(worst, b.residual, 1e-9);
    if (b.residual < kStable) {
      ++standing;
      continue;
    }
    ++falling;
    EXPECT_GT(power, 0.0) << seed;
    for (const ContactPoint& c : s.contacts) {
      const auto at = [&](int i) -> Vec3 {
        const Body& body = s.bodies[i];
        return b.velocity(i, body) + b.angular_velocity(i, body).cross(c.position - body.center);
      };
      const Vec3 v = at(c.b) - at(c.a);
      const double apart = v.dot(c.normal);
      EXPECT_GE(apart - c.friction * (v - apart * c.normal).norm(), -2e-4 * speed) << seed;
    }
  }
  EXPECT_GT(standing, 50);
  EXPECT_GT(falling, 50);
}

TEST(Statics, StartAndOrderDoNotMatter) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Statics s = statics_of(test::random_stack(seed).scene);
    const Balance b = balance(s.bodies, s.contacts), again = balance(s.bodies, s.contacts, -Vec3::UnitZ(), b.forces);
    EXPECT_NEAR(b.residual, again.residual, 1e-5);
    Statics reversed = s;
    std::reverse(reversed.contacts.begin(), reversed.contacts.end());
    EXPECT_NEAR(b.residual, balance(reversed.bodies, reversed.contacts).residual, 1e-5);
    EXPECT_EQ(b.residual, balance(s.bodies, s.contacts).residual);  // the same bytes
  }
}

TEST(Statics, EndsWhenAskedToStop) {
  const Statics s = statics_of({{rigid_box({0, 0, 0.1}, {0.2, 0.2, 0.2})}, {Plane{}}, 0.7});
  std::stop_source source;
  Context context;
  context.stop = source.get_token();
  EXPECT_LT(balance(s.bodies, s.contacts, -Vec3::UnitZ(), {}, {}, context).residual, kStable);
  source.request_stop();
  EXPECT_THROW(balance(s.bodies, s.contacts, -Vec3::UnitZ(), {}, {}, context), Cancelled);
  EXPECT_THROW(margin(s.bodies, s.contacts, kStable, 1.0, context), Cancelled);
  EXPECT_THROW(friction_needed(s.bodies, s.contacts, kStable, context), Cancelled);
}

TEST(Statics, RefusesBodiesWithoutWeight) {
  const std::vector<Body> bodies = {{0.0, Vec3::Zero(), 1.0, false}};
  EXPECT_THROW(balance(bodies, {}), std::invalid_argument);
}

}  // namespace
}  // namespace unseen::cuboids
