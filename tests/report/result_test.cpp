// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/planes_result.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "report/sample.h"
#include "unseen/core/error.h"
#include "unseen/planes/options.h"

namespace unseen::report {
namespace {

std::string json_of(const planes::Arrangement& a) {
  planes::Options options;
  options.relative_scale = 0.1;
  return planes_json(a, {"scan \xff.ply", std::string(64, 'a')}, planes::describe(options));
}

TEST(PlanesResult, RoundTripGivesTheSameText) {
  for (const planes::Arrangement& a : {sample_room(), sample_room({500000.125, 5400000.1, 1.0 / 3.0}),
                                       sample_drawing(), planes::Arrangement{}}) {
    const std::string text = json_of(a);
    const planes::Arrangement back = parse_planes_result(text, "memory");
    EXPECT_EQ(back.two_dimensional, a.two_dimensional);
    ASSERT_EQ(back.planes.size(), a.planes.size());
    for (std::size_t p = 0; p < a.planes.size(); ++p) {
      EXPECT_EQ(back.planes[p].plane.normal, a.planes[p].plane.normal);
      EXPECT_EQ(back.planes[p].plane.offset, a.planes[p].plane.offset);
      EXPECT_EQ(back.planes[p].polygon, a.planes[p].polygon);
      EXPECT_EQ(back.planes[p].segment, a.planes[p].segment);
      EXPECT_EQ(back.planes[p].tag, a.planes[p].tag);
    }
    for (std::size_t i = 0; i < a.angles.size(); ++i) EXPECT_DOUBLE_EQ(back.angles[i], a.angles[i]);
    const auto before = nlohmann::json::parse(text), after = nlohmann::json::parse(json_of(back));
    EXPECT_EQ(before, after) << nlohmann::json::diff(before, after).dump();
  }
}

TEST(PlanesResult, HoldsTheContract) {
  const auto json = nlohmann::json::parse(json_of(sample_room()));
  EXPECT_EQ(json["schema"], 1);
  EXPECT_EQ(json["capability"], "planes");
  EXPECT_EQ(json["angles_deg"], nlohmann::json::parse("[60.0, 90.0]"));
  EXPECT_EQ(json["relations"][3]["angle_deg"], 60.0);
  EXPECT_EQ(json["options"]["relative_scale"], 0.1);
  EXPECT_TRUE(json["options"]["scale"].is_null());
  EXPECT_EQ(json["options"]["angles"], nlohmann::json::parse("[90.0]"));
  EXPECT_EQ(json["planes"][0]["tag"], "floor");
  EXPECT_TRUE(json["planes"][3]["tag"].is_null());
  EXPECT_EQ(json["planes"][0]["polygon"].size(), 2u);
  EXPECT_FALSE(json["planes"][0].contains("segment"));
  EXPECT_EQ(json["summary"], nlohmann::json::parse(summary_json(sample_room().summary)));
  EXPECT_EQ(nlohmann::json::parse(json_of(sample_drawing()))["planes"][1]["segment"][0],
            nlohmann::json::parse("[-1.0, 0.5, 0.0]"));
}

TEST(PlanesResult, NeverWritesWhatIsNotFinite) {
  planes::Arrangement a = sample_room();
  a.planes[2].rms = std::nan("");
  EXPECT_THROW(json_of(a), std::logic_error);
}

/// Changes one value of a valid result and expects an error that names the file and `field`.
void expect_refused(const std::string& pointer, const nlohmann::json& value, const std::string& field) {
  auto json = nlohmann::json::parse(json_of(sample_room()));
  json[nlohmann::json::json_pointer(pointer)] = value;
  try {
    parse_planes_result(json.dump(), "a.json");
    ADD_FAILURE() << pointer << " took " << value;
  } catch (const InputError& e) {
    EXPECT_EQ(e.source, "a.json");
    EXPECT_EQ(e.field, field) << e.what();
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
  }
}

TEST(PlanesResult, RefusesWhatContradictsItself) {
  expect_refused("/schema", 2, "schema");
  expect_refused("/capability", "cuboids", "capability");
  expect_refused("/dimensions", 4, "dimensions");
  expect_refused("/scale", "0.05", "scale");
  expect_refused("/scale", -1, "scale");
  expect_refused("/planes", {{"id", 0}}, "planes");
  expect_refused("/planes/1/id", 7, "planes[1].id");
  expect_refused("/planes/1/normal", {1.0, 0.0}, "planes[1].normal");
  expect_refused("/planes/1/normal", {2.0, 0.0, 0.0}, "planes[1].normal");
  expect_refused("/planes/1/normal", {0.0, 1.0, 0.0}, "planes[1].normal");
  expect_refused("/planes/1/direction", -1, "planes[1].direction");
  expect_refused("/planes/1/direction", 4, "planes[1].direction");
  expect_refused("/planes/1/direction", 1e300, "planes[1].direction");
  expect_refused("/planes/1/frame", 1, "planes[1].frame");
  expect_refused("/planes/1/polygon/0/2/1", nullptr, "planes[1].polygon[0][2][1]");
  expect_refused("/planes/1/polygon/0", {{0, 0, 0}, {1, 0, 0}}, "planes[1].polygon[0]");
  expect_refused("/directions/2/frame", 2, "directions[2].frame");
  expect_refused("/frames/1/planes", {0}, "frames[1].planes");
  expect_refused("/relations/0/b", 0, "relations[0].b");
  expect_refused("/relations/0/angle_deg", 91, "relations[0].angle_deg");
  expect_refused("/coplanar/0/0", 5, "coplanar[0][0]");
  expect_refused("/summary/status", "great", "summary.status");
  expect_refused("/summary/counts/points", -3, "summary.counts.points");
}

TEST(PlanesResult, RefusesHostileText) {
  const std::string good = json_of(sample_room());
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("[]"), std::string("null"),
        std::string("\x89PNG\r\n\x1a\n\0", 9), std::string(1 << 20, '['), good.substr(0, good.size() / 2),
        good + "x", std::string("{\"schema\": 1e999}"), std::string("{\"schema\": NaN}")})
    EXPECT_THROW(parse_planes_result(text, "a.json"), InputError) << text.substr(0, 40);
  const auto whole = nlohmann::json::parse(good);
  for (const auto& [key, value] : whole.items()) {
    if (key == "unseen" || key == "input" || key == "options") continue;
    auto json = whole;
    json.erase(key);
    EXPECT_THROW(parse_planes_result(json.dump(), "a.json"), InputError) << key;
  }
  EXPECT_THROW(read_planes_result("no-such-file.json"), InputError);
  EXPECT_THROW(read_planes_result("/"), InputError);
}

}  // namespace
}  // namespace unseen::report
