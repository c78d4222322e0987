// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/write_points.h"

#include <cmath>
#include <fstream>

#include "io/samples.h"
#include "unseen/core/error.h"
#include "unseen/io/ply_writer.h"

namespace unseen::io {
namespace {

PointCloud sample(bool all) {
  PointCloud cloud;
  for (int i = 0; i < 70000; ++i) {
    cloud.positions.emplace_back(500000.123456789 + 0.001 * i, 5200000.987654321 - i * 1e-3, std::sin(i));
    if (!all) continue;
    cloud.normals.push_back(Vec3(std::sin(i), std::cos(i), 0).cast<float>());
    cloud.colors.push_back({static_cast<std::uint8_t>(i % 256), 7, 255});
    cloud.labels.push_back(i - 9);
  }
  return cloud;
}

PointCloud there_and_back(const PointCloud& cloud, const std::string& ending, Context& context) {
  const ScratchFolder folder;
  CloudSource source(cloud);
  write_points(folder / ("out" + ending), source, context);
  return read_all(*open_points(folder / ("out" + ending)));
}

TEST(Write, EverythingComesBackFromPlyPcdAndCsv) {
  for (const bool all : {false, true})
    for (const char* ending : {".ply", ".pcd", ".csv"}) {
      Context context;
      expect_same(there_and_back(sample(all), ending, context), sample(all));
      EXPECT_EQ(context.take_warnings().size(), std::string(ending) == ".pcd" ? 1u : 0u) << ending;  // PCL takes no double coordinates
    }
}

TEST(Write, PcdIsOfSingleCoordinatesWhereThatMovesNothing) {
  const auto written = [](double coordinate) {
    PointCloud cloud;
    cloud.positions = {Vec3(coordinate, 0.1, NAN), Vec3(1, 2, 3)};
    const ScratchFolder folder;
    CloudSource source(cloud);
    Context context;
    write_points(folder / "out.pcd", source, context);
    std::ifstream file(folder / "out.pcd", std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_NE(written(80.123456789).find("SIZE 4 4 4\n"), std::string::npos);    // moved by 4 µm at most
  EXPECT_NE(written(5000000.5).find("SIZE 4 4 4\n"), std::string::npos);      // a number of single precision
  EXPECT_NE(written(5000.123456789).find("SIZE 8 8 8\n"), std::string::npos);  // moved by 0.1 mm
  Context context;
  PointCloud cloud;
  cloud.positions = {Vec3(80.123456789, -3.3, 1e-7), Vec3(1, 2, 3)};
  const PointCloud back = there_and_back(cloud, ".pcd", context);
  EXPECT_TRUE(context.take_warnings().empty());
  for (std::size_t i = 0; i < 2; ++i) EXPECT_LT((back.positions[i] - cloud.positions[i]).cwiseAbs().maxCoeff(), 1e-5);
}

TEST(Write, NotFiniteComesBack) {
  PointCloud cloud;
  cloud.positions = {Vec3(1, 2, 3), Vec3(NAN, INFINITY, 0)};
  for (const char* ending : {".ply", ".pcd", ".csv", ".xyz"}) {
    Context context;
    const PointCloud back = there_and_back(cloud, ending, context);
    ASSERT_EQ(back.size(), 2u) << ending;
    EXPECT_TRUE(std::isnan(back.positions[1].x()) && std::isinf(back.positions[1].y())) << ending;
  }
}

TEST(Write, XyzLeavesLabelsOutAndSaysSo) {
  Context context;
  PointCloud cloud = sample(true);
  const PointCloud back = there_and_back(cloud, ".xyz", context);
  EXPECT_EQ(context.take_warnings().size(), 1u);
  cloud.labels.clear();
  expect_same(back, cloud);
}

TEST(Write, LasKeepsUtmAndDropsWhatItCannotHold) {
  Context context;
  PointCloud cloud = sample(false);
  cloud.positions.emplace_back(NAN, 0, 0);
  const PointCloud back = there_and_back(cloud, ".las", context);
  EXPECT_EQ(context.take_warnings().size(), 1u);
  ASSERT_EQ(back.size(), cloud.size() - 1);
  for (std::size_t i = 0; i < back.size(); ++i)
    ASSERT_LT((back.positions[i] - cloud.positions[i]).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(Write, UnknownEndingAndUnwritablePlace) {
  Context context;
  const PointCloud cloud = sample(false);
  CloudSource source(cloud);
  const ScratchFolder folder;
  expect_error([&] { write_points(folder / "a.doc", source, context); }, {"a.doc", "ending"});
  write_file(folder / "file", "");
  expect_error([&] { write_points(folder / "file" / "a.ply", source, context); }, {"a.ply", "output"});
  std::filesystem::create_directory(folder / "b.ply");
  expect_error([&] { write_points(folder / "b.ply", source, context); }, {"b.ply", "a folder"});
}

TEST(Write, CancellingLeavesNothing) {
  const ScratchFolder folder;
  Context context;
  std::stop_source stop;
  stop.request_stop();
  context.stop = stop.get_token();
  const PointCloud cloud = sample(false);
  CloudSource source(cloud);
  EXPECT_THROW(write_points(folder / "a.ply", source, context), Cancelled);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path));
}

TEST(Write, PlyWriterCountsWhatItWasGiven) {
  const ScratchFolder folder;
  using Type = PlyColumn::Type;
  PlyWriter writer(
      folder / "p.ply",
      {{"x", Type::float64}, {"y", Type::float64}, {"z", Type::float64}, {"plane", Type::int32}});
  for (int i = 0; i < 12345; ++i) writer.add(std::vector<double>{0.1 * i, 1, 2, -1.0});
  EXPECT_THROW(writer.add(std::vector<double>{1}), InputError);
  writer.finish();
  const PointCloud cloud = read_all(*open_points(folder / "p.ply"));
  ASSERT_EQ(cloud.size(), 12345u);
  EXPECT_EQ(cloud.positions[12344].x(), 0.1 * 12344);
  EXPECT_EQ(cloud.labels[5], -1);
}

}  // namespace
}  // namespace unseen::io
