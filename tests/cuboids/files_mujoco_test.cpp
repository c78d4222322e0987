// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// scene.xml in MuJoCo: what stands stands still for 2 s, what does not falls.
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cuboids/files_sample.h"
#include "unseen/report/cuboids_files.h"

namespace unseen::cuboids {
namespace {

struct Simulation {
  explicit Simulation(const std::string& xml) {
    mjVFS files;
    mj_defaultVFS(&files);
    mj_makeEmptyFileVFS(&files, "scene.xml", static_cast<int>(xml.size()));
    std::copy(xml.begin(), xml.end(), static_cast<char*>(files.filedata[0]));
    char error[1000] = "";
    model.reset(mj_loadXML("scene.xml", &files, error, sizeof error));
    mj_deleteVFS(&files);
    if (!model) ADD_FAILURE() << error;
    if (model) data.reset(mj_makeData(model.get()));
  }
  std::vector<Vec3> places() {
    mj_kinematics(model.get(), data.get());
    std::vector<Vec3> all;
    for (int i = 0; i < model->ngeom; ++i) all.emplace_back(Vec3::Map(data->geom_xpos + 3 * i));
    return all;
  }
  /// m: how far the geom went that went farthest.
  double largest_motion(double seconds) {
    const std::vector<Vec3> before = places();
    while (data->time < seconds) mj_step(model.get(), data.get());
    const std::vector<Vec3> after = places();
    double most = 0;
    for (std::size_t i = 0; i < before.size(); ++i) most = std::max(most, (after[i] - before[i]).norm());
    return most;
  }
  int warnings() const {
    int count = 0;
    for (int i = 0; i < mjNWARNING; ++i) count += data->warning[i].number;
    return count;
  }

  struct Free {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };
  std::unique_ptr<mjModel, Free> model;
  std::unique_ptr<mjData, Free> data;
};

TEST(Mjcf, SceneHoldsBodiesAndSettings) {
  const Completion c = sample_completion();
  Simulation s(report::cuboids_mjcf(c, 0.6));
  ASSERT_TRUE(s.model);
  EXPECT_EQ(s.model->opt.timestep, 1e-3);
  EXPECT_EQ(s.model->opt.cone, mjCONE_ELLIPTIC);
  EXPECT_EQ(s.model->opt.impratio, 20);
  EXPECT_EQ(s.model->opt.solver, mjSOL_NEWTON);
  EXPECT_EQ(s.model->opt.noslip_iterations, 5);
  ASSERT_EQ(s.model->nbody, 1 + 3);
  EXPECT_EQ(s.model->njnt, 2);  // the shelf hangs on the wall
  EXPECT_EQ(s.model->ngeom, 2 + 3);
  EXPECT_EQ(mj_name2id(s.model.get(), mjOBJ_BODY, "box 3 (tea & <co> \"1\")"), 2);
  for (int i = 0; i < s.model->ngeom; ++i) EXPECT_EQ(s.model->geom_friction[3 * i], 0.6);
  for (int b = 0; b < 3; ++b) {
    const Cuboid& cuboid = c.cuboids[static_cast<std::size_t>(b)];
    EXPECT_NEAR(s.model->body_mass[b + 1], cuboid.mass(), 1e-8);
    EXPECT_LT((Vec3::Map(s.model->body_pos + 3 * (b + 1)) - cuboid.box.center).norm(), 1e-8);
  }
  EXPECT_LT(s.largest_motion(2.0), 1e-3);
}

TEST(Mjcf, TowerStandsStill) {
  Simulation s(report::cuboids_mjcf(sample_tower(6, 0.005), 0.7));
  ASSERT_TRUE(s.model);
  EXPECT_LT(s.largest_motion(2.0), 0.005);  // 5 % of a cube
  EXPECT_EQ(s.warnings(), 0);
}

TEST(Mjcf, LeaningTowerFalls) {  // the upper five are beyond the edge of the lowest
  Simulation s(report::cuboids_mjcf(sample_tower(6, 0.03), 0.7));
  ASSERT_TRUE(s.model);
  EXPECT_GT(s.largest_motion(2.0), 0.05);
}

TEST(Mjcf, FixedContactsHoldWhatWouldFall) {
  Completion c = sample_tower(3, 0);
  c.cuboids[2].box.center.x() += 0.09;  // beyond the edge of the one below
  Simulation falls(report::cuboids_mjcf(c, 0.7));
  EXPECT_GT(falls.largest_motion(2.0), 0.05);
  c.contacts[1].kind = c.contacts[2].kind = ContactKind::fixed;
  c.cuboids[0].density = 3000;
  Simulation s(report::cuboids_mjcf(c, 0.7));
  ASSERT_TRUE(s.model);
  EXPECT_EQ(s.model->nbody, 2);
  EXPECT_NEAR(s.model->body_mass[1], 3.0 + 2 * 0.3, 1e-9);
  EXPECT_LT(s.largest_motion(2.0), 0.005);
}

TEST(Mjcf, WhatNothingSupportsIsHeld) {
  Completion c = sample_tower(2, 0);
  c.cuboids[1].box.center.z() += 0.3;
  c.contacts.pop_back();
  c.unsupported = {2};
  Simulation s(report::cuboids_mjcf(c, 0.7));
  ASSERT_TRUE(s.model);
  EXPECT_LT(s.largest_motion(1.0), 0.005);
}

TEST(Mjcf, AWallOfManyBoxesFitsIntoItsMemory) {
  Completion c;
  c.supports = sample_tower(1, 0).supports;
  for (int row = 0; row < 7; ++row)
    for (int k = 0; k < 8; ++k)
      c.cuboids.push_back(
          sample_box(1 + 8 * row + k, {0.2 * k + 0.1 * (row % 2), 1.0, 0.05 + 0.1 * row}, 0, {0.2, 0.1, 0.1}));
  Simulation s(report::cuboids_mjcf(c, 0.7));
  ASSERT_TRUE(s.model);
  EXPECT_LT(s.largest_motion(0.01), 0.005);
  EXPECT_EQ(s.warnings(), 0);
}

}  // namespace
}  // namespace unseen::cuboids
