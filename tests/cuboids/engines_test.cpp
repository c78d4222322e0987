// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Statics against physics engines. bench/cuboids_engines does the same with some 300 stacks.
#include <gtest/gtest.h>

#include "cuboids/stacks.h"

namespace unseen::test {
namespace {

constexpr double kStill = 0.05;

TEST(Engines, DropABoxAndHoldOne) {
  RigidScene scene;
  scene.boxes = {{{{0, 0, 0.05}, Mat3::Identity(), {0.1, 0.1, 0.05}}, 300, -1, false},
                 {{{1, 0, 0.5}, Mat3::Identity(), {0.1, 0.1, 0.05}}, 300, -1, false},
                 {{{2, 0, 0.5}, Mat3::Identity(), {0.1, 0.1, 0.05}}, 300, -1, true},
                 {{{2.2, 0, 0.6}, Mat3::Identity(), {0.1, 0.1, 0.05}}, 300, 7, false},   // fixed to the next,
                 {{{2.0, 0, 0.6}, Mat3::Identity(), {0.1, 0.1, 0.05}}, 900, 7, false}};  // which rests on the static one
  for (const Settled& s : {settle_mujoco(scene, 1.0), settle_bullet(scene, 1.0)}) {
    EXPECT_LT(s.moves[0], 0.01);
    EXPECT_NEAR(s.poses[1].translation.z(), -0.45, 0.01);
    EXPECT_EQ(s.moves[2], 0.0);
    EXPECT_LT(s.moves[3], 0.02);
    EXPECT_LT(s.moves[4], 0.02);
    EXPECT_EQ(s.largest_move, s.moves[1]);
  }
}

TEST(Engines, BothDecideClearStacksAsStaticsDoes) {
  int clear = 0, standing = 0;
  for (std::uint64_t seed = 0; seed < 70; ++seed) {
    const Stack stack = random_stack(seed);
    const Verdict verdict = decide(stack.scene);
    if (!verdict.is_clear) continue;
    const bool in_bullet = settle_bullet(stack.scene).largest_move < kStill;
    EXPECT_EQ(in_bullet, verdict.stands) << stack.kind << " " << seed << " " << verdict.residual;
    ++clear;
    standing += verdict.stands;
    // The other engine is ten times as slow.
    if (stack.scene.boxes.size() > 3 || seed % 3 != 0) continue;
    EXPECT_EQ(settle_mujoco(stack.scene).largest_move < kStill, verdict.stands) << stack.kind << " " << seed;
  }
  EXPECT_GE(clear, 50);
  EXPECT_GT(standing, 15);
  EXPECT_LT(standing, clear - 15);
}

}  // namespace
}  // namespace unseen::test
