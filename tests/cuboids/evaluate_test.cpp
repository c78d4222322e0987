// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/cuboids/evaluate.h"

#include <gtest/gtest.h>

#include "cuboids/boxes/box_overlap.h"
#include "cuboids/evaluate/evaluate_parts.h"
#include "cuboids/evaluate/referee.h"
#include "unseen/core/error.h"
#include "unseen/core/random.h"

namespace unseen::cuboids {
namespace {

OrientedBox standing(const Vec3& center, const Vec3& size) {
  return {center, Mat3::Identity(), size / 2};
}

OrientedBox any_box(Random& random) {
  const Mat3 axes = Eigen::AngleAxisd(random.uniform(0, kPi), random.direction()).toRotationMatrix();
  return {Vec3(random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4)), axes,
          Vec3(random.uniform(0.1, 0.6), random.uniform(0.1, 0.6), random.uniform(0.1, 0.6))};
}

TEST(BoxOverlap, VolumeOfTheIntersectionAgreesWithSampling) {
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    const OrientedBox a = any_box(random), b = any_box(random);
    constexpr int kSamples = 40000;
    int inside = 0;
    for (int i = 0; i < kSamples; ++i) {
      const Vec3 p(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      inside += b.contains(a.center + a.axes * p.cwiseProduct(a.half_size));
    }
    const double share = static_cast<double>(inside) / kSamples;
    const double sigma = a.volume() * std::sqrt(std::max(share * (1 - share), 1e-4) / kSamples);
    EXPECT_NEAR(intersection_volume(a, b), share * a.volume(), 4.5 * sigma);
    EXPECT_NEAR(intersection_volume(a, b), intersection_volume(b, a), 1e-12);
  }
}

TEST(BoxOverlap, KnownVolumes) {
  const OrientedBox cube = standing({0, 0, 0}, {1, 1, 1});
  EXPECT_NEAR(intersection_volume(cube, cube), 1.0, 1e-12);  // all faces are shared
  EXPECT_NEAR(intersection_volume(cube, standing({0.75, 0, 0}, {1, 1, 1})), 0.25, 1e-12);
  EXPECT_NEAR(intersection_volume(cube, standing({0, 0, 0.2}, {0.2, 0.2, 0.2})), 0.008, 1e-12);
  EXPECT_EQ(intersection_volume(cube, standing({1, 0, 0}, {1, 1, 1})), 0.0);
  OrientedBox turned = cube;
  turned.axes = Eigen::AngleAxisd(kPi / 4, Vec3::UnitZ()).toRotationMatrix();
  EXPECT_NEAR(intersection_volume(cube, turned), 2 * std::sqrt(2.0) - 2, 1e-12);  // a regular octagon
  EXPECT_NEAR(intersection_over_union(cube, standing({0.5, 0, 0}, {1, 1, 1})), 1.0 / 3.0, 1e-12);
}

/// A block on the ground, its lower half hidden; a lid on it; a box beside.
struct Scene {
  Completion result;
  Truth truth;

  Scene() {
    result.T_world_camera.translation = {0, 0, 1};
    result.supports.push_back({0, SupportKind::ground, {}, {}});
    add(1, {0, 0, 0.1}, {0.4, 0.3, 0.2});
    add(2, {0, 0, 0.25}, {0.2, 0.2, 0.1});
    add(3, {1, 0, 0.2}, {0.2, 0.2, 0.4});
    result.cuboids[0].initial = standing({0, 0, 0.15}, {0.4, 0.3, 0.1});
    // The truth has another world, turned and moved; the camera connects the two.
    const RigidTransform T = {Eigen::AngleAxisd(0.3, Vec3::UnitZ()).toRotationMatrix(), {0.5, -0.2, 0}};
    truth.T_world_camera = T * result.T_world_camera;
    truth.supports.push_back({10, SupportKind::ground, {}, {}});
    for (const Cuboid& cuboid : result.cuboids) {
      TrueCuboid real;
      real.id = cuboid.id + 10;
      real.box = OrientedBox{T * cuboid.box.center, T.rotation * cuboid.box.axes, cuboid.box.half_size};
      real.size = 2 * cuboid.box.half_size;
      truth.cuboids.push_back(real);
    }
    truth.cuboids[0].seen.z() = 0.5;
    for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {0, 3}}) {
      contact(result.contacts, a, b);
      contact(truth.contacts, a + 10, b + 10);
    }
  }

  static void contact(std::vector<Contact>& contacts, int a, int b, ContactKind kind = ContactKind::touching) {
    contacts.emplace_back();
    contacts.back().a = a;
    contacts.back().b = b;
    contacts.back().kind = kind;
  }

  void add(int id, const Vec3& center, const Vec3& size) {
    Cuboid cuboid;
    cuboid.id = id;
    cuboid.box = cuboid.initial = standing(center, size);
    result.cuboids.push_back(cuboid);
  }

  Evaluation score() const {
    Context context;
    EvaluateOptions options;
    options.referee = false;
    return evaluate(result, truth, options, context);
  }
};

TEST(EvaluateCuboids, ARightResultIsRight) {
  const Evaluation e = Scene().score();
  EXPECT_EQ(e.found, 3u);
  EXPECT_EQ(e.contacts_after.correct, 3u);
  EXPECT_DOUBLE_EQ(e.contacts_after.f1, 1.0);
  EXPECT_NEAR(e.sizes.completed, 1.0, 1e-12);
  EXPECT_NEAR(e.pose->iou_after, 1.0, 1e-9);
  EXPECT_NEAR(e.pose->angle, 0.0, 1e-6);
  EXPECT_NEAR(e.hidden_part->iou, 1.0, 1e-9);
}

TEST(EvaluateCuboids, WhatWasFittedMissesTheGroundAndHalfAHeight) {
  const Evaluation e = Scene().score();
  // Before: block–lid and ground–box are there, ground–block is not.
  EXPECT_EQ(e.contacts_before.edges, 2u);
  EXPECT_DOUBLE_EQ(e.contacts_before.precision, 1.0);
  EXPECT_NEAR(e.contacts_before.recall, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(e.contacts_before.f1, 0.8, 1e-12);
  EXPECT_EQ(e.sizes.dimensions, 9u);
  EXPECT_EQ(e.hidden_sizes.dimensions, 1u);
  EXPECT_NEAR(e.hidden_sizes.fitted, 0.5, 1e-12);
  EXPECT_NEAR(e.hidden_sizes.dropped, 1.0, 1e-12);
  EXPECT_NEAR(e.sizes.fitted, (8 + 0.5) / 9, 1e-12);
  // One size changed, from an error of one half to none.
  EXPECT_EQ(e.change.dimensions, 1u);
  EXPECT_NEAR(e.change.before, 0.5, 1e-12);
  EXPECT_NEAR(e.change.after, 0.0, 1e-12);
  EXPECT_NEAR(e.change.change, 0.5, 1e-12);
  EXPECT_NEAR(e.pose->iou_before, (0.5 + 1 + 1) / 3, 1e-9);
}

TEST(EvaluateCuboids, AWrongKindAnInventedAndAMissingEdge) {
  Scene scene;
  scene.result.contacts[1].kind = ContactKind::fixed;
  scene.result.contacts.pop_back();
  Scene::contact(scene.result.contacts, 2, 3);
  Scene::contact(scene.result.contacts, 3, 2);  // named twice counts once
  const GraphScore score = scene.score().contacts_after;
  EXPECT_EQ(score.edges, 3u);
  EXPECT_EQ(score.correct, 1u);
  EXPECT_NEAR(score.precision, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(score.recall, 1.0 / 3.0, 1e-12);
}

TEST(EvaluateCuboids, TooLongCountsLikeTooShort) {
  Scene scene;
  scene.result.cuboids[2].box = standing({1, 0, 0.25}, {0.2, 0.2, 0.5});
  EXPECT_NEAR(scene.score().sizes.completed, (8 + 0.75) / 9, 1e-12);
  scene.result.cuboids[2].box = standing({1, 0, 0.15}, {0.2, 0.2, 0.3});
  EXPECT_NEAR(scene.score().sizes.completed, (8 + 0.75) / 9, 1e-12);
}

TEST(EvaluateCuboids, AMissingAndAnInventedBox) {
  Scene scene;
  scene.result.cuboids[2].box = scene.result.cuboids[2].initial = standing({3, 0, 0.2}, {0.2, 0.2, 0.4});
  const Evaluation e = scene.score();
  EXPECT_EQ(e.found, 2u);
  EXPECT_NEAR(e.sizes.completed, 6.0 / 9.0, 1e-12);
  EXPECT_NEAR(e.contacts_after.precision, 2.0 / 3.0, 1e-12);  // ground–invented
  EXPECT_NEAR(e.contacts_after.recall, 2.0 / 3.0, 1e-12);
}

TEST(EvaluateCuboids, TwoFixedPiecesStandForOneBox) {
  Scene scene;
  Cuboid& left = scene.result.cuboids[0];
  left.box = left.initial = standing({-0.15, 0, 0.1}, {0.1, 0.3, 0.2});
  scene.add(4, {0.15, 0, 0.1}, {0.1, 0.3, 0.2});
  scene.result.cuboids[0].box = standing({-0.10, 0, 0.1}, {0.2, 0.3, 0.2});
  scene.result.cuboids[3].box = standing({0.10, 0, 0.1}, {0.2, 0.3, 0.2});
  Scene::contact(scene.result.contacts, 1, 4, ContactKind::fixed);
  const Evaluation e = scene.score();
  EXPECT_EQ(e.found, 3u);
  EXPECT_DOUBLE_EQ(e.contacts_after.f1, 1.0);  // the joint between the pieces is no edge
  EXPECT_NEAR(e.sizes.completed, 1.0, 1e-12);
  EXPECT_NEAR(e.sizes.fused, 1.0, 1e-12);
  EXPECT_NEAR(e.sizes.fitted, (8 + 0.25) / 9, 1e-12);
  EXPECT_NEAR(e.hidden_part->iou, 1.0, 1e-9);
}

TEST(EvaluateCuboids, HiddenPartHalfFilled) {
  Scene scene;
  scene.result.cuboids[0].box = standing({0, 0, 0.125}, {0.4, 0.3, 0.15});
  // Below the shell of 1 cm: of 8 cm true hidden height, 4 are claimed, of which the last centimetre is shell.
  const HiddenPartScore score = *scene.score().hidden_part;
  EXPECT_NEAR(score.hidden, 0.38 * 0.28 * 0.08, 0.03 * 0.38 * 0.28 * 0.08 + 2e-4);
  EXPECT_NEAR(score.iou, 0.5, 0.08);
}

TEST(EvaluateCuboids, WithoutPosesVisiblePointsTellWhichIsWhich) {
  Scene scene;
  const RigidTransform T_camera_world = scene.result.T_world_camera.inverse();
  for (std::size_t i = 0; i < 3; ++i) {
    TrueCuboid& real = scene.truth.cuboids[i];
    const OrientedBox& box = scene.result.cuboids[i].initial;
    real.box.reset();
    std::sort(real.size.data(), real.size.data() + 3, std::greater<>());
    Random random(i);
    for (int n = 0; n < 200; ++n) {
      const Vec3 at(random.uniform(-1, 1), random.uniform(-1, 1), 1);  // on top
      real.points.push_back(T_camera_world * (box.center + at.cwiseProduct(box.half_size)));
    }
  }
  const Evaluation e = scene.score();
  EXPECT_EQ(e.found, 3u);
  EXPECT_DOUBLE_EQ(e.contacts_after.f1, 1.0);
  EXPECT_NEAR(e.sizes.completed, 1.0, 1e-12);
  EXPECT_FALSE(e.pose.has_value());
}

TEST(EvaluateCuboids, TheRefereeSeesAFloatingBox) {
  if (!has_referee()) GTEST_SKIP() << "built without MuJoCo";
  Scene scene;
  Context context;
  EXPECT_DOUBLE_EQ(evaluate(scene.result, scene.truth, {}, context).referee->share, 1.0);
  scene.result.cuboids[1].box.center.z() += 0.1;
  const RefereeScore score = *evaluate(scene.result, scene.truth, {}, context).referee;
  EXPECT_EQ(score.bodies, 3u);
  EXPECT_EQ(score.still, 2u);
  EXPECT_EQ(score.moved, std::vector<int>{scene.result.cuboids[1].id});
  const Evaluation alone = evaluate(scene.result, {}, context);  // without a truth
  EXPECT_EQ(alone.cuboids, 3u);
  EXPECT_EQ(alone.true_cuboids, 0u);
  EXPECT_EQ(alone.referee->still, 2u);
  scene.result.unsupported = {2};  // the result says so itself
  EXPECT_EQ(evaluate(scene.result, scene.truth, {}, context).referee->bodies, 2u);
}

TEST(EvaluateCuboids, OrientationsOfABoxAreEquivalent) {
  Scene scene;
  OrientedBox& box = scene.result.cuboids[0].box;
  Mat3 axes;
  axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  box.axes = box.axes * axes;
  box.half_size = axes.transpose() * box.half_size;
  const Evaluation e = scene.score();
  EXPECT_NEAR(e.pose->angle, 0.0, 1e-6);
  EXPECT_NEAR(e.sizes.completed, 1.0, 1e-12);
  box.axes = Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()).toRotationMatrix() * box.axes;
  EXPECT_NEAR(scene.score().pose->angle, 0.3 / 3, 1e-6);
}

TEST(EvaluateCuboids, BadTruthIsRefused) {
  Scene scene;
  scene.truth.cuboids[1].box.reset();
  EXPECT_THROW(scene.score(), InputError);
  scene.truth.cuboids.clear();
  EXPECT_THROW(scene.score(), InputError);
}

}  // namespace
}  // namespace unseen::cuboids
