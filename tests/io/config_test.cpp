// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/config.h"

#include "io/samples.h"
#include "unseen/core/error.h"
#include "unseen/io/sha256.h"

namespace unseen::io {
namespace {

struct Sample {
  bool flag = false;
  int count = 3;
  double share = 0.5;
  std::optional<double> scale;
  std::string name = "a \"b\" \\ c\n";
  std::vector<double> angles = {90};
};

OptionTable table_of(Sample& s) {
  OptionTable table;
  table.add({"flag", &s.flag, "", "a switch", {}, {}, {}});
  table.add({"count", &s.count, "", "how many", 1, 9, {}});
  table.add({"share", &s.share, "1", "", 0, 1, {}});
  table.add({"scale", &s.scale, "m", "", 1e-300, 1e300, {}});
  table.add({"name", &s.name, "", "two\nlines", 0, 0, {}});
  table.add({"angles", &s.angles, "deg", "", 1, 180, {}});
  return table;
}

TEST(Config, FlatKeysAndOwnTable) {
  const ScratchFolder folder;
  write_file(folder / "c.toml",
             "count = 5\nangles = [60, 90.5]\n[planes]\nscale = 1e-3\nflag = true\n[cuboids]\nx = 1\n");
  Sample s;
  OptionTable table = table_of(s);
  apply_config(table, folder / "c.toml", "planes");
  EXPECT_EQ(s.count, 5);
  EXPECT_EQ(s.angles, (std::vector<double>{60, 90.5}));
  EXPECT_EQ(s.scale, 1e-3);
  EXPECT_TRUE(s.flag);
}

TEST(Config, DumpReadsBack) {
  const ScratchFolder folder;
  Sample a;
  a.share = 0.1 + 0.2;
  a.flag = true;
  a.angles = {1e-0, 33.333333333333336};
  for (const auto scale : {std::optional<double>(), std::optional<double>(1.0 / 3.0)}) {
    a.scale = scale;
    write_file(folder / "c.toml", dump_config(table_of(a), "planes"));
    Sample b;
    b.name.clear();
    OptionTable table = table_of(b);
    apply_config(table, folder / "c.toml", "planes");
    EXPECT_EQ(b.share, a.share);
    EXPECT_EQ(b.scale, a.scale);
    EXPECT_EQ(b.name, a.name);
    EXPECT_EQ(b.angles, a.angles);
    EXPECT_TRUE(b.flag);
  }
}

TEST(Config, FaultsNameFileAndOption) {
  const ScratchFolder folder;
  const auto bad = [&](const std::string& text, std::vector<std::string> parts) {
    write_file(folder / "c.toml", text);
    Sample s;
    OptionTable table = table_of(s);
    parts.push_back("c.toml");
    expect_error([&] { apply_config(table, folder / "c.toml", "planes"); }, parts);
  };
  bad("scales = 1\n", {"scales", "flag, count, share"});
  bad("[planes]\nscales = 1\n", {"scales", "flag, count, share"});
  bad("[plane]\nscale = 1\n", {"[plane]", "[planes]"});
  bad("count = \"5\"\n", {"count"});
  bad("count = 2.5\n", {"count", "2.5"});
  bad("share = 2\n", {"share", "2"});
  bad("share = nan\n", {"share"});
  bad("angles = [90, \"a\"]\n", {"angles"});
  bad("share = 1979-05-27\n", {"share"});
  bad("flag = 1\n", {"flag"});
  bad("name = 1\n", {"name"});
  bad("a = = 2\n", {"line 1"});
  Sample s;
  OptionTable table = table_of(s);
  expect_error([&] { apply_config(table, folder / "none.toml", "planes"); }, {"none.toml"});
}

TEST(Sha256, OfBytesFilesAndFolders) {
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  const ScratchFolder folder;
  write_file(folder / "b", "abc");
  write_file(folder / "a", "");
  write_file(folder / ".hidden", "x");
  const Context context;
  EXPECT_EQ(sha256(folder / "b", context), sha256("abc"));
  EXPECT_EQ(sha256(folder / "a", context), sha256(""));
  EXPECT_EQ(sha256(folder.path, context), sha256(sha256("") + "  a\n" + sha256("abc") + "  b\n"));
  expect_error([&] { sha256(folder / "none", context); }, {"none"});
  Context cancelled;
  std::stop_source stop;
  stop.request_stop();
  cancelled.stop = stop.get_token();
  EXPECT_THROW(sha256(folder / "b", cancelled), Cancelled);
}

}  // namespace
}  // namespace unseen::io
