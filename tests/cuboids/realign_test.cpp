// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Boxes that were given turned and sized a little wrong.
#include <gtest/gtest.h>

#include "cuboids/search/complete.h"
#include "cuboids/search/hypotheses.h"
#include "perception_scenes.h"
#include "unseen/cuboids/cuboids.h"

namespace unseen::cuboids::test {
namespace {

Scene two_boxes() {
  Scene scene;  // the lower half of the one behind is hidden
  scene.boxes = {upright(0.02, 0.62, 0, {0.3, 0.08, 0.1}, 10), upright(-0.03, 0.85, 0, {0.16, 0.12, 0.26}, -20)};
  return scene;
}

Completion given(const Scene& scene, double angle, double size, std::uint64_t seed) {
  Completion c;
  c.T_world_camera = camera_of(scene);
  c.supports.push_back({0, SupportKind::ground, {Vec3::UnitZ(), 0.0}, {}});
  Random random(seed);
  for (const OrientedBox& truth : scene.boxes) {
    Cuboid cuboid;
    cuboid.initial = truth;
    cuboid.initial.axes = Eigen::AngleAxisd(random.uniform(-angle, angle), random.direction()).toRotationMatrix() * truth.axes;
    for (int k = 0; k < 3; ++k) cuboid.initial.half_size[k] *= random.uniform(1.0 - size, 1.0 + size);
    c.cuboids.push_back(cuboid);
  }
  return c;
}

TEST(Realign, BringsBackWhatWasTurnedAndSizedWrong) {
  const Scene scene = two_boxes();
  const RgbdFrame frame = render(scene);
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Completion c = given(scene, radians(15.0), 0.05, seed);
    Context context;
    realign(frame, {}, c, context);
    for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
      const OrientedBox &box = c.cuboids[i].initial, &truth = scene.boxes[i];
      for (int k = 0; k < 3; ++k) EXPECT_LT(degrees(line_angle(box.axes.col(k), truth.axes.col(k))), 2.0) << seed << " " << i;
      EXPECT_LT((box.half_size - truth.half_size).cwiseAbs().maxCoeff(), 0.006) << seed << " " << i;
      EXPECT_LT((box.center - truth.center).norm(), 0.008) << seed << " " << i;
    }
  }
}

TEST(Realign, WhatIsLowerThanADeskIsNotItsOwn) {
  const Scene scene = two_boxes();
  Completion c = given(scene, radians(15.0), 0.05, 1);
  c.supports.push_back({1, SupportKind::desk, {Vec3::UnitZ(), 0.5}, {{2, 2, 0.5}, {3, 2, 0.5}, {3, 3, 0.5}, {2, 3, 0.5}}});
  Completion without = given(scene, radians(15.0), 0.05, 1);
  Context context;
  realign(render(scene), {}, c, context);
  realign(render(scene), {}, without, context);
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) EXPECT_EQ(c.cuboids[i].initial.center, without.cuboids[i].initial.center) << i;
}

TEST(Realign, KeepsWhatExplainsItsPoints) {
  Scene scene;  // flush: the points of each fit the other's front too
  scene.boxes = {upright(-0.1, 0.7, 0, {0.2, 0.15, 0.2}, 0), upright(0.1, 0.7, 0, {0.2, 0.15, 0.2}, 0), upright(0.0, 0.7, 0.2, {0.25, 0.15, 0.1}, 0)};
  Completion c = given(scene, 0.0, 0.0, 1);
  Context context;
  realign(render(scene), {}, c, context);
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    EXPECT_EQ(c.cuboids[i].initial.center, scene.boxes[i].center) << i;
    EXPECT_EQ(c.cuboids[i].initial.half_size, scene.boxes[i].half_size) << i;
  }
}

TEST(CutOff, IsWhatReachesThePicturesBorder) {
  Scene scene;
  scene.boxes = {upright(0.05, 0.8, 0, {0.15, 0.15, 0.1}, 15), upright(-0.62, 0.95, 0.2, {0.3, 0.1, 0.06}, 0)};
  const DepthView view(render(scene), camera_of(scene), scene.noise);
  Cuboid inside, border;
  inside.initial = scene.boxes[0];
  border.initial = scene.boxes[1];
  EXPECT_EQ(cut_off(view, {inside, border}), (std::vector<char>{0, 1}));
}

TEST(CutOff, WhatNothingInThePictureHoldsIsSaidToBeHeldOutsideIt) {
  Scene scene;  // the second one floats over ground that is seen
  scene.boxes = {upright(0.05, 0.8, 0, {0.15, 0.15, 0.1}, 15), upright(-0.62, 0.95, 0.2, {0.3, 0.1, 0.06}, 0)};
  const auto completed = [&] {
    Context context;
    return complete_cuboids(render(scene), Options{}, context);
  };
  const Completion cut = completed();
  ASSERT_EQ(cut.cuboids.size(), 2u);
  EXPECT_TRUE(cut.unsupported.empty());
  ASSERT_EQ(cut.held_outside.size(), 1u);
  scene.boxes[1].center.x() = -0.3;
  const Completion whole = completed();
  EXPECT_EQ(whole.unsupported.size(), 1u);
  EXPECT_TRUE(whole.held_outside.empty());
}

TEST(IsCovered, ThroughPixelsWithoutDepthAlongTheEdge) {
  Scene scene;
  scene.boxes = {upright(0.0, 0.7, 0, {0.3, 0.08, 0.3}, 0), upright(0.0, 0.85, 0, {0.25, 0.1, 0.2}, 0)};
  RgbdFrame frame = render(scene);
  const auto covered = [&] { return is_covered(DepthView(frame, camera_of(scene), scene.noise), scene.boxes[1], 3, 0.05, 0.005); };
  ASSERT_TRUE(covered());
  Random random(2);
  for (float& depth : frame.depth)
    if (random.uniform(0.0, 1.0) < 0.6) depth = 0.0F;
  EXPECT_TRUE(covered());
  for (float& depth : frame.depth) depth = 0.0F;
  EXPECT_FALSE(covered());
}

TEST(IsCovered, NotWhereAPartOfTheEdgeWouldShow) {
  // What stands in front hides the edge from its left end to a place near its middle, or beyond its right end.
  for (const double right : {0.01, 0.035, 0.08}) {
    Scene scene;
    scene.boxes = {upright(0.5 * (right - 0.2), 0.7, 0, {0.2 + right, 0.08, 0.3}, 0), upright(0.0, 0.85, 0, {0.25, 0.1, 0.2}, 0)};
    EXPECT_EQ(is_covered(DepthView(render(scene), camera_of(scene), scene.noise), scene.boxes[1], 3, 0.05, 0.005), right > 0.07) << right;
  }
}

TEST(Realign, KeepsWhatNobodySaw) {
  const Scene scene = two_boxes();
  Completion c = given(scene, 0.0, 0.0, 1);
  c.cuboids[1].initial.half_size.y() += 0.04;  // behind
  c.cuboids[1].initial.center += 0.04 * c.cuboids[1].initial.axes.col(1);
  const OrientedBox deep = c.cuboids[1].initial;
  Context context;
  realign(render(scene), {}, c, context);
  EXPECT_LT((c.cuboids[1].initial.half_size - deep.half_size).cwiseAbs().maxCoeff(), 0.004);
  EXPECT_LT((c.cuboids[1].initial.center - deep.center).norm(), 0.005);
}

TEST(Complete, WarnsOfWhatStaysUprightByChance) {
  for (const double width : {0.008, 0.03, 0.08}) {  // bears 0.02 g, and is rather fixed; 0.075 g, which the tolerance of its contacts makes enough; 0.2 g
    Scene scene;
    scene.boxes = {upright(0.0, 0.7, 0, {width, width, 0.4}, 20), upright(0.3, 0.8, 0, {0.2, 0.2, 0.2}, 20)};
    Context context;
    const Completion c = complete_cuboids(render(scene), given(scene, 0.0, 0.0, 1), {}, context);
    const auto warned = std::count_if(c.summary.warnings.begin(), c.summary.warnings.end(),
                                      [](const std::string& w) { return w.find("may not stay") != std::string::npos && w.ends_with("box 1"); });
    const auto fixed = std::count_if(c.contacts.begin(), c.contacts.end(), [](const Contact& contact) { return contact.kind == ContactKind::fixed; });
    EXPECT_EQ(fixed, width < 0.01) << width;
    EXPECT_EQ(warned, width > 0.01 && width < 0.05) << width;
    EXPECT_EQ(c.may_move, warned == 0 ? std::vector<int>{} : std::vector<int>{1}) << width;
  }
}

TEST(Realign, LeavesABoxWithoutPoints) {
  const Scene scene = two_boxes();
  Completion c = given(scene, 0.0, 0.0, 1);
  Cuboid elsewhere;
  elsewhere.initial = upright(1.5, 3.0, 0, {0.2, 0.2, 0.2}, 30);
  c.cuboids.push_back(elsewhere);
  Context context;
  realign(render(scene), {}, c, context);
  EXPECT_EQ(c.cuboids[2].initial.axes, elsewhere.initial.axes);
  EXPECT_EQ(c.cuboids[2].initial.center, elsewhere.initial.center);
}

}  // namespace
}  // namespace unseen::cuboids::test
