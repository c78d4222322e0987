// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/core/options.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/shortened.h"
#include "unseen/core/error.h"

namespace unseen {
namespace {

struct Sample {
  bool flag = false;
  int count = 3;
  double share = 0.5;
  std::optional<double> scale;
  std::string solver = "local";
  std::vector<double> angles = {90};
  std::vector<double> range = {0, 1};
};

TEST(Shortened, CutsNoCharacterInTwo) {
  EXPECT_EQ(shortened("abc", 3), "abc");
  EXPECT_EQ(shortened("abcd", 3), "abc…");
  EXPECT_EQ(shortened("aüü", 2), "a…");
  EXPECT_EQ(shortened("aüü", 3), "aü…");
  EXPECT_EQ(shortened("𝄞", 3), "…");
  std::string word;
  for (int i = 0; i < 400; ++i) word += "ü";
  const std::string message = InputError("a", "", word, "").what();  // 9 bytes before the first ü: one lies across the 300th
  EXPECT_EQ(message.size(), 299 + std::string("…").size());
}

OptionTable table_of(Sample& s) {
  OptionTable table;
  table.add({"flag", &s.flag, "", "", {}, {}, {}});
  table.add({"count", &s.count, "", "", 1, 9, {}});
  table.add({"share", &s.share, "1", "", 0, 1, {}});
  table.add({"scale", &s.scale, "m", "", 1e-300, 1e300, {}});
  table.add({"solver", &s.solver, "", "", 0, 0, {"local", "exact"}});
  table.add({"angles", &s.angles, "deg", "", 1, 180, {}});
  table.add({"range", &s.range, "m", "", 0, 9, {}, {"near", "far"}, true});
  return table;
}

OptionTable describe(Sample& s) { return table_of(s); }

TEST(Options, ValuesSetInCodeMeetTheSameLimits) {
  EXPECT_NO_THROW(check_options(Sample{}));
  EXPECT_NO_THROW(check_options(Sample{.count = 9, .scale = 0.1 + 0.2, .angles = {}}));
  for (const Sample& bad : {Sample{.count = 10}, Sample{.share = std::nan("")}, Sample{.scale = 0.0}, Sample{.solver = ""}, Sample{.solver = "best"},
                            Sample{.angles = {90, 181}}, Sample{.range = {1}}, Sample{.range = {2, 1}}})
    EXPECT_THROW(check_options(bad), InputError);
}

TEST(Options, TextSetsEveryKind) {
  Sample s;
  OptionTable table = table_of(s);
  for (const auto& [name, text] : {std::pair{"flag", "true"}, {"count", "7"}, {"share", "0.25"}, {"scale", "1e-3"},
                                   {"solver", "exact"}, {"angles", "60,90"}, {"range", "1,2"}})
    table.set_text(name, text, "command line");
  EXPECT_TRUE(s.flag);
  EXPECT_EQ(s.count, 7);
  EXPECT_EQ(s.share, 0.25);
  EXPECT_EQ(s.scale, 1e-3);
  EXPECT_EQ(s.solver, "exact");
  EXPECT_EQ(s.angles, (std::vector<double>{60, 90}));
  EXPECT_EQ(s.range, (std::vector<double>{1, 2}));
}

TEST(Options, BadValuesNameSourceOptionAndRange) {
  Sample s;
  OptionTable table = table_of(s);
  for (const auto& [name, text] : {std::pair{"count", "2.5"}, {"count", "10"}, {"share", "nan"}, {"share", "half"},
                                   {"scale", "0"}, {"solver", "magic"}, {"angles", "60,"}, {"flag", "maybe"},
                                   {"range", "1"}, {"range", "1,2,3"}, {"range", "2,1"}, {"range", "1,1"}}) {
    try {
      table.set_text(name, text, "a.toml");
      ADD_FAILURE() << name << " took " << text;
    } catch (const InputError& e) {
      EXPECT_EQ(e.source, "a.toml");
      EXPECT_EQ(e.field, name);
      EXPECT_FALSE(e.expected.empty());
    }
  }
}

TEST(Options, UnknownNameListsTheKnownOnes) {
  Sample s;
  OptionTable table = table_of(s);
  try {
    table.set_text("scales", "1", "command line");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("flag, count, share, scale, solver, angles"), std::string::npos);
  }
}

TEST(Options, RangesReadWell) {
  constexpr double kTiny = std::numeric_limits<double>::min();
  double d = 1;
  EXPECT_EQ((Option{"d", &d, "", "", kTiny, 2, {}}.range()), "above 0, at most 2");
  EXPECT_EQ((Option{"d", &d, "", "", kTiny, std::numeric_limits<double>::infinity(), {}}.range()), "above 0");
  EXPECT_EQ((Option{"d", &d, "", "", 0, 1, {}}.range()), "0…1");
}

}  // namespace
}  // namespace unseen
