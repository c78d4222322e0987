// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "planes/scenes.h"
#include "unseen/planes/evaluate.h"
#include "unseen/planes/synth.h"

namespace unseen::planes {
namespace {

struct Scan {
  std::string file;
  double scale;  // m; 0 = estimated
  std::vector<double> angles = {90};
};

/// Θ, folded, written without the code under test.
double deviation(const Vec3& a, const Vec3& b, const std::vector<double>& generators) {
  const double angle = line_angle(a, b);
  double least = angle;
  for (const double g : generators)
    for (int k = 1; k * g < 179.999; ++k)
      least = std::min(least, std::abs(radians(std::min(k * g, 180 - k * g)) - angle));
  return least;
}

/// Everything that a result states of its own angles.
void expect_exact(const Arrangement& a, const std::vector<double>& generators) {
  const double limit = radians(0.01);
  std::vector<int> planes_of_direction(a.directions.size());
  for (const ArrangedPlane& p : a.planes) {
    ASSERT_TRUE(p.direction >= 0 && p.direction < static_cast<int>(a.directions.size()));
    ASSERT_TRUE(p.frame >= 0 && p.frame < static_cast<int>(a.frames.size()));
    EXPECT_LT(line_angle(p.plane.normal, a.directions[p.direction].normal), limit);
    EXPECT_NEAR(p.plane.normal.norm(), 1.0, 1e-12);
    ++planes_of_direction[p.direction];
  }
  std::size_t pairs = 0;
  for (const int n : planes_of_direction) pairs += static_cast<std::size_t>(n) * (n - 1) / 2;
  for (const Relation& r : a.relations) {
    EXPECT_NE(r.a, r.b);
    EXPECT_LT(std::abs(line_angle(a.directions[r.a].normal, a.directions[r.b].normal) - r.angle), limit);
    EXPECT_LT(deviation(a.directions[r.a].normal, a.directions[r.b].normal, generators), limit);
    pairs += static_cast<std::size_t>(planes_of_direction[r.a]) * planes_of_direction[r.b];
  }
  EXPECT_EQ(a.plane_relations, pairs);
  for (const Frame& f : a.frames)
    for (const int d : f.directions)
      if (generators == std::vector<double>{90})
        for (const int e : f.directions)
          if (d != e) {
            EXPECT_LT(deviation(a.directions[d].normal, a.directions[e].normal, generators), limit);
          }
  for (const auto& group : a.coplanar)
    for (const int p : group) {
      EXPECT_LT(line_angle(a.planes[p].plane.normal, a.planes[group[0]].plane.normal), limit);
      const double sign = a.planes[p].plane.normal.dot(a.planes[group[0]].plane.normal) < 0 ? -1 : 1;
      EXPECT_NEAR(sign * a.planes[p].plane.offset, a.planes[group[0]].plane.offset, 1e-6 * a.scale);
    }
  EXPECT_LT(evaluate_relations(a).largest_error, limit);
}

class Scans : public testing::TestWithParam<Scan> {};
INSTANTIATE_TEST_SUITE_P(
    Shared, Scans,
    testing::Values(Scan{"rapter/lhouse_bu3.ply", 0.0175}, Scan{"rapter/lhouse_bu3.ply", 0.0175, {45}},
                    Scan{"rapter/tofRange.025.ply", 0.05}, Scan{"rapter/stairs_01.ply", 0},
                    Scan{"rapter/lans_100k.ply", 0}, Scan{"cgal/building.ply", 0}, Scan{"city3d/b9.ply", 0},
                    Scan{"city3d/b57.ply", 0}, Scan{"rapter/overview_sigg2d.ply", 0, {60, 90}},
                    Scan{"rapter/two_rectangles.ply", 0}, Scan{"rapter/increasing-noise-0.ply", 0}),
    [](const auto& info) {
      std::string name = info.param.file.substr(info.param.file.find('/') + 1);
      name = name.substr(0, name.rfind('.'));
      for (const double a : info.param.angles) name += "_" + std::to_string(static_cast<int>(a));
      std::replace_if(
          name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
      return name;
    });

TEST_P(Scans, EveryRelationStatedHolds) {
  const auto file = test::shared_scan(GetParam().file);
  if (file.empty()) GTEST_SKIP() << test::kNoScan;
  const auto source = io::open_points(file);
  Options options;
  if (GetParam().scale > 0) options.scale = GetParam().scale;
  options.angles = GetParam().angles;
  Context context;
  const test::Run r = test::run(*source, options, context);
  EXPECT_EQ(r.result.summary.status, Status::solved);
  EXPECT_GE(r.result.planes.size(), 4u);
  EXPECT_FALSE(r.result.relations.empty());
  expect_exact(r.result, options.angles);
  const std::size_t assigned =
      r.plane_of_point.size() - std::count(r.plane_of_point.begin(), r.plane_of_point.end(), -1);
  std::cout << r.result.planes.size() << " planes, " << r.result.frames.size() << " frames, "
            << 100.0 * assigned / r.plane_of_point.size() << " % assigned, scale " << r.result.scale << ", "
            << evaluate_relations(r.result).near_misses << " near misses\n";
}

class SynthScans : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(All, SynthScans,
                         testing::Values("lhouse", "stairs", "room", "floorplan", "building"),
                         [](const auto& info) { return info.param; });

TEST_P(SynthScans, EveryRelationStatedHolds) {
  SynthOptions synth;
  synth.scene = GetParam();
  synth.points = 50'000;
  Context context;
  const SynthScene scene = make_scene(synth, context);
  const test::Run r = test::run(scene.cloud, Options());
  EXPECT_FALSE(r.result.relations.empty());
  expect_exact(r.result, {90});
  EXPECT_EQ(r.result.two_dimensional, scene.two_dimensional);
}

}  // namespace
}  // namespace unseen::planes
