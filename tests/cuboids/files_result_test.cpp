// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cuboids/files_sample.h"
#include "unseen/core/error.h"
#include "unseen/cuboids/options.h"
#include "unseen/report/cuboids_result.h"

namespace unseen::report {
namespace {

std::string json_of(const cuboids::Completion& c) {
  cuboids::Options options;
  return cuboids_json(c, {"frame \xff.json", std::string(64, 'a')}, cuboids::describe(options));
}

TEST(CuboidsResult, RoundTripGivesTheSameText) {
  for (const cuboids::Completion& c :
       {cuboids::sample_completion(), cuboids::sample_tower(5, 0.013), cuboids::Completion{}}) {
    const std::string text = json_of(c);
    const cuboids::Completion back = parse_cuboids_result(text, "memory");
    EXPECT_EQ(back.T_world_camera.rotation, c.T_world_camera.rotation);
    EXPECT_EQ(back.may_move, c.may_move);
    ASSERT_EQ(back.cuboids.size(), c.cuboids.size());
    for (std::size_t i = 0; i < c.cuboids.size(); ++i) {
      EXPECT_EQ(back.cuboids[i].box.axes, c.cuboids[i].box.axes);
      EXPECT_EQ(back.cuboids[i].box.half_size, c.cuboids[i].box.half_size);
      EXPECT_EQ(back.cuboids[i].initial.center, c.cuboids[i].initial.center);
      EXPECT_EQ(back.cuboids[i].mass(), c.cuboids[i].mass());
      EXPECT_EQ(back.cuboids[i].label, c.cuboids[i].label);
      EXPECT_EQ(back.cuboids[i].by_symmetry, c.cuboids[i].by_symmetry);
    }
    EXPECT_EQ(nlohmann::json::parse(json_of(back)), nlohmann::json::parse(text));
  }
}

TEST(CuboidsResult, FieldsBeyondTheContractMayBeMissing) {
  auto json = nlohmann::json::parse(json_of(cuboids::sample_completion()));
  EXPECT_EQ(json.erase("held_outside") + json.erase("may_move") + json.erase("depth_noise"), 3u);
  EXPECT_EQ(parse_cuboids_result(json.dump(), "memory").cuboids.size(), json["cuboids"].size());
}

TEST(CuboidsResult, HoldsTheContract) {
  const auto json = nlohmann::json::parse(json_of(cuboids::sample_completion()));
  EXPECT_EQ(json["capability"], "cuboids");
  EXPECT_EQ(json["supports"][1]["kind"], "wall");
  EXPECT_FALSE(json["supports"][1].contains("outline"));
  const auto& box = json["cuboids"][0];
  // A row an axis: the first axis of a box turned by 0.3 rad about z, and its whole length along it.
  EXPECT_DOUBLE_EQ(box["axes"][0][0].get<double>(), std::cos(0.3));
  EXPECT_DOUBLE_EQ(box["axes"][0][1].get<double>(), std::sin(0.3));
  EXPECT_EQ(box["size"], nlohmann::json::parse("[0.3, 0.2, 0.2]"));
  EXPECT_EQ(box["initial_size"], nlohmann::json::parse("[0.3, 0.2, 0.08]"));
  EXPECT_DOUBLE_EQ(box["mass"].get<double>(), 300.0 * 0.3 * 0.2 * 0.2);
  EXPECT_FALSE(box.contains("label"));
  EXPECT_EQ(json["cuboids"][2]["by_symmetry"], true);
  EXPECT_EQ(json["contacts"][2]["kind"], "fixed");
  EXPECT_EQ(json["T_world_camera"][3], nlohmann::json::parse("[0.0, 0.0, 0.0, 1.0]"));
  EXPECT_EQ(json["T_world_camera"][2][3], 0.7);
}

TEST(CuboidsResult, NeverWritesWhatIsNotFinite) {
  cuboids::Completion c = cuboids::sample_completion();
  c.stability.residual = std::nan("");
  EXPECT_THROW(json_of(c), std::logic_error);
}

/// Changes one value of a valid result and expects an error that names the file and `field`.
void expect_refused(const std::string& pointer, const nlohmann::json& value, const std::string& field) {
  auto json = nlohmann::json::parse(json_of(cuboids::sample_completion()));
  json[nlohmann::json::json_pointer(pointer)] = value;
  try {
    parse_cuboids_result(json.dump(), "a.json");
    ADD_FAILURE() << pointer << " took " << value;
  } catch (const InputError& e) {
    EXPECT_EQ(e.source, "a.json");
    EXPECT_EQ(e.field, field) << e.what();
  }
}

TEST(CuboidsResult, RefusesWhatContradictsItself) {
  expect_refused("/schema", 2, "schema");
  expect_refused("/capability", "planes", "capability");
  expect_refused("/T_world_camera/0/0", 2.0, "T_world_camera");
  expect_refused("/T_world_camera/3/3", 2.0, "T_world_camera[3]");
  expect_refused("/supports/1/id", 0, "supports[1].id");
  expect_refused("/supports/1/kind", "roof", "supports[1].kind");
  expect_refused("/supports/0/normal", {0, 0, 2}, "supports[0].normal");
  expect_refused("/supports/0/outline", nlohmann::json::array(), "supports[0].outline");
  expect_refused("/cuboids/1/id", 0, "cuboids[1].id");
  expect_refused("/cuboids/1/id", -1, "cuboids[1].id");
  expect_refused("/cuboids/1/axes/0", {0, 0, 1}, "cuboids[1].axes");
  expect_refused("/cuboids/1/size/2", 0, "cuboids[1].size");
  expect_refused("/cuboids/1/initial_size/2", -1, "cuboids[1].initial_size");
  expect_refused("/cuboids/1/mass", 99, "cuboids[1].mass");
  expect_refused("/contacts/0/b", 99, "contacts[0].b");
  expect_refused("/contacts/0/b", 0, "contacts[0].b");
  expect_refused("/contacts/1/b", 0, "contacts[1].b");
  expect_refused("/contacts/1/forces", {{0, 0, 1}}, "contacts[1].forces");
  expect_refused("/contacts/1/kind", "glued", "contacts[1].kind");
  expect_refused("/contacts/1/kind", "fixed", "contacts[1].forces");
  expect_refused("/contacts/1/forces/0/0", nullptr, "contacts[1].forces[0][0]");
  expect_refused("/contacts/1/direction", {0, 0, 0}, "contacts[1].direction");
  expect_refused("/stability/stable", 1, "stability.stable");
  expect_refused("/unsupported/0", 1, "unsupported[0]");
  expect_refused("/fixed_contacts", 4, "fixed_contacts");
  expect_refused("/search/nodes", -1, "search.nodes");
}

TEST(CuboidsResult, RefusesHostileText) {
  const std::string good = json_of(cuboids::sample_completion());
  for (const std::string& text :
       {std::string(), std::string("["), std::string("[]"), std::string(1 << 20, '['), good.substr(0, good.size() / 2)})
    EXPECT_THROW(parse_cuboids_result(text, "a.json"), InputError) << text.substr(0, 40);
  const auto whole = nlohmann::json::parse(good);
  for (const auto& [key, value] : whole.items()) {
    if (key == "unseen" || key == "input" || key == "options") continue;
    if (key == "held_outside" || key == "may_move" || key == "depth_noise") continue;  // beyond the contract: files of others have none
    auto json = whole;
    json.erase(key);
    EXPECT_THROW(parse_cuboids_result(json.dump(), "a.json"), InputError) << key;
  }
}

}  // namespace
}  // namespace unseen::report
