// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Frames that patches suit because there are many frames.
#include <gtest/gtest.h>

#include "planes/relations/relate.h"
#include "planes/scenes.h"

namespace unseen::planes {
namespace {

const std::vector<Vec3> kAxes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
const AngleSet kRight = make_angles({kPi / 2});

/// A patch whose fit is known to `noise` and whose tilts are doubted by `doubt` (deg).
Patch patch_along(const Vec3& normal, double noise, double doubt) {
  Patch p;
  p.fit.normal = normal;
  p.fit.u = any_orthogonal(normal);
  p.fit.v = normal.cross(p.fit.u);
  p.fit.spread_u = p.fit.spread_v = 2.0;
  p.fit.rms = 0.001;
  p.moments.count = 400;
  p.variance_u = p.variance_v = std::pow(radians(noise), 2);
  p.doubt_u = p.doubt_v = std::pow(radians(doubt), 2);
  p.area = 10.0;
  return p;
}

Vec3 tilted(const Vec3& normal, double degrees) { return Eigen::AngleAxisd(radians(degrees), any_orthogonal(normal)) * normal; }

double evidence(const std::vector<Patch>& patches, const std::vector<int>& locals) {
  Group group{{Mat3::Identity(), true}, {}, 0.0};
  for (std::size_t j = 0; j < patches.size(); ++j) group.members.push_back({static_cast<int>(j), locals[j]});
  const Space space;
  return log_evidence({patches, kAxes, kRight, space}, group);
}

TEST(Chance, OnePatchIsNoEvidence) {
  for (const double doubt : {0.1, 1.0, 10.0}) EXPECT_NEAR(evidence({patch_along(Vec3::UnitX(), 0.1, doubt)}, {0}), 0.0, 0.02) << doubt;
}

/// The mean over rotations of the likelihood of normals, over that of normals that lie anyhow: by drawing rotations.
TEST(Chance, EvidenceOfPatchesThatFitIsTheIntegralOverRotations) {
  const double doubt = radians(12.0);
  for (const std::size_t count : {2u, 3u}) {
    std::vector<Patch> patches;
    for (std::size_t a = 0; a < count; ++a) patches.push_back(patch_along(kAxes[a], 1.0, 12.0));
    Random random(3);
    constexpr int kDraws = 4'000'000;
    double sum = 0;
    for (int i = 0; i < kDraws; ++i) {
      const Eigen::Quaterniond turn = Eigen::Quaterniond(random.normal(), random.normal(), random.normal(), random.normal()).normalized();
      const Mat3 axes = turn.toRotationMatrix();
      double likelihood = 1;
      for (std::size_t a = 0; a < count; ++a) {
        const double off = std::acos(std::min(1.0, std::abs(axes.col(static_cast<int>(a)).dot(kAxes[a]))));
        likelihood *= std::exp(-0.5 * off * off / (doubt * doubt)) / (doubt * doubt);  // (2π s²)⁻¹ over (2π)⁻¹ of a half sphere
      }
      sum += likelihood;
    }
    // A frame is as good turned by half turns about its axes: four of them.
    EXPECT_NEAR(evidence(patches, {0, 1, 2}), std::log(sum / kDraws / 4.0), 0.1) << count;
  }
}

/// Three patches nearly at right angles to each other, each `off` (deg) its frame's axis, among `others` free ones.
std::vector<Group> three_among(int others, double off, std::vector<Patch>& patches) {
  std::vector<Group> groups = {{{Mat3::Identity(), true}, {{0, 0}, {1, 1}, {2, 2}}, 30.0}};
  for (int a = 0; a < 3; ++a) patches.push_back(patch_along(tilted(kAxes[a], off), 0.05, 0.55));
  Random random(5);
  for (int i = 0; i < others; ++i) {
    patches.push_back(patch_along(random.direction(), 0.05, 0.55));
    groups.push_back({open_frame(patches.back().fit.normal, {}), {{3 + i, 0}}, 10.0});
  }
  return groups;
}

bool parted(int others, double off, const std::vector<std::pair<int, int>>& adjoining = {}) {
  std::vector<Patch> patches;
  std::vector<Group> groups = three_among(others, off, patches);
  const Space space;
  const std::size_t before = groups.size();
  const bool any = part_by_chance({patches, kAxes, kRight, space}, adjoining, groups);
  EXPECT_EQ(any, groups.size() > before);
  std::vector<int> seen(patches.size(), 0);
  for (const Group& g : groups)
    for (const Member& m : g.members) ++seen[m.patch];
  EXPECT_EQ(seen, std::vector<int>(patches.size(), 1));
  return any;
}

TEST(Chance, PatchesOfDifferentHousesThatAreOffLeaveTheirFrame) {
  EXPECT_TRUE(parted(40, 1.4));
  EXPECT_FALSE(parted(40, 0.1)) << "well where they are";
}

TEST(Chance, PatchesThatAdjoinStay) { EXPECT_FALSE(parted(40, 0.8, {{0, 1}, {1, 2}, {0, 2}})); }

TEST(Chance, WhereThereAreFewFramesPatchesStay) {
  const std::vector<std::pair<int, int>> corner = {{0, 1}, {1, 2}, {0, 2}};
  EXPECT_FALSE(parted(1, 0.8, corner));
}

}  // namespace
}  // namespace unseen::planes
