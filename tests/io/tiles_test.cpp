// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/samples.h"

namespace unseen::io {
namespace {

TEST(Tiles, AreReadInTheOrderOfTheirNames) {
  const ScratchFolder folder;
  write_file(folder / "b.xyz", "4 5 6 0 0 1\n");
  write_file(folder / "a.xyz", "1 2 3 0 0 1\n");
  write_file(folder / "c.ply", ply_ascii());
  write_file(folder / "remarks.json", "{}");
  write_file(folder / "d.ply", "ply\n");
  write_file(folder / "e.xyz", "1 2 3\n1 2\n");
  const auto source = open_points(folder.path);
  const SourceInfo info = source->info();
  EXPECT_EQ(info.point_count, 5u);
  EXPECT_FALSE(info.has_normals);  // c has none
  std::string notes;
  for (const std::string& note : info.notes) notes += note + "\n";
  EXPECT_NE(notes.find("d.ply"), std::string::npos);
  EXPECT_NE(notes.find("e.xyz"), std::string::npos);
  EXPECT_NE(notes.find("only some tiles"), std::string::npos);
  const PointCloud cloud = read_all(*source);
  ASSERT_EQ(cloud.size(), 5u);
  EXPECT_EQ(cloud.positions[1], Vec3(4, 5, 6));
  EXPECT_TRUE(cloud.normals.empty() && cloud.labels.empty());
  EXPECT_EQ(read_all(*source).positions[1], cloud.positions[1]);
}

TEST(Tiles, ResultsOfAnEarlierRunAreNone) {
  const ScratchFolder folder;
  write_file(folder / "a.xyz", "1 2 3\n");
  write_file(folder / "points.xyz", "4 5 6\n");
  write_file(folder / ".unseen-files", "points.xyz\n");
  EXPECT_EQ(read_all(*open_points(folder.path)).size(), 2u);  // no result: something that was made to be read
  write_file(folder / ".unseen-files", "points.xyz\nresult.json\n");
  const auto source = open_points(folder.path);
  ASSERT_FALSE(source->info().notes.empty());
  EXPECT_NE(source->info().notes[0].find("points.xyz: from the result"), std::string::npos);
  EXPECT_EQ(read_all(*source).positions, std::vector<Vec3>{Vec3(1, 2, 3)});
}

TEST(Tiles, InDifferentCoordinatesAreRefused) {
  const ScratchFolder folder;
  write_file(folder / "local.xyz", "1 2 3\n4 5 6\n");
  write_file(folder / "near.xyz", "500001 2 3\n");
  EXPECT_EQ(read_all(*open_points(folder.path)).size(), 3u);
  write_file(folder / "utm.xyz", "500001 5400002 3\n500004 5400005 6\n");
  expect_error([&] { open_points(folder.path); }, {folder.path.string(), "tiles", "local.xyz and utm.xyz 5423 km apart", "same coordinates"});
}

TEST(Tiles, MeshesPicturesAndHiddenFilesAreNone) {
  const ScratchFolder folder;
  write_file(folder / "a.xyz", "1 2 3\n");
  write_file(folder / ".b.xyz", "4 5 6\n");
  write_file(folder / "c.obj", "v 1 2 3\n");
  write_file(folder / "d.png", png8({"#"}));
  const auto source = open_points(folder.path);
  EXPECT_EQ(read_all(*source).size(), 1u);
  ASSERT_FALSE(source->info().notes.empty());
  EXPECT_NE(source->info().notes[0].find("meshes and pictures are not read as tiles: c.obj and 1 more"), std::string::npos);
}

TEST(Tiles, NothingUsableIsAnError) {
  const ScratchFolder folder;
  expect_error([&] { open_points(folder.path); }, {folder.path.string(), "no point files"});
  write_file(folder / ".a.xyz", "1 2 3\n");
  write_file(folder / "b.png", png8({"#"}));
  expect_error([&] { open_points(folder.path); }, {folder.path.string(), "no point files; meshes and pictures are not read as tiles: b.png"});
  write_file(folder / "a.ply", "ply\n");
  expect_error([&] { open_points(folder.path); }, {folder.path.string(), "a.ply", "end_header"});
  expect_error([&] { open_points(folder / "absent.ply"); }, {"absent.ply", "No such file"});
}

}  // namespace
}  // namespace unseen::io
