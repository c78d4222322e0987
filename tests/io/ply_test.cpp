// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <cmath>

#include "io/samples.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

const std::string kHead = "ply\nformat ascii 1.0\n";
const std::string kXyz = "property float x\nproperty float y\nproperty float z\nend_header\n";

TEST(Ply, TextKeepsDoublesAndLabels) {
  const PointCloud cloud = read(ply_ascii(), "a.ply");
  ASSERT_EQ(cloud.size(), 3u);
  EXPECT_EQ(cloud.positions[0], Vec3(500000.123456789, 1, 2));
  EXPECT_TRUE(std::isnan(cloud.positions[2].y()));
  EXPECT_EQ(cloud.labels, (std::vector<std::int32_t>{7, 8, 9}));
}

TEST(Ply, BothByteOrdersAnyOrderOfPropertiesAndOtherElementsAround) {
  for (const bool big : {false, true}) {
    const PointCloud cloud = read(ply_binary(big), "a.ply");
    ASSERT_EQ(cloud.size(), 2u);
    EXPECT_EQ(cloud.positions[0], Vec3(500000.123456789, 2, 3));
    EXPECT_EQ(cloud.positions[1], Vec3(500000.123456789, 3, 4));
    EXPECT_EQ(cloud.normals[1], Vec3f(0, 0, 1));
    EXPECT_EQ(cloud.colors[0], (std::array<std::uint8_t, 3>{10, 20, 30}));
    EXPECT_EQ(cloud.labels, (std::vector<std::int32_t>{-5, -4}));
  }
}

TEST(Ply, ListsAmongTheVertexPropertiesAreSkipped) {
  std::string s =
      "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty list uchar int seen\n" + kXyz;
  for (int i = 0; i < 2; ++i) {
    put<std::uint8_t>(s, static_cast<std::uint8_t>(i));
    for (int k = 0; k < i; ++k) put<std::int32_t>(s, 99);
    for (int k = 0; k < 3; ++k) put<float>(s, static_cast<float>(10 * i + k));
  }
  EXPECT_EQ(read(s, "a.ply").positions[1], Vec3(10, 11, 12));
  const std::string text =
      kHead + "element vertex 1\nproperty list uchar int seen\n" + kXyz + "2 8 9 1 2 3\n";
  EXPECT_EQ(read(text, "a.ply").positions[0], Vec3(1, 2, 3));
  s.pop_back();
  expect_read_error(s, "a.ply", {"1 point", "the 2 that the header promises"});
}

TEST(Ply, EveryTypeIsRead) {
  for (const char* type :
       {"char", "uchar", "short", "ushort", "int", "uint", "float", "double", "int8", "uint16"}) {
    const std::string s = kHead + "element vertex 1\nproperty " + type +
                          " x\nproperty float y\nproperty float z\n" + "end_header\n5 6 7\n";
    EXPECT_EQ(read(s, "a.ply").positions[0], Vec3(5, 6, 7)) << type;
  }
}

TEST(Ply, WindowsAndOldMacintoshLinesAndNoLastLineEnd) {
  std::string s = kHead + "element vertex 2\n" + kXyz + "1 2 3\n4 5 6";
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    std::string text;
    for (const char c : s) c == '\n' ? text += end : text += c;
    EXPECT_EQ(read(text, "a.ply").positions[1], Vec3(4, 5, 6));
  }
}

TEST(Ply, WithoutZItIsADrawing) {
  const auto source = open_points_in_memory(
      kHead + "element vertex 1\nproperty float x\nproperty float y\nend_header\n1 2\n", "a.ply");
  EXPECT_TRUE(source->info().two_dimensional);
  EXPECT_EQ(read_all(*source).positions[0], Vec3(1, 2, 0));
}

TEST(Ply, FloatColoursAndANamedLabelField) {
  const std::string s = kHead +
                        "element vertex 1\nproperty float red\nproperty float green\nproperty float blue\n" +
                        "property float scalar_id\n" + kXyz + "0 0.5 1 3 1 2 3\n";
  ReadOptions options;
  options.label_field = "scalar_id";
  const PointCloud cloud = read(s, "a.ply", options);
  EXPECT_EQ(cloud.colors[0], (std::array<std::uint8_t, 3>{0, 128, 255}));
  EXPECT_EQ(cloud.labels[0], 3);
  options.label_field = "absent";
  expect_error([&] { read(s, "a.ply", options); }, {"a.ply", "absent"});
}

TEST(Ply, ManyBlocksAndRewindGiveTheSamePoints) {
  std::string s = kHead + "element vertex 150000\n" + kXyz;
  for (int i = 0; i < 150000; ++i) s += std::to_string(i) + " 1 2\n";
  const auto source = open_points_in_memory(s, "a.ply");
  const PointCloud whole = read_all(*source);
  ASSERT_EQ(whole.size(), 150000u);
  for (std::size_t i = 0; i < whole.size(); ++i) ASSERT_EQ(whole.positions[i].x(), static_cast<double>(i));
  PointCloud block;
  source->rewind();
  EXPECT_TRUE(source->next(block));
  EXPECT_EQ(block.size(), std::size_t{1} << 16);
  expect_same(read_all(*source), whole);
}

TEST(Ply, SaysWhereMoreFollowsThanTheHeaderPromises) {
  const auto notes = [](const std::string& s) {
    const auto source = open_points_in_memory(s, "a.ply");
    read_all(*source);
    read_all(*source);
    return source->info().notes.size();
  };
  const std::string text = kHead + "element vertex 2\n" + kXyz + "1 2 3\n4 5 6\n";
  EXPECT_EQ(notes(text), 0u);
  EXPECT_EQ(notes(text + "\n\n"), 0u);
  EXPECT_EQ(notes(text + "7 8 9\n"), 1u);
  std::string binary = "ply\nformat binary_little_endian 1.0\nelement vertex 2\n" + kXyz;
  for (int i = 0; i < 6; ++i) put<float>(binary, static_cast<float>(i));
  EXPECT_EQ(notes(binary + "\n"), 0u);
  for (int i = 0; i < 3; ++i) put<float>(binary, 0.0f);
  EXPECT_EQ(notes(binary), 1u);
}

TEST(Ply, FaultsNameFileAndField) {
  const auto bad = [](const std::string& s, const std::vector<std::string>& parts) {
    expect_read_error(s, "bad.ply", parts);
  };
  bad("", {"empty file"});
  bad("ply", {"end_header"});
  bad("hello\n", {"first line", "hello"});
  bad(kHead, {"end_header"});
  bad("ply\nelement vertex 1\n" + kXyz + "1 2 3\n", {"format"});
  bad(kHead + "element vertex 1\n" + kXyz.substr(0, kXyz.find("end_header")) + "property float x\nend_header\n1 2 3 4\n", {"property", "property float x", "one x only"});
  bad("ply\nformat ebcdic 1.0\nend_header\n", {"format", "ebcdic"});
  bad(kHead + "element vertex 0\n" + kXyz, {"element vertex", "no points"});
  bad(kHead + "element face 1\nproperty int a\nend_header\n1\n", {"element vertex", "none"});
  bad(kHead + "element vertex -4\n" + kXyz, {"element vertex", "-4"});
  bad(kHead + "element vertex 1e9\n" + kXyz, {"element vertex", "1e9"});
  bad(kHead + "element vertex 1000000000\n" + kXyz + "1 2 3\n", {"element vertex", "1", "1000000000"});
  bad(kHead + "element vertex 18446744073709551615\n" + kXyz + "1 2 3\n", {"18446744073709551615"});
  bad(kHead + "element vertex 3\n" + kXyz + "1.5 2.5 3.5\n4.5 5.5 6.5\n",
      {"element vertex", "2 points", "the 3"});
  bad(kHead + "element vertex 1\n" + kXyz + "1 two 3\n", {"line 8", "property y", "two"});
  bad(kHead + "element vertex 1\n" + kXyz + "1 2.5\n", {"line 8", "property z", "end of the line"});
  bad(kHead + "element vertex 1\n" + kXyz + "1 2 3 4\n", {"line 8", "\"4\""});
  bad(kHead + "element vertex 1\nproperty float y\nproperty float z\nend_header\n1 2\n", {"property x"});
  bad(kHead + "element vertex 1\nproperty complex x\nend_header\n1\n", {"property", "complex"});
  bad(kHead + "property float x\nend_header\n", {"property", "an element before"});
  bad(kHead + "rubbish\nend_header\n", {"header", "rubbish"});
  std::string binary = ply_binary(false);
  bad(binary.substr(0, binary.size() - 1), {"element vertex", "1 point", "the 2"});
  bad(kHead + "element vertex 1\n" + kXyz + std::string(1000000, '7') + "\n", {"line 8"});
}

TEST(Ply, ANameThatContradictsTheContentIsAnError) {
  expect_read_error(png8({"# "}), "a.ply", {"a PNG image named .ply"});
  expect_read_error(ply_ascii(), "a.las", {"a PLY file named .las"});
  EXPECT_EQ(read(ply_ascii(), "a.scan").size(), 3u);
}

}  // namespace
}  // namespace unseen::io
