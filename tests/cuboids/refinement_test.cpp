// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// What is done to boxes before and after the search, on boxes whose right answer is known.
#include <gtest/gtest.h>

#include "box_problems.h"
#include "cuboids/search/complete.h"

namespace unseen::cuboids {
namespace {

const Admissible kAnything = [](const Arrangement&) { return true; };

TEST(CloseContacts, LeavesNoGapAndNoOverlap) {
  const Problem problem = problem_of({box({0, 0, 0.102}, {0.3, 0.3, 0.2}), box({0.02, 0, 0.25}, {0.2, 0.2, 0.1}, 0.4)});
  Arrangement a = arrange(problem, {});
  close_contacts(problem, touching_pairs(problem, a), a);
  const auto touches = touching_pairs(problem, a);
  ASSERT_EQ(touches.size(), 2u);
  for (const Touch& touch : touches) EXPECT_NEAR(touch.interface.gap, 0.0, 1e-5);
  EXPECT_NEAR(a.boxes[1].half_size.x(), 0.1, 1e-9);  // what no contact asks for stays
}

TEST(CloseContacts, LeavesWhatOverlapsFar) {
  // One that was fitted askew through the other: no face moves by centimetres for it.
  const Problem problem = problem_of({box({0, 0, 0.1}, {0.3, 0.3, 0.2}), box({0.02, 0, 0.17}, {0.2, 0.2, 0.1})});
  Arrangement a = arrange(problem, {});
  close_contacts(problem, touching_pairs(problem, a), a);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT((a.boxes[i].half_size - problem.cuboids[i].initial.half_size).cwiseAbs().maxCoeff(), 1e-4) << i;
}

TEST(CloseContacts, MovesNoFaceFarWhereContactsContradictEachOther) {
  // Two planks that both lie on the same two piers, each a little turned: four contacts of four faces, one of which follows from the others but for rounding.
  const std::vector<OrientedBox> boxes{box({-0.5, 0, 0.1}, {0.2, 0.6, 0.2}), box({0.5, 0, 0.1}, {0.2, 0.6, 0.2}),
                                       box({0, -0.15, 0.226}, {1.4, 0.2, 0.05}), box({0, 0.15, 0.226}, {1.4, 0.2, 0.05})};
  for (const double turn : {0.2, 0.5, 1.0, 1.5}) {
    std::vector<OrientedBox> turned = boxes;
    turned[2].axes = Eigen::AngleAxisd(radians(0.3 * turn), Vec3::UnitY()).toRotationMatrix() * turned[2].axes;
    turned[3].axes = Eigen::AngleAxisd(radians(-0.3 * turn), Vec3::UnitY()).toRotationMatrix() * turned[3].axes;
    turned[0].axes = Eigen::AngleAxisd(radians(turn), Vec3::UnitX()).toRotationMatrix() * turned[0].axes;
    const Problem problem = problem_of(turned);
    Arrangement a = arrange(problem, {});
    close_contacts(problem, touching_pairs(problem, a), a);
    for (std::size_t i = 0; i < turned.size(); ++i)
      EXPECT_LT((a.boxes[i].half_size - problem.cuboids[i].initial.half_size).cwiseAbs().maxCoeff(), 0.02) << i << " " << turn;
  }
}

TEST(Hanging, IsNotSaidOfWhatThePictureCutsOff) {
  Problem problem = problem_of({box({0, 0, 0.5}, {0.1, 0.1, 0.1}), box({0.1, 0, 0.5}, {0.1, 0.1, 0.1}), box({1, 0, 0.5}, {0.1, 0.1, 0.1})});
  problem.cut_off = {1, 0, 0};
  Arrangement a = arrange(problem, {});
  a.fix({1, 2});
  const std::vector<char> held = {0, 1, 0, 1};
  EXPECT_EQ(held_up(problem, a, held), (std::vector<char>{0, 1, 1, 1}));
  EXPECT_EQ(hanging(problem, a, held), (std::vector<char>{0, 0, 0, 1}));
  problem.cut_off.clear();
  EXPECT_EQ(hanging(problem, a, held), (std::vector<char>{0, 1, 1, 1}));
}

TEST(AssumeThickness, LeavesASideThatWasSeen) {
  Problem problem = problem_of({box({0, 1, 0.1}, {0.3, 0.04, 0.2})});
  RgbdFrame frame;
  frame.camera = {500, 500, 319.5, 239.5, 640, 480};
  frame.depth.assign(640 * 480, 0.5F);  // a surface before it: nothing of its back is seen free
  RigidTransform T_world_camera;
  T_world_camera.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  const DepthView view(frame, T_world_camera, 0.0015);
  Rooms rooms(1, Extension{});
  rooms[0][3] = 1.5 * problem.tolerance[0];  // what the fit leaves open
  assume_thickness(view, rooms, problem);
  EXPECT_NEAR(problem.cuboids[0].initial.half_size.y(), 0.02, 1e-12);
  rooms[0][3] = 0.1;
  assume_thickness(view, rooms, problem);
  EXPECT_GT(problem.cuboids[0].initial.half_size.y(), 0.06);
}

TEST(LowerResidual, MovesAnEdgeUnderTheCentreOfMass) {
  // The upper box hangs over by half a millimetre too much; noise leaves room for that.
  Problem problem = problem_of({box({0, 0, 0.1}, {0.1, 0.1, 0.2}), box({0.0505, 0, 0.25}, {0.1, 0.1, 0.1})});
  problem.push = 0.0;
  const std::vector<char> held(3, 0);
  const auto residual = [&](const Arrangement& a) {
    const Structure s = structure_of(problem, a, touching_pairs(problem, a), held);
    return balance(s.bodies, s.contacts).residual;
  };
  Arrangement a = arrange(problem, {});
  const double before = residual(a);
  ASSERT_GT(before, 1e-3);
  Context context;
  lower_residual(problem, Rooms(2, Extension{}), kAnything, held, a, context);
  EXPECT_LT(residual(a), 0.2 * before);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT((a.boxes[i].half_size - problem.cuboids[i].initial.half_size).cwiseAbs().maxCoeff(), 0.007);
}

TEST(LowerResidual, GrowsAHiddenFaceUntilThePushIsBorne) {
  // At rest the upper box stands; a push of 0.1 g at 0.05 m tips it over the lower one's edge, 2 mm from under its centre.
  const Problem problem = problem_of({box({0, 0, 0.1}, {0.1, 0.1, 0.2}), box({0.048, 0, 0.25}, {0.1, 0.1, 0.1})});
  const std::vector<char> held(3, 0);
  Rooms rooms(2, Extension{});
  rooms[0][1] = 0.2;
  Arrangement a = arrange(problem, {});
  Context context;
  lower_residual(problem, rooms, kAnything, held, a, context);
  const double edge = a.boxes[0].center.x() + a.boxes[0].half_size.x();
  EXPECT_GT(edge, a.boxes[1].center.x() + 0.1 * 0.05 - 1e-3);
  EXPECT_LT(edge, 0.1);  // not all the room
  const Structure s = structure_of(problem, a, touching_pairs(problem, a), held);
  EXPECT_GT(margin(s.bodies, s.contacts, 1e-6), 0.09);
}

TEST(LowerResidual, StaysWithinWhatIsAdmissible) {
  const Problem problem = problem_of({box({0, 0, 0.1}, {0.1, 0.1, 0.2}), box({0.048, 0, 0.25}, {0.1, 0.1, 0.1})});
  Rooms rooms(2, Extension{});
  rooms[0][1] = 0.2;
  Arrangement a = arrange(problem, {});
  Context context;
  const Admissible no_longer = [](const Arrangement& now) { return now.boxes[0].half_size.x() <= 0.05; };
  lower_residual(problem, rooms, no_longer, std::vector<char>(3, 0), a, context);
  EXPECT_LE(a.boxes[0].half_size.x(), 0.05);
}

TEST(Objects, ArePiecesThatAreRigidTogether) {
  // A post and, 2 cm beside it, a piece in the air that belongs to it.
  Problem problem = problem_of({box({0, 0, 0.2}, {0.2, 0.2, 0.4}), box({0.17, 0, 0.35}, {0.1, 0.1, 0.1}), box({1, 0, 0.35}, {0.1, 0.1, 0.1})});
  problem.cuboids[0].object = problem.cuboids[1].object = 4;
  problem.joints = joints_of(problem);
  EXPECT_EQ(problem.joints, (std::vector<std::array<int, 2>>{{1, 2}}));
  const auto residual = [&](std::vector<char> held) {
    const Arrangement a = arrange(problem, {});
    const Structure s = structure_of(problem, a, touching_pairs(problem, a), held);
    return balance(s.bodies, s.contacts).residual;
  };
  EXPECT_LT(residual({0, 0, 0, 1}), 1e-6);
  problem.joints.clear();
  EXPECT_GT(residual({0, 0, 0, 1}), 0.9);
}

TEST(TouchingPairs, DoNotReachThroughAThirdBody) {
  Problem problem = problem_of({box({0, 0, 0.05}, {0.2, 0.2, 0.1}), box({0, 0, 0.105}, {0.4, 0.4, 0.01}), box({0, 0, 0.16}, {0.1, 0.1, 0.1})});
  problem.tolerance.assign(3, 0.02);
  std::vector<std::array<int, 2>> pairs;
  for (const Touch& touch : touching_pairs(problem, arrange(problem, {}))) pairs.push_back({touch.a, touch.b});
  EXPECT_EQ(pairs, (std::vector<std::array<int, 2>>{{0, 1}, {1, 2}, {2, 3}}));
}

TEST(CloseHiddenGaps, MovesHiddenFacesOnlyAndToTheNearestBody) {
  // A gap of 12 mm over the ground, with a tolerance of 6.
  const std::vector<OrientedBox> boxes = {box({0, 0, 0.062}, {0.1, 0.1, 0.1}), box({0.5, 0, 0.004}, {0.3, 0.3, 0.008}),
                                          box({0.5, 0, 0.06}, {0.1, 0.1, 0.1})};
  Rooms rooms(3, Extension{0.009, 0.009, 0.009, 0.009, 0.009, 0.009});
  Problem seen = problem_of(boxes);
  close_hidden_gaps(rooms, seen);
  EXPECT_NEAR(seen.cuboids[0].initial.half_size.z(), 0.05, 1e-12);
  rooms[0][4] = rooms[2][4] = 0.5;
  Problem hidden = problem_of(boxes);
  close_hidden_gaps(rooms, hidden);
  EXPECT_NEAR(rooms[0][4], 0.488, 1e-12);
  EXPECT_NEAR(hidden.cuboids[0].initial.half_size.z(), 0.056, 1e-12);
  EXPECT_NEAR(hidden.cuboids[0].initial.center.z(), 0.056, 1e-12);
  // The third stands on the second already: it does not go on to the ground.
  EXPECT_NEAR(hidden.cuboids[2].initial.half_size.z(), 0.05, 1e-12);
}

}  // namespace
}  // namespace unseen::cuboids
