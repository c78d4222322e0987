// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <cstring>

#include "io/samples.h"

namespace unseen::io {
namespace {

namespace fs = std::filesystem;

/// The folder of real scans beside the project.
bool find_data(fs::path& data) {
  data = fs::path(UNSEEN_SOURCE_DIR) / "../shared/data/planes";
  return fs::is_directory(data);
}

TEST(RealFiles, HoldWhatTheirListSays) {
  fs::path data;
  if (!find_data(data)) GTEST_SKIP() << "no " << data << ": real files not checked";
  struct Expected {
    const char* name;
    std::size_t count;
    bool normals, colors, labels;
  };
  for (const Expected& e : {Expected{"rapter/lhouse_bu3.ply", 5035, true, false, false},
                            {"rapter/stairs_01.ply", 40000, false, false, false},
                            {"rapter/tof_stairs.ply", 40000, true, false, false},
                            {"rapter/lans_100k.ply", 100171, true, false, false},
                            {"rapter/tofRange.025.ply", 41421, true, false, false},
                            {"rapter/smooth_cube.ply", 100000, false, false, false},
                            {"cgal/building.ply", 100000, true, false, true},
                            {"cgal/urban.las", 13511, false, true, false},
                            {"cgal/cube.pwn", 50000, true, false, false},
                            {"cgal/poste_france.xyz", 9031, false, false, false},
                            {"city3d/001.ply", 57379, true, true, false},
                            {"city3d/b57.ply", 3636, true, true, false},
                            {"multiplanes/test1.ply", 40458, false, false, false},
                            {"synpeb/test_100.pcd", 10000, false, false, false}}) {
    const auto source = open_points(data / e.name);
    const PointCloud cloud = read_all(*source);
    EXPECT_EQ(cloud.size(), e.count) << e.name;
    EXPECT_EQ(!cloud.normals.empty(), e.normals) << e.name;
    EXPECT_EQ(!cloud.colors.empty(), e.colors) << e.name;
    EXPECT_EQ(!cloud.labels.empty(), e.labels) << e.name;
    for (const Vec3& p : cloud.positions) ASSERT_TRUE(p.allFinite()) << e.name;
    expect_same(read_all(*source), cloud);
  }
}

TEST(RealFiles, LasPointsFillTheBoundsOfItsHeader) {
  fs::path data;
  if (!find_data(data)) GTEST_SKIP() << "no " << data << ": real files not checked";
  const PointCloud cloud = read_all(*open_points(data / "cgal/urban.las"));
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const Vec3& p : cloud.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const std::string bytes = read_file(data / "cgal/urban.las");
  for (int k = 0; k < 3; ++k) {
    double bounds[2];
    std::memcpy(bounds, bytes.data() + 179 + 16 * k, 16);
    EXPECT_NEAR(high[k], bounds[0], 1e-6);
    EXPECT_NEAR(low[k], bounds[1], 1e-6);
  }
}

TEST(RealFiles, DepthFrames) {
  fs::path data;
  if (!find_data(data)) GTEST_SKIP() << "no " << data << ": real files not checked";
  ReadOptions options;
  options.frame_step = 50;
  const auto source = open_points(data / "redkitchen/data", options);
  const PointCloud cloud = read_all(*source);
  EXPECT_GT(cloud.size(), 5u * 200000u);
  EXPECT_TRUE(source->info().notes.empty());
  for (const Vec3& p : cloud.positions) ASSERT_LT(p.norm(), 10.0);
}

}  // namespace
}  // namespace unseen::io
