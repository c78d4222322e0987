// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <optional>
#include <set>

#include "planes/scenes.h"
#include "unseen/io/mesh.h"
#include "unseen/planes/evaluate.h"
#include "unseen/planes/synth.h"

namespace unseen::planes {
namespace {

struct Measured {
  AssignmentScore score;
  Arrangement result;
};

std::optional<Measured> measure(const std::string& scan, const std::string& truth, const Options& options) {
  const auto file = test::shared_scan(scan);
  const auto mesh = test::shared_scan(truth);
  if (file.empty() || mesh.empty()) return std::nullopt;
  const PointCloud cloud = test::read_cloud(file);
  test::Run r = test::run(cloud, options);
  std::vector<Plane> planes;
  for (const ArrangedPlane& p : r.result.planes) planes.push_back(p.plane);
  Context context;
  const TruthScore s = evaluate_against_mesh(cloud.positions, r.plane_of_point, planes, io::read_mesh(mesh),
                                             {*options.scale, 500'000, 1}, context);
  const AngleScore& a = s.as_assigned.angles_recalled;
  std::cout << scan << ": recalled mean " << degrees(a.mean) << " deg, " << 100 * a.below_tenth
            << " % below 0.1; all mean " << degrees(s.as_assigned.angles.mean) << ", "
            << 100 * s.as_assigned.angles.below_tenth << " %; recall " << 100 * s.as_assigned.recall << " % ("
            << 100 * s.nearest.recall << " % nearest), " << planes.size() << " planes\n";
  return Measured{s.as_assigned, std::move(r.result)};
}

// What the method has to reach. Recall counts points without a plane as missed.

TEST(Accuracy, LHouse) {
  const auto m = measure("rapter/lhouse_bu3.ply", "rapter/lhouse_exact.obj", test::with_scale(0.0175));
  if (!m) GTEST_SKIP() << test::kNoScan;
  EXPECT_LE(degrees(m->score.angles_recalled.mean), 0.05);
  EXPECT_GE(m->score.angles_recalled.below_tenth, 0.88);
  EXPECT_GE(m->score.recall, 0.997);
}

TEST(Accuracy, LHouseWithAnglesOf45) {
  const auto m = measure("rapter/lhouse_bu3.ply", "rapter/lhouse_exact.obj", test::with_scale(0.0175, {45}));
  if (!m) GTEST_SKIP() << test::kNoScan;
  EXPECT_LE(degrees(m->score.angles_recalled.mean), 0.02);
  EXPECT_GE(m->score.angles_recalled.below_tenth, 0.97);
  EXPECT_GE(m->score.recall, 0.997);
}

TEST(Accuracy, TofRange) {
  const auto m = measure("rapter/tofRange.025.ply", "rapter/tofRange_gt.obj", test::with_scale(0.05));
  if (!m) GTEST_SKIP() << test::kNoScan;
  EXPECT_LE(degrees(m->score.angles_recalled.mean), 0.06);
  EXPECT_GE(m->score.angles_recalled.below_tenth, 0.88);
  EXPECT_GE(m->score.recall, 0.999);
  EXPECT_FALSE(m->result.relations.empty());
}

struct Turned {
  double turn, share;
};

class TurnedFurniture : public testing::TestWithParam<Turned> {};
INSTANTIATE_TEST_SUITE_P(Rooms, TurnedFurniture,
                         testing::Values(Turned{5, 0.05}, Turned{8, 0.05}, Turned{12, 0.02}, Turned{20, 0.05},
                                         Turned{33, 0.1}),
                         [](const auto& info) {
                           return std::to_string(static_cast<int>(info.param.turn)) + "deg_" +
                                  std::to_string(static_cast<int>(100 * info.param.share + 0.5)) + "percent";
                         });

/// Furniture turned in a room keeps its orientation: points on its faces get normals within 0.3° of the
/// truth.
TEST_P(TurnedFurniture, KeepsItsFrame) {
  SynthOptions synth;
  synth.points = 100'000;
  synth.turn = GetParam().turn;
  synth.share = GetParam().share;
  Context context;
  const SynthScene scene = make_scene(synth, context);
  const test::Run r = test::run(scene.cloud, test::with_scale(0.05));
  std::vector<int> turned = scene.turned;
  std::sort(turned.begin(), turned.end());
  std::size_t upright = 0, right = 0;
  std::set<int> frames;
  for (std::size_t i = 0; i < scene.cloud.size(); ++i) {
    const int label = scene.cloud.labels[i], plane = r.plane_of_point[i];
    if (label < 0 || std::abs(scene.planes[label].normal.z()) > 0.5)
      continue;  // tops say nothing of the turn
    if (!std::binary_search(turned.begin(), turned.end(), label)) continue;
    ++upright;
    if (plane < 0 ||
        line_angle(r.result.planes[plane].plane.normal, scene.planes[label].normal) > radians(0.3))
      continue;
    ++right;
    frames.insert(r.result.planes[plane].frame);
  }
  ASSERT_GT(upright, 100u);
  std::cout << 100.0 * right / upright << " % of " << upright << " points within 0.3 deg, "
            << r.result.frames.size() << " frames\n";
  EXPECT_GE(static_cast<double>(right), 0.8 * static_cast<double>(upright));
  EXPECT_FALSE(frames.empty());
}

/// The room itself, too, within 0.3°, however its furniture stands.
TEST_P(TurnedFurniture, LeavesTheRoomAlone) {
  SynthOptions synth;
  synth.points = 100'000;
  synth.turn = GetParam().turn;
  synth.share = GetParam().share;
  Context context;
  const SynthScene scene = make_scene(synth, context);
  const test::Run r = test::run(scene.cloud, test::with_scale(0.05));
  std::size_t all = 0, right = 0;
  for (std::size_t i = 0; i < scene.cloud.size(); ++i) {
    const int label = scene.cloud.labels[i], plane = r.plane_of_point[i];
    if (label < 0 || scene.frames[label] != 0) continue;
    ++all;
    right += plane >= 0 &&
             line_angle(r.result.planes[plane].plane.normal, scene.planes[label].normal) < radians(0.3);
  }
  EXPECT_GE(static_cast<double>(right), 0.97 * static_cast<double>(all));
}

}  // namespace
}  // namespace unseen::planes
