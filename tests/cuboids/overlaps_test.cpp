// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What boxes around visible parts have that bodies cannot have: overlaps, and nothing that holds them.
#include <gtest/gtest.h>

#include "box_problems.h"
#include "cuboids/search/complete.h"
#include "cuboids/search/trims.h"
#include "unseen/cuboids/evaluate.h"

namespace unseen::cuboids {
namespace {

/// From (0, −3, 1) along +y: measures the same depth everywhere, before which all is free and behind which all is hidden.
DepthView view_of(float depth) {
  RgbdFrame frame;
  frame.camera = {100, 100, 49.5, 49.5, 100, 100};
  frame.depth.assign(100 * 100, depth);
  RigidTransform T;
  T.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  T.translation = {0, -3, 1};
  return {frame, T, 0.001};
}

double overlap(const OrientedBox& a, const OrientedBox& b) {
  const auto meet = interface_of(solid_of(a), solid_of(b), 0.0);
  return meet ? std::max(0.0, -meet->gap) : 0.0;
}

TEST(Overlaps, EndWithTheHiddenFace) {
  // One behind the other: the back of the nearer one was not seen, the front of the farther one was.
  Problem problem = problem_of({box({0, 0, 0.1}, {0.2, 0.2, 0.2}), box({0, 0.18, 0.2}, {0.2, 0.2, 0.4})});
  part_overlaps(view_of(2.9f), problem);
  EXPECT_NEAR(overlap(problem.cuboids[0].initial, problem.cuboids[1].initial), 0.0, 2e-6);
  EXPECT_NEAR(2.0 * problem.cuboids[0].initial.half_size.y(), 0.18, 1e-5);
  EXPECT_NEAR(2.0 * problem.cuboids[1].initial.half_size.y(), 0.2, 1e-9);
  EXPECT_TRUE(problem.joints.empty());
}

TEST(Overlaps, OfTurnedBoxesEndToo) {
  Problem problem = problem_of({box({0, 0, 0.1}, {0.2, 0.2, 0.2}, 0.3), box({0.19, 0.05, 0.1}, {0.2, 0.2, 0.2}, -0.4)});
  ASSERT_GT(overlap(problem.cuboids[0].initial, problem.cuboids[1].initial), 0.01);
  part_overlaps(view_of(2.9f), problem);
  EXPECT_LT(overlap(problem.cuboids[0].initial, problem.cuboids[1].initial), 2e-6);
}

TEST(Overlaps, TooDeepMakeOneRigidBody) {
  Problem problem = problem_of({box({0, 0, 0.1}, {0.2, 0.2, 0.2}), box({0.05, 0, 0.12}, {0.16, 0.16, 0.16}, 0.5)});
  const OrientedBox before = problem.cuboids[1].initial;
  part_overlaps(view_of(2.9f), problem);
  ASSERT_EQ(problem.joints.size(), 1u);
  EXPECT_EQ(problem.joints[0], (std::array{1, 2}));
  EXPECT_EQ(problem.cuboids[1].initial.half_size, before.half_size);
}

TEST(Overlaps, LiftNothingOffTheGround) {
  // A flat thing that seems to reach under a box; the box was seen to stand on the ground.
  Problem problem = problem_of({box({0, 0, 0.05}, {0.2, 0.2, 0.1}), box({-0.19, 0, 0.01}, {0.3, 0.1, 0.02})});
  part_overlaps(view_of(2.9f), problem);
  EXPECT_NEAR(problem.cuboids[0].initial.half_size.z(), 0.05, 1e-9);
}

TEST(Overlaps, OfKnownObjectsJoinNothing) {
  Problem problem = problem_of({box({0, 0, 0.1}, {0.2, 0.2, 0.2}), box({0.05, 0, 0.12}, {0.16, 0.16, 0.16}, 0.5)});
  problem.cuboids[0].label = "1";
  problem.cuboids[1].label = "2";
  part_overlaps(view_of(2.9f), problem);
  EXPECT_TRUE(problem.joints.empty());
}

TEST(Overlaps, ThatAreLeftAtTheEndEndToo) {
  // Small: a face gives way. Deep: nothing can, so they are fixed.
  const Problem problem = problem_of({box({0, 0, 0.1}, {0.2, 0.2, 0.2}), box({0.195, 0, 0.1}, {0.2, 0.2, 0.2}), box({0.6, 0, 0.1}, {0.2, 0.2, 0.2}),
                                      box({0.63, 0.02, 0.12}, {0.16, 0.16, 0.16}, 0.5)});
  Arrangement a = arrange(problem, {});
  end_overlaps(view_of(2.9f), problem, std::vector<char>(5, 0), a);
  EXPECT_LT(overlap(a.boxes[0], a.boxes[1]), 1e-3);
  ASSERT_EQ(a.fixed.size(), 1u);
  EXPECT_EQ(a.fixed[0], (std::array{3, 4}));
}

TEST(Overlaps, WithTheGroundBeyondItsOutlineEndUnlessHeld) {
  // Tilted: inside the outline its lower side is above the ground, beyond it 5 mm below.
  OrientedBox tilted = box({0, 0, 0}, {0.2, 0.2, 0.2});
  tilted.axes = Eigen::AngleAxisd(0.1, Vec3::UnitY()).toRotationMatrix();
  tilted.center = Vec3(1.05, 0, -0.005) - tilted.axes * Vec3(0.1, 0, -0.1);
  Problem problem = problem_of({tilted});
  problem.supports[0].outline = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  for (const char held : {0, 1}) {
    Arrangement a = arrange(problem, {});
    end_overlaps(view_of(1.0f), problem, {0, held}, a);
    const double lowest = (a.boxes[0].center + a.boxes[0].axes * a.boxes[0].half_size.cwiseProduct(Vec3(1, 1, -1))).z();
    EXPECT_NEAR(lowest, held ? -0.005 : 0.0, 1e-4);
    EXPECT_TRUE(a.fixed.empty());
  }
}

/// Two boxes, the fronts of which were seen in one plane, y = −0.1; they share x from 0 to 0.2.
std::vector<OrientedBox> deep() { return {box({0, 0, 0.1}, {0.4, 0.2, 0.2}), box({0.15, 0.1, 0.1}, {0.3, 0.4, 0.2})}; }

TEST(Trims, LeaveWhatWasMeasuredInABox) {
  const std::vector<OrientedBox> boxes = deep();
  const std::vector<Trim> trims = trims_of(view_of(2.9f), boxes, {0.006, 0.006}, {0, 1});
  ASSERT_FALSE(trims.empty());
  EXPECT_EQ(trims.front().cuboid, 0);  // the smaller one loses nothing else
  EXPECT_EQ(trims.front().face, 1);
  EXPECT_NEAR(trims.front().length, 0.2, 1e-9);
  for (const Trim& trim : trims) EXPECT_FALSE(trim.cuboid == 1 && trim.face == 2);  // its front was measured where nothing else is
}

TEST(Trims, EndOverlapsOfRigidBodies) {
  const Problem problem = problem_of(deep());
  for (const bool rigid : {false, true}) {
    Arrangement a = arrange(problem, {});
    if (rigid) a.fix({1, 2});
    const double before = intersection_volume(a.boxes[0], a.boxes[1]);
    Context context;
    trim_overlaps(view_of(2.9f), problem, std::vector<char>(3, 0), a, context);
    EXPECT_NEAR(before, 0.008, 1e-9);
    EXPECT_NEAR(intersection_volume(a.boxes[0], a.boxes[1]), rigid ? 0.0 : before, 1e-9);
    EXPECT_NEAR(a.boxes[0].volume(), rigid ? 0.008 : 0.016, 1e-9);
    EXPECT_EQ(a.fixed.size(), rigid ? 1u : 0u);
  }
}

TEST(Trims, TakeNothingAwayFromWhatTouches) {
  // A third one touches the first where its end would go.
  for (const bool third : {false, true}) {
    std::vector<OrientedBox> boxes = {box({0, 0, 0.1}, {0.4, 0.2, 0.2}), box({0.15, 0.15, 0.1}, {0.3, 0.4, 0.2})};
    if (third) boxes.push_back(box({0.1, -0.15, 0.1}, {0.1, 0.1, 0.2}));
    const Problem problem = problem_of(boxes);
    Arrangement a = arrange(problem, {});
    a.fix({1, 2});
    Context context;
    trim_overlaps(view_of(9.0f), problem, std::vector<char>(problem.bodies(), 0), a, context);
    EXPECT_LT(intersection_volume(a.boxes[0], a.boxes[1]), 1e-9);
    EXPECT_NEAR(2.0 * a.boxes[0].half_size.x(), third ? 0.4 : 0.2, 1e-9);
  }
}

TEST(Trims, DropWhatLiesInAnotherBox) {
  for (const bool known : {false, true}) {
    Ending ending;
    ending.problem = problem_of({box({0, 0, 0.1}, {0.2, 0.2, 0.2}), box({0.02, 0, 0.12}, {0.1, 0.1, 0.1}), box({0.15, 0, 0.1}, {0.1, 0.2, 0.2})});
    if (known)
      for (Cuboid& cuboid : ending.problem.cuboids) cuboid.label = std::to_string(&cuboid - ending.problem.cuboids.data());
    ending.cuboids = ending.problem.cuboids;
    ending.held = ending.falls = std::vector<char>(4, 0);
    ending.arrangement = arrange(ending.problem, {});
    ending.arrangement.fix({1, 2});
    ending.arrangement.fix({2, 3});
    drop_contained(view_of(2.9f), ending);
    ASSERT_EQ(ending.cuboids.size(), known ? 3u : 2u);
    if (known) continue;
    EXPECT_EQ(ending.arrangement.fixed, (std::vector<std::array<int, 2>>{{1, 2}}));  // its link is that of the outer one
    EXPECT_EQ(ending.arrangement.boxes.size(), 2u);
    EXPECT_EQ(ending.held.size(), 3u);
    EXPECT_EQ(ending.cuboids[0].visible_points, 2000u);
  }
}

/// A post, and a box beside its upper end with 3 cm between them.
Problem hung() { return problem_of({box({0, 0, 0.5}, {0.2, 0.2, 1.0}), box({0.23, 0, 0.8}, {0.2, 0.2, 0.2})}); }

TEST(Links, HoldWhatHangsWhereNobodyCouldSeeThem) {
  const Problem problem = hung();
  Arrangement a = arrange(problem, {});
  std::vector<char> held = {0, 0, 1};
  Context context;
  EXPECT_EQ(hanging(problem, a, held), (std::vector<char>{0, 0, 1}));
  link_hanging(problem, view_of(1.0f), held, a, context);
  ASSERT_EQ(a.fixed.size(), 1u);
  EXPECT_EQ(a.fixed[0], (std::array{1, 2}));
  EXPECT_EQ(held, (std::vector<char>{0, 0, 0}));
  EXPECT_TRUE(stands(problem, a, held));
}

TEST(Links, AreNotInFreeSpace) {
  const Problem problem = hung();
  Arrangement a = arrange(problem, {});
  std::vector<char> held = {0, 0, 1};
  Context context;
  link_hanging(problem, view_of(9.0f), held, a, context);
  EXPECT_TRUE(a.fixed.empty());
  EXPECT_EQ(held[2], 1);
}

TEST(Links, AreNotToWhatWouldFallOver) {
  Problem problem = problem_of({box({0, 0, 0.5}, {0.02, 0.02, 1.0}), box({0.4, 0, 0.8}, {0.7, 0.4, 0.2})});
  Arrangement a = arrange(problem, {});
  std::vector<char> held = {0, 0, 1};
  Context context;
  link_hanging(problem, view_of(1.0f), held, a, context);
  EXPECT_EQ(held[2], 1);
}

TEST(Links, AreRatherToWhatThenBearsThePushesToo) {
  // A box 2 cm beside a slim post, which carries it at rest, and 4 cm beside a stout one.
  const OrientedBox slim = box({0, 0, 0.5}, {0.15, 0.15, 1.0}), hung = box({0.195, 0, 0.8}, {0.2, 0.2, 0.2}), stout = box({0.585, 0, 0.5}, {0.5, 0.5, 1.0});
  const auto linked = [](const std::vector<OrientedBox>& boxes) {
    const Problem problem = problem_of(boxes);
    Arrangement a = arrange(problem, {});
    std::vector<char> held = {0, 0, 1, 0};
    held.resize(1 + boxes.size());
    Context context;
    link_hanging(problem, view_of(1.0f), held, a, context);
    EXPECT_EQ(held[2], 0);
    return a.fixed;
  };
  EXPECT_EQ(linked({slim, hung, stout}), (std::vector<std::array<int, 2>>{{2, 3}}));
  EXPECT_EQ(linked({slim, hung}), (std::vector<std::array<int, 2>>{{1, 2}}));
}

TEST(Fuse, LeavesApartWhatIsOnDifferentLevelsOfAStack) {
  // Three boxes in line whose gaps nobody could look into; the first is of no stack.
  for (const bool apart : {false, true}) {
    std::vector<Cuboid> cuboids = {cuboid(box({-0.43, 0, 0.1}, {0.4, 0.3, 0.2})), cuboid(box({0, 0, 0.1}, {0.4, 0.3, 0.2})), cuboid(box({0.43, 0, 0.1}, {0.4, 0.3, 0.2}))};
    for (int k = 1; k < 3; ++k) cuboids[k].stack = 0, cuboids[k].level = apart ? k : 1;
    std::vector<double> tolerance(3, 0.006);
    EXPECT_EQ(fuse_pieces(view_of(1.0f), cuboids, tolerance), apart ? 1u : 2u);
  }
}

TEST(Fuse, LeavesApartWhatHasAFreeGap) {
  // Two long boxes in line with 3 cm between them: seen through (depth 9 m), or covered (1 m).
  for (const float depth : {9.0f, 1.0f}) {
    std::vector<Cuboid> cuboids = {cuboid(box({-0.215, 0, 0.1}, {0.4, 0.3, 0.2})), cuboid(box({0.215, 0, 0.1}, {0.4, 0.3, 0.2}))};
    std::vector<double> tolerance(2, 0.006);
    EXPECT_EQ(fuse_pieces(view_of(depth), cuboids, tolerance), depth > 5.0f ? 0u : 1u);
  }
}

TEST(Fuse, AllowsForTheTurnOfEitherPiece) {
  // Along axes between theirs, ends of pieces 0.45 m apart are some 14 mm out of line, more than twice the tolerance; where one is turned by 2 degrees, 8 mm of it are of that.
  for (const double turn : {0.0, 2.0}) {
    std::vector<Cuboid> cuboids = {cuboid(box({-0.225, 0, 0.1}, {0.2, 0.3, 0.2})), cuboid(box({0.225, 0.004, 0.1}, {0.2, 0.2, 0.2}))};
    cuboids[1].initial.axes = Eigen::AngleAxisd(radians(turn), Vec3::UnitZ()).toRotationMatrix();
    const double end = 0.15 - (turn > 0.0 ? 0.006 : 0.014);  // of the second, beside 0.15 of the first
    cuboids[1].initial.center.y() = end - 0.1;
    std::vector<double> tolerance(2, 0.006);
    EXPECT_EQ(fuse_pieces(view_of(1.0f), cuboids, tolerance), turn > 0.0 ? 1u : 0u) << turn;
  }
}

TEST(Fuse, PatchesOfASlabAreIt) {
  // Two patches of a table's top, one of which lies within the other though it is turned, or overlaps it and ends it; what stands there reaches into the top.
  const OrientedBox top = box({0, 0, 0.735}, {1.0, 0.8, 0.03});
  OrientedBox within = box({0.2, 0.1, 0.735}, {0.3, 0.2, 0.03});
  within.axes = Eigen::AngleAxisd(radians(25.0), Vec3::UnitZ()).toRotationMatrix();
  const OrientedBox beside = box({0.45, 0.2, 0.735}, {0.5, 0.4, 0.03}), above = box({0.6, -0.35, 0.82}, {0.1, 0.2, 0.2});
  const auto fused = [](const std::vector<OrientedBox>& boxes) {
    std::vector<Cuboid> cuboids;
    for (const OrientedBox& b : boxes) cuboids.push_back(cuboid(b));
    std::vector<double> tolerance(cuboids.size(), 0.006);
    fuse_pieces(view_of(1.0f), cuboids, tolerance);
    return cuboids;
  };
  EXPECT_EQ(fused({top, within}).size(), 1u);
  const std::vector<Cuboid> ended = fused({top, beside, above});
  ASSERT_EQ(ended.size(), 2u);
  EXPECT_NEAR(2.0 * ended[0].initial.half_size.x(), 1.2, 1e-9);
  OrientedBox lower = within, deeper = above;
  lower.center.z() -= 0.012;
  deeper.center.z() -= 0.05;
  EXPECT_EQ(fused({top, lower}).size(), 2u);           // on another level
  EXPECT_EQ(fused({top, beside, deeper}).size(), 3u);  // something stands through it
}

TEST(Fuse, LeavesApartWhatIsNoPatchOfASlab) {
  const auto count = [](std::vector<Cuboid> cuboids, double within) {
    std::vector<double> tolerance(cuboids.size(), within);
    fuse_pieces(view_of(1.0f), cuboids, tolerance);
    return cuboids.size();
  };
  const Cuboid table = cuboid(box({0, 0, 0.735}, {1.2, 0.8, 0.03}));
  EXPECT_EQ(count({table, cuboid(box({1.2, 0.03, 0.735}, {1.2, 0.8, 0.03}))}, 0.006), 2u);   // another table, 3 cm out of line
  EXPECT_EQ(count({table, cuboid(box({1.2, 0, 0.735}, {1.2, 0.86, 0.03}))}, 0.006), 2u);     // a deeper one
  EXPECT_EQ(count({table, cuboid(box({0.1, 0.1, 0.765}, {0.4, 0.3, 0.03}))}, 0.03), 2u);     // a board that lies on it
  const OrientedBox left = box({-0.4, 0, 0.735}, {0.4, 0.3, 0.03}), right = box({0.4, 0, 0.735}, {0.4, 0.3, 0.03});
  Cuboid book = cuboid(box({0, 0, 0.735}, {0.2, 0.3, 0.03}));
  book.stack = 3, book.level = 2;
  Cuboid one = cuboid(left), other = cuboid(right);
  one.stack = other.stack = 3, one.level = other.level = 1;
  EXPECT_EQ(count({one, book, other}, 0.006), 3u);                                           // known to be on another level
  EXPECT_EQ(count({cuboid(left), cuboid(box({0, 0, 0.79}, {0.1, 0.2, 0.22})), cuboid(right)}, 0.006), 3u);  // something that reaches out below
}

}  // namespace
}  // namespace unseen::cuboids
