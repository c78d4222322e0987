// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/relations/reconcile.h"

#include <gtest/gtest.h>

#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

Mat3 about_z(double deg) {
  return Eigen::AngleAxisd(radians(deg), Vec3::UnitZ()).toRotationMatrix();
}

struct Selected {
  Patches patches;
  Selection selection;

  void frame(const Mat3& axes) { selection.frames.push_back({axes, true}); }
  /// A patch that has direction `local` of frame `frame`; its fit is `normal`, known to `sigma` (deg).
  void patch(int frame, int local, const Vec3& normal, double sigma, double area) {
    Patch p;
    p.fit.normal = normal.normalized();
    p.fit.u = any_orthogonal(p.fit.normal);
    p.fit.v = p.fit.normal.cross(p.fit.u);
    p.variance_u = p.variance_v = p.doubt_u = p.doubt_v = std::pow(radians(sigma), 2);
    p.area = area;
    patches.patches.push_back(p);
    selection.frame_of_patch.push_back(frame);
    selection.local_of_patch.push_back(local);
  }
  Reconciled run(const std::vector<double>& angles_deg = {90}) const {
    std::vector<double> g;
    for (const double a : angles_deg) g.push_back(radians(a));
    const AngleSet angles = make_angles(g);
    return reconcile(selection, patches, local_directions(angles, {}), angles, {});
  }
};

/// A room, and a table turned by `turn` whose top is tilted by `tilt` (deg); fits are known to `sigma` (deg).
Selected room_and_table(double turn, double tilt, double sigma) {
  Selected in;
  const Mat3 room = Mat3::Identity();
  const Mat3 table = Eigen::AngleAxisd(radians(tilt), Vec3::UnitX()).toRotationMatrix() * about_z(turn);
  in.frame(room);
  in.frame(table);
  for (int l = 0; l < 3; ++l) in.patch(0, l, room.col(l), sigma, 10);
  for (int l = 0; l < 3; ++l) in.patch(1, l, table.col(l), sigma, 1);
  return in;
}

TEST(Reconcile, ATurnedTableKeepsItsTurnAndSharesTheFloorsUp) {
  const Reconciled r = room_and_table(7, 0.3, 0.3).run();
  ASSERT_EQ(r.frames.size(), 2u);
  EXPECT_LT(line_angle(r.frames[0].axes.col(2), r.frames[1].axes.col(2)), 1e-9);
  EXPECT_NEAR(degrees(line_angle(r.frames[0].axes.col(0), r.frames[1].axes.col(0))), 7.0, 0.3);
  ASSERT_EQ(r.constraints.size(), 2u);
  for (const Constraint& c : r.constraints) {
    EXPECT_GT(c.a, c.b);
    EXPECT_EQ(c.cosine, 0.0);
    EXPECT_NEAR((r.frames[c.a].axes * c.u).dot(r.frames[c.b].axes * c.v), 0.0, 1e-10);
  }
}

TEST(Reconcile, ASignificantTiltIsKept) {
  const Reconciled r = room_and_table(7, 2.0, 0.1).run();
  ASSERT_EQ(r.frames.size(), 2u);
  EXPECT_GT(degrees(line_angle(r.frames[0].axes.col(2), r.frames[1].axes.col(2))), 1.5);
}

TEST(Reconcile, FramesThatDoNotDifferSignificantlyBecomeOne) {
  EXPECT_EQ(room_and_table(0.5, 0.2, 0.5).run().frames.size(), 1u);
  EXPECT_EQ(room_and_table(89.6, 0.2, 0.5).run().frames.size(),
            1u);  // the same but for the roles of its axes
  EXPECT_EQ(room_and_table(5.0, 0.0, 0.5).run().frames.size(), 2u);
}

TEST(Reconcile, TheHeaviestFrameComesFirst) {
  Selected in = room_and_table(7, 0, 0.3);
  std::swap(in.selection.frames[0], in.selection.frames[1]);
  for (int& f : in.selection.frame_of_patch) f = 1 - f;
  const Reconciled r = in.run();
  ASSERT_EQ(r.frames.size(), 2u);
  EXPECT_EQ(r.frame_of_patch, (std::vector<int>{0, 0, 0, 1, 1, 1}));
  EXPECT_LT(line_angle(r.frames[0].axes.col(2), Vec3::UnitZ()), 1e-9);
}

TEST(Reconcile, FramesWithoutPatchesGo) {
  Selected in = room_and_table(7, 0, 0.3);
  in.frame(about_z(33));
  EXPECT_EQ(in.run().frames.size(), 2u);
}

/// Whatever the scene, constraints hold on the frames returned and nothing turns far from its fit.
TEST(Reconcile, ConstraintsHoldOnRandomScenes) {
  Random random(1);
  std::size_t constraints = 0;
  for (int scene = 0; scene < 40; ++scene) {
    Selected in;
    const double sigma = random.uniform(0.1, 0.8);
    const int frames = 2 + static_cast<int>(random.index(5));
    for (int f = 0; f < frames; ++f) {
      const Mat3 axes =
          scene % 3 == 0
              ? Mat3(Eigen::AngleAxisd(random.uniform(0, 3), random.direction()).toRotationMatrix())
              : about_z(random.uniform(0, 90));
      in.frame(axes);
      for (int l = 0; l < 3; ++l)
        in.patch(f, l, axes.col(l) + radians(sigma) * Vec3(random.normal(), random.normal(), random.normal()),
                 sigma, random.uniform(0.5, 5));
    }
    for (const auto& generators : {std::vector<double>{90}, {60, 90}}) {
      const Reconciled r = in.run(generators);
      std::vector<double> g;
      for (const double a : generators) g.push_back(radians(a));
      const std::vector<Vec3> locals = local_directions(make_angles(g), {});
      constraints += r.constraints.size();
      int last = 0;
      for (const Constraint& c : r.constraints) {
        EXPECT_GE(c.a, last);
        last = c.a;
        ASSERT_TRUE(c.b >= 0 && c.b < c.a && c.a < static_cast<int>(r.frames.size()));
        EXPECT_NEAR((r.frames[c.a].axes * c.u).dot(r.frames[c.b].axes * c.v), c.cosine, 1e-10);
      }
      for (std::size_t j = 0; j < in.patches.patches.size(); ++j) {
        ASSERT_TRUE(r.frame_of_patch[j] >= 0 && r.frame_of_patch[j] < static_cast<int>(r.frames.size()));
        const Vec3 n = r.frames[r.frame_of_patch[j]].direction(locals[r.local_of_patch[j]]);
        EXPECT_LT(degrees(line_angle(n, in.patches.patches[j].fit.normal)), 8 * sigma);
      }
    }
  }
  EXPECT_GT(constraints, 40u);
}

}  // namespace
}  // namespace unseen::planes
