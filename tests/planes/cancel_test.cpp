// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <set>

#include "planes/scenes.h"

namespace unseen::planes {
namespace {

const PointCloud& cloud() {
  static const PointCloud cloud = test::box_cloud({0, 0, 0}, {3, 2, 1.5}, 0.02, 0.003, 1);
  return cloud;
}

struct Stopped {
  Arrangement result;
  std::size_t points = 0;  ///< that the sink got
};

/// Asks for a stop when `stage` reports progress for the `call`-th time.
Stopped stop_at(const std::string& stage, int call) {
  std::stop_source stop;
  Context context;
  context.threads = 2;
  context.stop = stop.get_token();
  int calls = 0;
  context.on_progress = [&](std::string_view name, double) {
    if (name == stage && ++calls == call) stop.request_stop();
  };
  CloudSource source(cloud());
  Stopped s;
  s.result = find_planes(source, test::with_scale(0.08), context,
                         [&](std::span<const Vec3> p, std::span<const int>) { s.points += p.size(); });
  return s;
}

class Cancellation : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Stages, Cancellation,
                         testing::Values("survey", "voxels", "normals", "patches", "selection", "refit",
                                         "assignment", "relations"),
                         [](const auto& info) { return info.param; });

TEST_P(Cancellation, AtAStagesFirstReport) {
  const Stopped s = stop_at(GetParam(), 1);
  EXPECT_EQ(s.result.summary.status, Status::cancelled);
  EXPECT_TRUE(s.result.planes.empty());
  EXPECT_TRUE(s.result.directions.empty());
  EXPECT_TRUE(s.result.relations.empty());
  if (GetParam() != "relations") {
    EXPECT_LT(s.points, cloud().size());
  }
}

TEST(CancellationStages, AreAllTheStagesThereAre) {
  std::set<std::string> stages;
  double last = 0;
  std::string current;
  Context context;
  context.on_progress = [&](std::string_view name, double fraction) {
    EXPECT_GE(fraction, 0.0);
    EXPECT_LE(fraction, 1.0);
    if (current == name) {
      EXPECT_GE(fraction, last) << name << " goes backwards";
    }
    current = name;
    last = fraction;
    stages.insert(std::string(name));
  };
  CloudSource source(cloud());
  const Arrangement a = find_planes(source, test::with_scale(0.08), context);
  EXPECT_EQ(a.summary.status, Status::solved);
  EXPECT_EQ(stages, (std::set<std::string>{"survey", "voxels", "normals", "patches", "selection", "refit",
                                           "assignment", "relations"}));
  EXPECT_EQ(a.summary.seconds.size(), stages.size());
}

TEST(CancellationStages, BeforeTheFirst) {
  std::stop_source stop;
  stop.request_stop();
  Context context;
  context.stop = stop.get_token();
  CloudSource source(cloud());
  bool called = false;
  const Arrangement a = find_planes(source, Options(), context, [&](auto, auto) { called = true; });
  EXPECT_EQ(a.summary.status, Status::cancelled);
  EXPECT_FALSE(called);
}

}  // namespace
}  // namespace unseen::planes
