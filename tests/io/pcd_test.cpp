// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <cmath>

#include "io/lzf.h"
#include "io/samples.h"

namespace unseen::io {
namespace {

TEST(Pcd, AllThreeKindsOfData) {
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    const auto source = open_points_in_memory(pcd(data), "a.pcd");
    const PointCloud cloud = read_all(*source);
    ASSERT_EQ(cloud.size(), 2u) << data;
    EXPECT_EQ(cloud.positions[0], Vec3(500000.123456789, 2, 3)) << data;
    EXPECT_TRUE(std::isnan(cloud.positions[1].y()));
    EXPECT_EQ(cloud.colors[1], (std::array<std::uint8_t, 3>{10, 20, 30})) << data;
    EXPECT_EQ(cloud.labels, (std::vector<std::int32_t>{4, 5})) << data;
    EXPECT_EQ(source->info().viewpoint, Vec3(1, 2, 3));
    expect_same(read_all(*source), read_all(*open_points_in_memory(pcd(data), "b.pcd")));
  }
}

TEST(Pcd, TheDefaultViewpointIsNone) {
  std::string s = pcd("ascii");
  s.replace(s.find("1 2 3 1 0 0 0"), 5, "0 0 0");
  EXPECT_FALSE(open_points_in_memory(s, "a.pcd")->info().viewpoint);
}

TEST(Pcd, FaultsNameFileAndField) {
  const auto bad = [](std::string s, const std::string& from, const std::string& to,
                      std::vector<std::string> parts) {
    s.replace(s.find(from), from.size(), to);
    expect_read_error(s, "bad.pcd", parts);
  };
  bad(pcd("ascii"), "POINTS 2", "POINTS 3", {"POINTS", "2 points", "the 3"});
  bad(pcd("ascii"), "POINTS 2", "POINTS 1", {"POINTS", "1", "2, as WIDTH and HEIGHT say"});
  bad(pcd("ascii"), "FIELDS x y", "FIELDS x x", {"FIELDS", "twice"});
  bad(pcd("ascii"), "VIEWPOINT 1", "VIEWPOINT nan", {"VIEWPOINT", "nan"});
  bad(pcd("ascii"), "POINTS 2", "POINTS -2", {"POINTS", "-2"});
  bad(pcd("ascii"), "POINTS 2", "POINTS 1000000000", {"POINTS", "1000000000"});
  bad(pcd("binary"), "POINTS 2", "POINTS 1000000000", {"POINTS", "2 points", "1000000000"});
  bad(pcd("ascii"), "FIELDS x", "FIELDS q", {"FIELDS", "no field x"});
  bad(pcd("ascii"), "SIZE 8", "SIZE 3", {"TYPE", "x"});
  bad(pcd("ascii"), "SIZE 8 4", "SIZE 8", {"SIZE", "4 values"});
  bad(pcd("ascii"), "TYPE F", "TYPE Q", {"TYPE", "x"});
  bad(pcd("ascii"), "COUNT 1", "COUNT 99999999999", {"COUNT", "x"});
  bad(pcd("ascii"), "DATA ascii", "DATA morse", {"DATA", "morse"});
  bad(pcd("ascii"), "DATA ascii", "", {"header"});
  bad(pcd("ascii"), "-1 nan", "-1 none", {"line 13", "field y"});
  bad(pcd("ascii"), "660510 4", "660510", {"line 12", "field label", "end of the line"});
  bad(pcd("binary_compressed"), "POINTS 2", "POINTS 3", {"DATA", "48 bytes", "3 points"});
  std::string s = pcd("binary_compressed");
  expect_read_error(s.substr(0, s.size() - 3), "bad.pcd", {"DATA", "promises"});
  s[s.size() - 9] = '\x3f';
  expect_read_error(s, "bad.pcd", {"DATA", "broken"});
  s = pcd("binary");
  expect_read_error(s.substr(0, s.size() - 1), "bad.pcd", {"POINTS", "1 point", "the 2"});
  expect_read_error("VERSION 0.7\n", "bad.pcd", {"DATA"});
}

TEST(Pcd, CompressedPointsMayTakeLessThanAByte) {  // an organised cloud of which little was seen
  const std::string head = "VERSION .7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 100\nHEIGHT 10\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 1000\nDATA binary_compressed\n";
  std::string zeros(2, '\0');  // one as it is, then copies of it: 12000 in all
  for (int i = 0; i < 45; ++i) zeros += std::string("\xe0\xff\0", 3);
  zeros += std::string("\xe0\x6e\0", 3);
  std::string s = head;
  put<std::uint32_t>(s, static_cast<std::uint32_t>(zeros.size()));
  put<std::uint32_t>(s, 12000);
  s += zeros;
  ASSERT_LT(s.size(), 1000u);
  EXPECT_EQ(read(s, "a.pcd").size(), 1000u);
}

TEST(Lzf, CopiesAndLiteralsAndNothingOutOfBounds) {
  std::string result;
  EXPECT_TRUE(lzf_decompress(std::string("\2abc\x80\2", 6), 9, result));
  EXPECT_EQ(result, "abcabcabc");
  EXPECT_TRUE(lzf_decompress(std::string("\0a\xe0\x05\0", 5), 15, result));
  EXPECT_EQ(result, std::string(15, 'a'));
  EXPECT_FALSE(lzf_decompress(std::string("\2abc\x80\3", 6), 9, result));  // from before the start
  EXPECT_FALSE(lzf_decompress(std::string("\2abc\x80", 5), 9, result));
  EXPECT_FALSE(lzf_decompress(std::string("\2ab", 3), 3, result));
  EXPECT_FALSE(lzf_decompress(std::string("\2abc", 4), 2, result));
  EXPECT_FALSE(lzf_decompress(std::string("\2abc", 4), 4000000000u, result));
}

}  // namespace
}  // namespace unseen::io
