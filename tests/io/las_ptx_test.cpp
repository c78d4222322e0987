// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/samples.h"

namespace unseen::io {
namespace {

TEST(Las, EveryPointFormatKeepsUtm) {
  for (int format = 0; format <= 10; ++format)
    for (const int minor : {2, 4}) {
      const PointCloud cloud = read(las(format, minor), "a.las");
      ASSERT_EQ(cloud.size(), 2u) << format;
      EXPECT_EQ(cloud.positions[0],
                Vec3(1234567 * 1e-7 + 500000.0, -20000000 * 1e-7 + 5000000.0, 30000000 * 1e-7));
      EXPECT_TRUE(cloud.labels.empty());
      const bool colors =
          format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
      ASSERT_EQ(cloud.colors.size(), colors ? 2u : 0u) << format;
      if (colors) {
        EXPECT_EQ(cloud.colors[0], (std::array<std::uint8_t, 3>{254, 128, 0}));
      }
    }
}

TEST(Las, FaultsNameFileAndField) {
  const auto bad = [](std::size_t at, const std::string& bytes, const std::vector<std::string>& parts) {
    std::string s = las(0, 2);
    s.replace(at, bytes.size(), bytes);
    expect_read_error(s, "bad.las", parts);
  };
  bad(24, "\2", {"version", "2.2"});
  bad(104, "\x80", {"LAZ", "las2las"});
  bad(104, "\x0b", {"point format", "11"});
  bad(105, std::string("\x05\0", 2), {"point record length", "5"});
  bad(96, "\xff\xff\xff\xff", {"offset to point data"});
  bad(107, "\xff\xff\xff\x3f", {"number of points", "2 points", "1073741823"});
  bad(107, std::string(4, '\0'), {"number of points", "0"});
  bad(131, std::string(8, '\0'), {"x scale factor"});
  bad(155 + 8, std::string("\0\0\0\0\0\0\xf0\x7f", 8), {"y offset"});
  expect_read_error(las(0, 2).substr(0, 100), "bad.las", {"header", "100 bytes"});
  expect_read_error(las(3, 2).substr(0, 290), "bad.las", {"number of points", "1 point", "the 2"});
  expect_read_error("text", "bad.las", {"signature"});
  std::string laz = las(0, 2);
  laz[104] = '\x83';
  expect_read_error(laz, "cloud.laz", {"LAZ", "convert"});
  expect_read_error("ASTM-E57 and more", "scan.e57", {"E57", "CloudCompare"});
}

TEST(Las, SaysThatTheHeaderPromisesLessThanThereIs) {
  const ScratchFolder folder;
  for (const int minor : {2, 4}) {
    std::string s = las(0, minor);
    write_file(folder / "all.las", s);
    EXPECT_TRUE(open_points(folder / "all.las")->info().notes.empty());
    s[107] = '\1';
    if (minor == 4) s[247] = '\1';
    write_file(folder / "some.las", s);
    const auto source = open_points(folder / "some.las");
    ASSERT_EQ(source->info().notes.size(), 1u) << minor;
    EXPECT_EQ(source->info().notes[0], "the header promises 1 point where there is room for 2: the others are left out");
    EXPECT_EQ(read_all(*source).size(), 1u);
  }
}

TEST(Las, DegreesAreNoMetres) {
  const auto with = [](double xy_scale, double z_scale, double high_x) {
    std::string s = las(0, 2);
    const auto set = [&](std::size_t at, double value) {
      std::string bytes;
      put(bytes, value);
      s.replace(at, 8, bytes);
    };
    set(131, xy_scale), set(139, xy_scale), set(147, z_scale);
    set(179, high_x), set(187, 11.57), set(195, 48.15), set(203, 48.14);
    return s;
  };
  expect_read_error(with(1e-7, 1e-3, 11.58), "bad.las", {"x, y", "degrees", "metres"});
  EXPECT_EQ(read(with(1e-7, 1e-7, 11.58), "a.las").size(), 2u);  // a small thing, finely measured
  EXPECT_EQ(read(with(1e-7, 1e-3, 690.0), "a.las").size(), 2u);
  EXPECT_EQ(read(with(1e-3, 1e-3, 11.58), "a.las").size(), 2u);
}

TEST(Ptx, PosesColoursAndNoReturns) {
  const auto source = open_points_in_memory(ptx(), "a.ptx");
  const PointCloud cloud = read_all(*source);
  ASSERT_EQ(cloud.size(), 4u);
  EXPECT_EQ(cloud.positions[0], Vec3(10, 21, 30));  // the rows of the matrix are the images of the axes
  EXPECT_EQ(cloud.positions[1], Vec3(9, 20, 30));
  EXPECT_EQ(cloud.positions[3], Vec3(10, 22, 30));
  EXPECT_EQ(cloud.colors[0], (std::array<std::uint8_t, 3>{255, 0, 9}));
  EXPECT_EQ(source->info().viewpoint, Vec3(1, 2, 3));
  EXPECT_EQ(source->info().notes.size(), 1u);
  expect_same(read_all(*source), cloud);
  EXPECT_EQ(source->info().notes.size(), 1u);
}

TEST(Ptx, FaultsNameFileAndField) {
  const auto bad = [](const std::string& from, const std::string& to, const std::vector<std::string>& parts) {
    std::string s = ptx();
    s.replace(s.find(from), from.size(), to);
    expect_read_error(s, "bad.ptx", parts);
  };
  bad("2\n", "-2\n", {"line 1", "columns", "-2"});
  bad("2\n2\n", "2\nx\n", {"line 2", "rows"});
  bad("2\n2\n", "100000\n100000\n", {"columns and rows", "100000 x 100000"});
  bad("1 0 0\n", "1 0\n", {"line 4", "scanner"});
  bad("10 20 30 1", "10 nan 30 1", {"matrix"});
  bad("0 0 1 0\n10", "0 0 0 0\n10", {"matrix", "right angles"});
  bad("0 0 1 0\n10", "0 0.5 1 0\n10", {"matrix", "right angles"});
  bad("0 0 1 0\n10", "0 0 1 0.5\n10", {"matrix", "not 0"});
  bad("0 0 1 0\n10", "0 0 1e200 0\n10", {"matrix", "right angles"});
  bad("10 20 30 1", "10 20 30 2", {"matrix", "not 1"});
  bad("1 0 0 0.5", "1 q 0 0.5", {"line 11", "point"});
  expect_read_error(ptx().substr(0, ptx().size() - 30), "bad.ptx", {"points", "the 4 of the scan"});
}

}  // namespace
}  // namespace unseen::io
