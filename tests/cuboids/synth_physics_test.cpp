// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cuboids/evaluate/referee.h"
#include "unseen/cuboids/synth.h"

namespace unseen::cuboids {
namespace {

const Vec3 kDown(0, 0, -1);

SynthOptions scene_of(const std::string& family) {
  SynthOptions options;
  options.scene = family;
  options.view = 0;
  if (family == "running-bond") options.boxes = 9;
  return options;
}

RefereeScene referee_scene(const Truth& truth) {
  RefereeScene scene;
  scene.supports = truth.supports;
  for (const TrueCuboid& cuboid : truth.cuboids) {
    scene.boxes.push_back(*cuboid.box);
    scene.masses.push_back(cuboid.density * cuboid.box->volume());
  }
  const int first = static_cast<int>(truth.supports.size());
  for (const Contact& contact : truth.contacts)
    if (contact.kind == ContactKind::fixed)
      scene.fixed.emplace_back(contact.a < first ? -1 : contact.a - first, contact.b - first);
  return scene;
}

Truth truth_of(const SynthOptions& options) {
  Context context;
  return make_scene(options, context).views.front().truth;
}

double farthest(const RefereeScene& scene, const Vec3& down, double seconds) {
  Context context;
  const auto moved = simulate(scene, down, seconds, context);
  return *std::max_element(moved.begin(), moved.end());
}

class SynthPhysics : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (!has_referee()) GTEST_SKIP() << "built without MuJoCo";
  }
};

TEST_P(SynthPhysics, StandsOrFallsAsItsTruthSays) {
  const Truth truth = truth_of(scene_of(GetParam()));
  const double moved = farthest(referee_scene(truth), kDown, 2.0);
  if (truth.stands)
    EXPECT_LT(moved, 0.02);
  else
    EXPECT_GT(moved, 0.2);
}

TEST_P(SynthPhysics, StandsWithAMarginOfTenPercentOrFallsUnderAPushToo) {
  const Truth truth = truth_of(scene_of(GetParam()));
  const RefereeScene scene = referee_scene(truth);
  for (int i = 0; i < 2; ++i) {
    const double angle = radians(20.0 + 135.0 * i);
    const double moved = farthest(scene, kDown + 0.1 * Vec3(std::cos(angle), std::sin(angle), 0), 0.7);
    if (truth.stands)
      EXPECT_LT(moved, 0.05) << degrees(angle);
    else
      EXPECT_GT(moved, 0.05) << degrees(angle);
  }
}

TEST_P(SynthPhysics, NoFixedContactIsTooMany) {
  const RefereeScene scene = referee_scene(truth_of(scene_of(GetParam())));
  // In large scenes the joints of one table and one chair will do.
  const std::size_t count = scene.boxes.size() > 12 ? std::min<std::size_t>(scene.fixed.size(), 3) : scene.fixed.size();
  for (std::size_t i = 0; i < count; ++i) {
    RefereeScene without = scene;
    without.fixed.erase(without.fixed.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_GT(farthest(without, kDown, 0.7), 0.1) << scene.fixed[i].first << " " << scene.fixed[i].second;
  }
}

INSTANTIATE_TEST_SUITE_P(Families, SynthPhysics, testing::ValuesIn(synth_families()), [](const auto& family) {
  std::string name = family.param;
  std::erase(name, '-');
  return name;
});

/// A plate on the ground and a box on it, both turned.
RefereeScene plate_and_box(double yaw) {
  const auto turned = [](const Vec3& center, const Vec3& size, double angle) {
    return OrientedBox{center, Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix(), 0.5 * size};
  };
  RefereeScene scene;
  scene.supports = {{0, SupportKind::ground, {Vec3::UnitZ(), 0.0}, {}}};
  scene.boxes = {turned({0, 0, 0.0273}, {0.2639, 0.1794, 0.0546}, 0.3), turned({0.01, 0.02, 0.11875}, {0.1467, 0.1059, 0.1283}, yaw)};
  scene.masses = {1.0, 1.0};
  return scene;
}

TEST(Referee, FacesThatCoincideStayTogether) {
  if (!has_referee()) GTEST_SKIP() << "built without MuJoCo";
  for (const double yaw : {0.0, 0.092, 0.3, 0.502, 0.508, 0.521, 1.0}) EXPECT_LT(farthest(plate_and_box(yaw), kDown, 0.3), 0.01) << yaw;
}

TEST(Referee, AWallEndsAtItsOutlineAndTheGroundDoesNot) {
  if (!has_referee()) GTEST_SKIP() << "built without MuJoCo";
  RefereeScene scene = plate_and_box(0.3);
  const std::vector<Vec3> seen = {{1, -0.03, 0}, {2, -0.03, 0}, {2, -0.03, 1}, {1, -0.03, 1}};  // the boxes stand beside it, across its plane
  scene.supports[0].outline = {{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}};
  scene.supports.push_back({1, SupportKind::wall, {Vec3::UnitY(), -0.03}, seen});
  EXPECT_LT(farthest(scene, kDown, 0.3), 0.01);
  scene.supports[1].outline.clear();
  EXPECT_GT(farthest(scene, kDown, 0.3), 0.1);
}

TEST(Referee, WithSomethingBelowTheGroundItEndsToo) {
  if (!has_referee()) GTEST_SKIP() << "built without MuJoCo";
  RefereeScene scene = plate_and_box(0.3);
  scene.supports[0].outline = {{-0.5, -0.5, 0}, {0.5, -0.5, 0}, {0.5, 0.5, 0}, {-0.5, 0.5, 0}};
  scene.supports.push_back({1, SupportKind::ground, {Vec3::UnitZ(), -0.55}, {}});
  scene.boxes.push_back({{0, 0, -0.5}, Mat3::Identity(), {0.05, 0.05, 0.05}});
  scene.masses.push_back(1.0);
  EXPECT_LT(farthest(scene, kDown, 0.3), 0.01);
}

/// A small box that tumbles off the edge of a large one does the same wherever the scene lies, and nothing else moves.
TEST(Referee, ATumblingBoxFallsAlikeEverywhere) {
  if (!has_referee()) GTEST_SKIP() << "built without MuJoCo";
  const auto moves = [](const Vec3& place) {
    RefereeScene scene;
    scene.supports = {{0, SupportKind::ground, {Vec3::UnitZ(), 0.0}, {}}};
    scene.boxes = {{place + Vec3(0, 0, 0.25), Mat3::Identity(), {0.1, 0.1, 0.25}},
                   {place + Vec3(0.103, 0, 0.51), Mat3::Identity(), {0.004, 0.0025, 0.01}}};
    scene.masses = {1.0, 2e-4};
    Context context;
    return simulate(scene, kDown, 0.35, context);
  };
  const auto here = moves(Vec3::Zero()), there = moves({3, -2, 0});
  EXPECT_GT(here[1], 1);  // of its length
  EXPECT_NEAR(there[1], here[1], 0.05 * here[1]);
  EXPECT_LT(std::max(here[0], there[0]), 0.001);
}

}  // namespace
}  // namespace unseen::cuboids
