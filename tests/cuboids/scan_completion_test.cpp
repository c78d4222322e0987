// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/cuboids/scan_completion.h"

#include <gtest/gtest.h>

#include "cuboids/applications/box_matching.h"
#include "cuboids/applications/model_boxes.h"
#include "cuboids/applications/registration.h"
#include "cuboids/furniture_fixture.h"
#include "unseen/core/error.h"

namespace unseen::cuboids {
namespace {

using namespace furniture_fixture;

/// Radians between two turns.
double angle_between(const Mat3& a, const Mat3& b) {
  return Eigen::AngleAxisd(a.transpose() * b).angle();
}

PointCloud cloud_of(std::vector<Vec3> points) {
  PointCloud cloud;
  cloud.positions = std::move(points);
  return cloud;
}

/// The object where T says, seen by a camera; its boxes are off by up to `off` (m).
struct Completed {
  RgbdFrame frame;
  Completion completion;

  Completed(const std::vector<OrientedBox>& object, const RigidTransform& T, double off) {
    const std::vector<OrientedBox> boxes = moved(object, T);
    frame = photo_fixture::render(boxes, camera_pose()).frame;
    completion = photo_fixture::scene_of(boxes);
    completion.T_world_camera = camera_pose();
    Random random(5);
    for (Cuboid& c : completion.cuboids)
      for (int k = 0; k < 3; ++k) {
        c.box.center[k] += random.uniform(-off, off);
        c.box.half_size[k] += 0.5 * random.uniform(-off, off);
      }
  }
};

void expect_found(const ScanCompletion& found, const RigidTransform& T_expected) {
  ASSERT_TRUE(found.found);
  EXPECT_LT((found.T_world_model.translation - T_expected.translation).norm(), 0.006);
  EXPECT_LT(degrees(angle_between(found.T_world_model.rotation, T_expected.rotation)), 0.6);
  EXPECT_GT(found.explained, 0.9);
  EXPECT_LT(found.rms, 0.006);
}

TEST(GreedySlabs, FindsTheBlocksThatTheGridIsMadeOf) {
  CellGrid grid{{12, 10, 8}, std::vector<char>(12 * 10 * 8, 0)};
  const std::vector<CellBlock> truth = {{{0, 0, 0}, {12, 10, 2}}, {{0, 7, 2}, {12, 10, 8}}, {{0, 0, 2}, {2, 7, 5}}};
  for (const CellBlock& b : truth)
    for (int x = b.low[0]; x < b.high[0]; ++x)
      for (int y = b.low[1]; y < b.high[1]; ++y)
        for (int z = b.low[2]; z < b.high[2]; ++z) grid.cells[grid.at(x, y, z)] = 1;
  const std::vector<CellBlock> found = greedy_slabs(grid, 0.7, 4);
  int cells = 0, filled = 0;
  for (const CellBlock& b : found) {
    int held = 0;
    for (int x = b.low[0]; x < b.high[0]; ++x)
      for (int y = b.low[1]; y < b.high[1]; ++y)
        for (int z = b.low[2]; z < b.high[2]; ++z) held += grid.cells[grid.at(x, y, z)];
    EXPECT_GE(held, 0.7 * b.cells());
    cells += b.cells();
    filled += held;
  }
  EXPECT_EQ(found.size(), truth.size());
  EXPECT_EQ(filled, 12 * 10 * 2 + 12 * 3 * 6 + 2 * 7 * 3);
  EXPECT_EQ(cells, filled);
}

TEST(ModelBoxes, AreThoseOfTheChair) {
  const RigidTransform T = upright(0.5, {0.3, -0.2, 0});
  const std::vector<OrientedBox> boxes = fit_model_boxes(samples(moved(chair(), T), 40000, 1), 0.7);
  double volume = 0.0;
  for (const OrientedBox& truth : moved(chair(), T)) {
    const auto near = std::find_if(boxes.begin(), boxes.end(), [&](const OrientedBox& b) {
      return (b.center - truth.center).norm() < 0.04 && std::abs(b.half_size.z() - truth.half_size.z()) < 0.04;
    });
    EXPECT_NE(near, boxes.end());
    volume += truth.volume();
  }
  double found = 0.0;
  for (const OrientedBox& b : boxes) found += b.volume();
  EXPECT_NEAR(found, volume, 0.4 * volume);  // cells of 25 mm in parts of 50 mm
}

TEST(MatchBoxes, FindsWhichIsWhichInAnyOrder) {
  const std::vector<OrientedBox> model = sofa();
  std::vector<OrientedBox> scene = moved(sofa(), upright(1.1, {0.7, 0.4, 0}));
  std::swap(scene[0], scene[2]);
  scene.push_back(box_at({-1.5, 0, 0}, {0.3, 0.3, 0.3}));
  const SpectralMatch match = match_boxes(model, scene);
  ASSERT_EQ(match.matches.size(), 4u);
  for (const BoxMatch& m : match.matches) {
    const std::vector<int> expected = {2, 1};  // the arms are alike
    if (m.model_box < 2) {
      EXPECT_EQ(m.cuboid, expected[m.model_box]);
    }
    EXPECT_NE(m.cuboid, 4);
  }
}

TEST(RegisterUpright, FindsAKnownMotion) {
  const RigidTransform T = upright(radians(6), {0.03, -0.02, 0.01});
  const std::vector<Vec3> source = samples(chair(), 1500, 2);
  const SampledSurface target(samples(moved(chair(), T), 20000, 3));
  const Registration fit = register_upright(source, target, {}, 0.1);
  EXPECT_LT((fit.T_target_source.translation - T.translation).norm(), 0.002);
  EXPECT_LT(degrees(angle_between(fit.T_target_source.rotation, T.rotation)), 0.2);
  EXPECT_GT(fit.matched, 0.99);
}

TEST(ScanCompletion, LaysTheChairWhereItStands) {
  const RigidTransform T_model = upright(2.0, {4.0, -3.0, 0.5});  // the scan has a world of its own
  const PointCloud model = cloud_of(samples(moved(chair(), T_model), 40000, 1));
  for (const double yaw : {0.35, -2.0}) {
    const RigidTransform T = upright(yaw, {0.1, 0.2, 0.0});
    const Completed scene(chair(), T, 0.01);
    Context context;
    const ScanCompletion found = complete_scan(scene.frame, scene.completion, model, {}, context);
    expect_found(found, T * T_model.inverse());
    const auto measured = std::count(found.completed.labels.begin(), found.completed.labels.end(), 0);
    EXPECT_EQ(found.completed.size(), static_cast<std::size_t>(measured) + model.size());
    EXPECT_EQ(found.completed.colors.size(), found.completed.size());
  }
}

TEST(ScanCompletion, LaysTheSofaWhereItStands) {
  const RigidTransform T = upright(0.3, {0.0, 0.4, 0.0});
  const Completed scene(sofa(), T, 0.015);
  Context context;
  expect_found(complete_scan(scene.frame, scene.completion, cloud_of(samples(sofa(), 60000, 1)), {}, context), T);
}

/// The frame as a cloud, in the camera's axes, that was seen from `viewpoint`.
RgbdFrame fused(const RgbdFrame& image, const Vec3& viewpoint) {
  RgbdFrame out;
  out.cloud.viewpoint = viewpoint;
  const int w = image.camera.width;
  for (int i = 0; i < static_cast<int>(image.depth.size()); ++i)
    if (image.depth[i] > 0.0f) out.cloud.positions.push_back(image.camera.unproject(i % w, i / w, image.depth[i]) + viewpoint);
  return out;
}

TEST(ScanCompletion, FindsTheSameInACloudSeenFromElsewhere) {
  const RigidTransform T = upright(0.35, {0.1, 0.2, 0.0});
  const Completed scene(chair(), T, 0.01);
  const PointCloud model = cloud_of(samples(chair(), 40000, 1));
  for (const Vec3& viewpoint : {Vec3(0, 0, 0), Vec3(5, 2, -1)}) {
    Context context;
    const ScanCompletion found = complete_scan(fused(scene.frame, viewpoint), scene.completion, model, {}, context);
    expect_found(found, T);
    EXPECT_EQ(static_cast<std::size_t>(std::count(found.completed.labels.begin(), found.completed.labels.end(), 1)), model.size());
  }
}

TEST(ScanCompletion, SaysIfNothingIsAlike) {
  const Completed scene(chair(), upright(0.3, {0, 0.2, 0}), 0.0);
  Context context;
  const PointCloud tower = cloud_of(samples({box_at({0, 0, 0}, {2.0, 1.6, 1.9})}, 5000, 1));
  const ScanCompletion found = complete_scan(scene.frame, scene.completion, tower, {}, context);
  EXPECT_FALSE(found.found);
  EXPECT_EQ(found.completed.size(), 0u);
}

TEST(ScanCompletion, RefusesModelsThatAreNone) {
  const Completed scene(chair(), upright(0.3, {0, 0.2, 0}), 0.0);
  Context context;
  EXPECT_THROW(complete_scan(scene.frame, scene.completion, {}, {}, context), InputError);
  std::vector<Vec3> millimetres = samples(chair(), 100, 1);
  for (Vec3& p : millimetres) p *= 1000.0;
  EXPECT_THROW(complete_scan(scene.frame, scene.completion, cloud_of(millimetres), {}, context), InputError);
}

}  // namespace
}  // namespace unseen::cuboids
