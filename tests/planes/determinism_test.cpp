// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "planes/digest.h"
#include "planes/scenes.h"
#include "unseen/planes/synth.h"

namespace unseen::planes {
namespace {

struct Input {
  std::string name;
  PointCloud cloud;
  Options options;
  bool two_dimensional = false;
};

PointCloud synth(const std::string& scene, int points, bool normals) {
  SynthOptions options;
  options.scene = scene;
  options.points = points;
  options.normals = normals;
  options.outliers = 0.01;
  Context context;
  return make_scene(options, context).cloud;
}

Input make_input(const std::string& name) {
  Input in{name, {}, {}};
  if (name == "room") {
    in.cloud = synth("room", 60'000, true);
    in.options = test::with_scale(0.08);
  } else if (name == "estimated") {
    in.cloud = synth("lhouse", 20'000, false);
  } else if (name == "angles") {
    in.cloud = synth("lhouse", 20'000, false);
    in.options = test::with_scale(0.2, {45});
    in.options.adaptive_scale = true;
  } else if (name == "floorplan") {
    in.cloud = synth("floorplan", 8'000, false);
    in.two_dimensional = true;
  } else if (const auto file = test::shared_scan("rapter/lhouse_bu3.ply"); !file.empty()) {
    in.cloud = test::read_cloud(file);
    in.options = test::with_scale(0.0175);
  }
  in.cloud.labels.clear();
  in.cloud.colors.clear();
  return in;
}

class Determinism : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Inputs, Determinism,
                         testing::Values("room", "estimated", "angles", "floorplan", "scan"),
                         [](const auto& info) { return info.param; });

TEST_P(Determinism, SameBytesAtAnyThreadCount) {
  const Input in = make_input(GetParam());
  if (in.cloud.size() == 0) GTEST_SKIP() << test::kNoScan;
  // As many threads as asked for, on machines with fewer cores as well.
  const tbb::global_control four(tbb::global_control::max_allowed_parallelism, 4);
  const test::Run one = test::run(in.cloud, in.options, 1);
  ASSERT_GE(one.result.planes.size(), 3u);
  ASSERT_EQ(one.plane_of_point.size(), in.cloud.size());
  const test::Digest expected(one.result);
  ASSERT_GT(expected.size(), 50u);
  for (const int threads : {2, 4}) {
    const test::Run other = test::run(in.cloud, in.options, threads);
    EXPECT_TRUE(test::Digest(other.result) == expected)
        << threads << " threads differ at word " << expected.first_difference(test::Digest(other.result));
    EXPECT_TRUE(other.plane_of_point == one.plane_of_point);
  }
}

TEST_P(Determinism, SameBytesForShuffledInput) {
  Input in = make_input(GetParam());
  if (in.cloud.size() == 0) GTEST_SKIP() << test::kNoScan;
  // Some points twice, with different normals, and some that are not finite.
  for (std::size_t i = 0; i < 50; ++i) {
    in.cloud.positions.push_back(in.cloud.positions[37 * i]);
    if (!in.cloud.normals.empty()) in.cloud.normals.push_back(-in.cloud.normals[11 * i]);
  }
  in.cloud.positions[5].y() = std::nan("");
  const test::Run straight = test::run(in.cloud, in.options);
  const test::Digest expected(straight.result);
  for (const std::uint64_t seed : {1u, 2u}) {
    const auto order = test::shuffled(in.cloud.size(), seed);
    const test::Run mixed = test::run(test::reordered(in.cloud, order), in.options);
    EXPECT_TRUE(test::Digest(mixed.result) == expected)
        << "shuffle " << seed << " differs at word " << expected.first_difference(test::Digest(mixed.result));
    ASSERT_EQ(mixed.plane_of_point.size(), order.size());
    std::size_t differing = 0;
    for (std::size_t i = 0; i < order.size(); ++i)
      differing += mixed.plane_of_point[i] != straight.plane_of_point[order[i]];
    EXPECT_EQ(differing, 0u);
  }
}

/// A stream of blocks gives what the cloud in memory gives, twins included.
TEST_P(Determinism, SameBytesStreamed) {
  const Input in = make_input(GetParam());
  if (in.cloud.size() == 0) GTEST_SKIP() << test::kNoScan;
  PointCloud cloud = in.cloud;
  for (std::size_t i = 0; i < cloud.size(); i += 50) cloud.positions[i] = cloud.positions[i / 2];
  CloudSource source(cloud);
  Context context;
  test::Run whole = test::run(source, in.options, context);
  for (const std::size_t block : {1000u, 7777u}) {
    test::Stream stream(cloud, in.two_dimensional, block);
    const test::Run streamed = test::run(stream, in.options, context);
    EXPECT_TRUE(test::Digest(streamed.result) == test::Digest(whole.result)) << block;
    EXPECT_TRUE(streamed.plane_of_point == whole.plane_of_point);
  }
}

/// What the sink is told and what the planes say agree.
TEST_P(Determinism, CountsAgreeWithTheAssignment) {
  const Input in = make_input(GetParam());
  if (in.cloud.size() == 0) GTEST_SKIP() << test::kNoScan;
  const test::Run r = test::run(in.cloud, in.options);
  std::vector<std::size_t> points(r.result.planes.size());
  std::size_t assigned = 0;
  for (const int p : r.plane_of_point) {
    ASSERT_TRUE(p >= -1 && p < static_cast<int>(points.size()));
    if (p >= 0) ++points[p], ++assigned;
  }
  for (std::size_t p = 0; p < points.size(); ++p) EXPECT_EQ(points[p], r.result.planes[p].points);
  for (const auto& [name, count] : r.result.summary.counts) {
    if (name == "assigned") {
      EXPECT_EQ(count, assigned);
    }
    if (name == "points") {
      EXPECT_EQ(count, in.cloud.size());
    }
    if (name == "planes") {
      EXPECT_EQ(count, points.size());
    }
  }
}

}  // namespace
}  // namespace unseen::planes
