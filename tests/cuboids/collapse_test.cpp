// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What proves that an arrangement falls.
#include "cuboids/search/collapse.h"

#include <gtest/gtest.h>

#include "cuboids/box_problems.h"
#include "cuboids/search/hypotheses.h"

namespace unseen::cuboids {
namespace {

struct Fall {
  Problem problem;
  Arrangement now;
  std::vector<Touch> touches;
  std::vector<char> held;
  double residual = 0;
  std::vector<Collapse> collapses;

  explicit Fall(const std::vector<OrientedBox>& boxes) : problem(problem_of(boxes)), now(arrange(problem, {})), touches(touching_pairs(problem, now)), held(problem.bodies(), 0) {
    const Structure structure = structure_of(problem, now, touches, held);
    const Balance b = balance(structure.bodies, structure.contacts);
    residual = b.residual;
    collapses = collapses_of(motion_left(b, -Vec3::UnitZ(), structure, problem), problem, now, touches, held);
  }
};

/// A box at the edge of a table, its middle `beyond` the edge (m), all turned by `yaw`.
Fall at_the_edge(double beyond, double yaw) {
  const Mat3 turn = Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix();
  const auto placed = [&](const Vec3& center, const Vec3& size) {
    OrientedBox b = box(turn * center, size);
    b.axes = turn;
    return b;
  };
  return Fall({placed({0, 0, 0.2}, {0.4, 0.4, 0.4}), placed({0.2 + beyond, 0.03, 0.45}, {0.3, 0.2, 0.1})});
}

TEST(Collapse, ProvesThatABoxTipsOverTheEdgeItTurnsAbout) {
  for (int i = 0; i < 24; ++i) {  // the points that it turns about move by what rounding leaves
    const Fall fall = at_the_edge(0.05, 0.1 + 0.25 * i);
    ASSERT_GT(fall.residual, fall.problem.stable_residual);
    ASSERT_EQ(fall.collapses.size(), 1u) << i;
    EXPECT_TRUE(fall.collapses[0].motion[1].is_zero());
    const double proven = proven_residual(fall.collapses[0], fall.problem, fall.now, fall.touches, fall.held);
    EXPECT_GE(proven, fall.problem.stable_residual);
    EXPECT_LE(proven, fall.residual + 1e-9);  // no forces leave less
  }
}

TEST(Collapse, OfWhatStandsThereIsNone) {
  for (int i = 0; i < 24; ++i) {
    const Fall fall = at_the_edge(-0.05, 0.1 + 0.25 * i);
    EXPECT_LT(fall.residual, 1e-9);
    EXPECT_TRUE(fall.collapses.empty());
  }
}

TEST(Collapse, OfOneArrangementProvesNothingOfOneThatResists) {
  const Fall falls = at_the_edge(0.05, 0.7), stands = at_the_edge(-0.05, 0.7);
  ASSERT_EQ(falls.collapses.size(), 1u);
  EXPECT_EQ(proven_residual(falls.collapses[0], stands.problem, stands.now, stands.touches, stands.held), 0.0);
}

TEST(Collapse, IsStoppedByOpenHypothesesOnly) {
  Fall fall = at_the_edge(0.05, 0.7);
  ASSERT_EQ(fall.collapses.size(), 1u);
  Rooms rooms(2);
  for (Extension& e : rooms) e = {0.5, 0.5, 0.5, 0.5, 0.5, 0.0};
  fall.problem.hypotheses = propose_contacts(fall.problem, rooms);
  const int count = static_cast<int>(fall.problem.hypotheses.size());
  std::vector<int> all(count);
  for (int h = 0; h < count; ++h) all[h] = h;
  const Arrangement largest = arrange(fall.problem, all);
  std::vector<char> closed(count, 0);
  const std::vector<int> open = remedies(fall.collapses[0], fall.problem, fall.now, largest, fall.held, closed);
  ASSERT_GT(open.size(), 1u);
  closed[open.front()] = 1;
  EXPECT_EQ(remedies(fall.collapses[0], fall.problem, fall.now, largest, fall.held, closed), std::vector<int>(open.begin() + 1, open.end()));
}

}  // namespace
}  // namespace unseen::cuboids
