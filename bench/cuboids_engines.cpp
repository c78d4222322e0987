// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What statics says of random stacks beside what two physics engines do with them for 2 s. Writes a table to
// standard output; ends with 1 if a clear verdict differs from that of both engines.
//   cuboids_engines [FIRST [COUNT]] > results/cuboids_engines.csv
#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "cuboids/stacks.h"

int main(int argc, char** argv) {
  using namespace unseen::test;
  constexpr double kStill = 0.05;  // of a box's diagonal
  const std::uint64_t first = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 0;
  const std::uint64_t count = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 390;
  int agreed = 0, same = 0;
  fmt::print("seed,kind,boxes,friction,residual,margin_g,clear,stands,mujoco_move,bullet_move,engines_agree,same\n");
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Stack stack = random_stack(seed);
    const Verdict verdict = decide(stack.scene);
    if (!verdict.is_clear) continue;
    const double mujoco = settle_mujoco(stack.scene).largest_move, bullet = settle_bullet(stack.scene).largest_move;
    const bool agree = (mujoco < kStill) == (bullet < kStill);
    const bool is_same = agree && (mujoco < kStill) == verdict.stands;
    agreed += agree;
    same += is_same;
    fmt::print("{},{},{},{:.3f},{:.3g},{:.3f},{:d},{:d},{:.4f},{:.4f},{:d},{:d}\n", seed, stack.kind,
               stack.scene.boxes.size(), stack.scene.friction, verdict.residual < 1e-6 ? 0.0 : verdict.residual,
               verdict.margin, verdict.is_clear, verdict.stands, mujoco, bullet, agree, is_same);
    std::fflush(stdout);
  }
  fmt::print(stderr, "{} clear stacks on which the engines agree, {} decided as they do\n", agreed, same);
  return agreed == same ? 0 : 1;
}
