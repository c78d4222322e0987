// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What stands only by the tolerance of its contacts.
#include <gtest/gtest.h>

#include "box_problems.h"
#include "cuboids/search/complete.h"

namespace unseen::cuboids {
namespace {

/// A card that is thinner than the tolerance of contacts, standing on its long edge `lean` (rad) out of the upright, 2 mm beside a block that it does not reach.
Problem card_beside_block(double lean, double thickness = 0.003) {
  OrientedBox card = box({0, 0, 0}, {thickness, 0.1, 0.12});
  card.axes = Eigen::AngleAxisd(lean, Vec3::UnitY()).toRotationMatrix();
  card.center.z() = 0.5 * (thickness * std::abs(std::sin(lean)) + 0.12 * std::cos(lean));
  return problem_of({card, box({-0.002 - 0.5 * thickness - 0.05 - 0.06 * std::abs(std::sin(lean)), 0, 0.1}, {0.1, 0.1, 0.2})});
}

std::vector<std::array<int, 2>> fixed_in(const Problem& problem) {
  Context context;
  Arrangement arrangement = arrange(problem, {});
  hold_together(problem, std::vector<char>(problem.bodies(), 0), arrangement, context);
  return arrangement.fixed;
}

TEST(HoldTogether, ACardThatWouldFallIsHeldByItsNeighbour) {
  for (const double lean : {-0.04, 0.0, 0.04}) EXPECT_EQ(fixed_in(card_beside_block(lean)), (std::vector{std::array{1, 2}})) << lean;
}

TEST(HoldTogether, WhatMasksTellApartStaysApart) {
  Problem problem = card_beside_block(0.04);
  problem.cuboids[0].label = "card";
  problem.cuboids[1].label = "block";
  EXPECT_TRUE(fixed_in(problem).empty());
}

TEST(HoldTogether, TellsWhatWouldStillFall) {
  Context context;
  for (const bool far : {false, true}) {
    Problem problem = card_beside_block(0.04);
    if (far) problem.cuboids[1].initial.center.x() -= 0.1;
    Arrangement arrangement = arrange(problem, {});
    EXPECT_EQ(hold_together(problem, std::vector<char>(3, 0), arrangement, context), (std::vector<char>{0, far, 0}));
  }
}

TEST(HoldTogether, WhatStandsAloneNeedsNobody) { EXPECT_TRUE(fixed_in(card_beside_block(0.0, 0.02)).empty()); }

TEST(HoldTogether, AThickBoardThatLeansOnABlockOnlyLeans) {
  Problem problem = card_beside_block(-0.3, 0.03);
  EXPECT_TRUE(fixed_in(problem).empty());
  for (double& tolerance : problem.tolerance) tolerance = 0.01;  // as thin as a card now
  EXPECT_EQ(fixed_in(problem).size(), 1u);
}

TEST(HoldTogether, WhatBalancesOnAnEdgeIsHeldByWhatIsBelow) {
  // Its centre of mass lies half a millimetre, or 1 cm, inside the edge of the pillar.
  for (const double inside : {0.0005, 0.01}) {
    const Problem problem = problem_of({box({0, 0, 0.1}, {0.1, 0.1, 0.2}), box({0.05 - inside, 0, 0.25}, {0.1, 0.1, 0.1})});
    EXPECT_EQ(fixed_in(problem).size(), inside < 0.001 ? 1u : 0u) << inside;
  }
}

TEST(HoldTogether, NobodyHoldsWhatStandsFarOff) {
  Problem problem = card_beside_block(0.04);
  problem.cuboids[1].initial.center.x() -= 0.1;
  EXPECT_TRUE(fixed_in(problem).empty());
}

}  // namespace
}  // namespace unseen::cuboids
