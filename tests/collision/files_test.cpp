// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "collision/sample.h"
#include "unseen/collision/options.h"
#include "unseen/core/error.h"
#include "unseen/report/collision_evaluation.h"
#include "unseen/report/collision_files.h"
#include "unseen/report/collision_result.h"
#include "unseen/report/collision_scene.h"

namespace unseen::report {
namespace {

using collision::Reconstruction;

std::string json_of(const Reconstruction& r) {
  collision::Options options;
  return collision_json(r, {"shot \xff.json", std::string(64, 'a')}, collision::describe(options));
}

TEST(CollisionResult, RoundTripGivesTheSameText) {
  Reconstruction unsolved;
  unsolved.sighted = {{3, 1, {20.5, 30}, 12}, {4, std::nullopt, {40, -1}, 0}};
  for (const Reconstruction& r : {collision::sample_two_bodies().result, collision::sample_bounces().result, Reconstruction{}, unsolved}) {
    const std::string text = json_of(r);
    const Reconstruction back = parse_collision_result(text, "memory");
    EXPECT_EQ(nlohmann::json::parse(json_of(back)), nlohmann::json::parse(text));
    ASSERT_EQ(back.frames.size(), r.frames.size());
    for (std::size_t i = 0; i < r.frames.size(); ++i)
      for (std::size_t b = 0; b < 2; ++b) {
        ASSERT_EQ(back.frames[i].bodies[b].has_value(), r.frames[i].bodies[b].has_value());
        if (!r.frames[i].bodies[b]) continue;
        EXPECT_EQ(back.frames[i].bodies[b]->p, r.frames[i].bodies[b]->p);
        EXPECT_EQ(back.frames[i].bodies[b]->q.coeffs(), r.frames[i].bodies[b]->q.coeffs());
      }
    ASSERT_EQ(back.impacts.size(), r.impacts.size());
    for (std::size_t i = 0; i < r.impacts.size(); ++i) {
      EXPECT_EQ(back.impacts[i].restitution.high, r.impacts[i].restitution.high);
      EXPECT_EQ(back.impacts[i].tangential_restitution, r.impacts[i].tangential_restitution);
      EXPECT_EQ(back.impacts[i].between, r.impacts[i].between);
    }
    EXPECT_EQ(back.residuals.size(), r.residuals.size());
    ASSERT_EQ(back.sighted.size(), r.sighted.size());
    for (std::size_t i = 0; i < r.sighted.size(); ++i) EXPECT_TRUE(back.sighted[i].body == r.sighted[i].body && back.sighted[i].center == r.sighted[i].center);
    EXPECT_EQ(back.fits, r.fits);
  }
}

TEST(CollisionResult, HoldsTheContract) {
  const auto json = nlohmann::json::parse(json_of(collision::sample_two_bodies().result));
  EXPECT_EQ(json["capability"], "collision");
  EXPECT_EQ(json["restitution"], nlohmann::json::parse(R"({"value": 0.6, "sd": 0.02, "low": 0.55, "high": 0.64})"));
  EXPECT_EQ(json["mass_ratio"]["value"], 1.25);
  EXPECT_EQ(json["fixed"], nullptr);
  EXPECT_EQ(json["impacts"][0]["between"], nlohmann::json::parse(R"(["box", "ball"])"));
  EXPECT_EQ(json["impacts"][0]["friction"], nullptr);
  EXPECT_EQ(json["impulse"], nlohmann::json::parse("[-1.5, 0, 0]"));
  EXPECT_EQ(json["collision_time"]["time"], 0.255);
  EXPECT_FALSE(json["frames"][0].contains("b"));
  EXPECT_EQ(json["frames"][3]["b"].size(), 2u);
  EXPECT_EQ(json["bodies"][1]["before"]["q"], nlohmann::json::parse("[1.0, 0.0, 0.0, 0.0]"));
  const auto bounces = nlohmann::json::parse(json_of(collision::sample_bounces().result));
  EXPECT_EQ(bounces["mass_ratio"], nullptr);
  EXPECT_EQ(bounces["fixed"], "floor");
  EXPECT_EQ(bounces["bodies"][1], nlohmann::json::parse(R"({"name": "floor", "fixed": true})"));
  EXPECT_EQ(bounces["impacts"].size(), 2u);
}

TEST(CollisionResult, NeverWritesWhatIsNotFinite) {
  Reconstruction r = collision::sample_two_bodies().result;
  r.restitution->sd = std::nan("");
  EXPECT_THROW(json_of(r), std::logic_error);
}

/// Changes one value of a valid result and expects an error that names the file and `field`.
void expect_refused(const std::string& pointer, const nlohmann::json& value, const std::string& field) {
  auto json = nlohmann::json::parse(json_of(collision::sample_bounces().result));
  json[nlohmann::json::json_pointer(pointer)] = value;
  try {
    parse_collision_result(json.dump(), "a.json");
    ADD_FAILURE() << pointer << " took " << value;
  } catch (const InputError& e) {
    EXPECT_EQ(e.source, "a.json");
    EXPECT_EQ(e.field, field) << e.what();
  }
}

TEST(CollisionResult, RefusesWhatContradictsItself) {
  expect_refused("/schema", 2, "schema");
  expect_refused("/capability", "planes", "capability");
  expect_refused("/T_world_camera/0/0", 2.0, "T_world_camera");
  expect_refused("/gravity_direction", {0, 0, 2}, "gravity_direction");
  expect_refused("/impacts/0/normal", {0, 0, 2}, "impacts[0].normal");
  expect_refused("/impacts/0/between/1", "wall", "impacts[0].between[1]");
  expect_refused("/impacts/1/restitution/low", 0.99, "impacts[1].restitution.low");
  expect_refused("/impacts/1/restitution/sd", -1, "impacts[1].restitution.sd");
  expect_refused("/impulse", {0, 0, 9}, "impulse");
  expect_refused("/contact_point", nullptr, "contact_point");
  expect_refused("/collision_time/frame", 3, "collision_time");
  expect_refused("/fixed", nullptr, "fixed");
  expect_refused("/fits", 1, "fits");
  expect_refused("/bodies/0/before/q", {1, 1, 0, 0}, "bodies[0].before.q");
  expect_refused("/bodies/0/inertia/0", -1, "bodies[0].inertia");
  expect_refused("/frames/4/frame", 0.5, "frames[4].frame");
  expect_refused("/frames/4/a/q", {1, 0, 0}, "frames[4].a.q");
  expect_refused("/residuals/0/body", "c", "residuals[0].body");
  expect_refused("/energy/after", -1, "energy.after");
  const auto sighted = [](int frame, double diameter) { return nlohmann::json{{"frame", frame}, {"body", "a"}, {"center", {1, 2}}, {"diameter", diameter}}; };
  expect_refused("/sighted", nlohmann::json::array({sighted(3, -1)}), "sighted[0].diameter");
  expect_refused("/sighted", nlohmann::json::array({sighted(3, 1), sighted(2, 1)}), "sighted[1].frame");
}

TEST(CollisionResult, RefusesHostileText) {
  const std::string good = json_of(collision::sample_two_bodies().result);
  for (const std::string& text :
       {std::string(), std::string("["), std::string("[]"), std::string(1 << 20, '['), good.substr(0, good.size() / 2)})
    EXPECT_THROW(parse_collision_result(text, "a.json"), InputError) << text.substr(0, 40);
  const auto whole = nlohmann::json::parse(good);
  for (const auto& [key, value] : whole.items()) {
    if (key == "unseen" || key == "input" || key == "options") continue;
    auto json = whole;
    json.erase(key);
    EXPECT_THROW(parse_collision_result(json.dump(), "a.json"), InputError) << key;
  }
}

TEST(CollisionFiles, AreWrittenEvenOfNothing) {
  collision::Options options;
  const OptionTable table = collision::describe(options);
  const collision::Sample s = collision::sample_two_bodies();
  for (const Reconstruction& r : {Reconstruction{}, s.result})
    for (const collision::Shot& shot : {collision::Shot{}, s.shot}) {
      EXPECT_GT(collision_scene(r, {"shot.json", ""}, table, "unseen collision", shot, {}).size(), 100u);
      EXPECT_EQ(collision_glb(shot, r).substr(0, 4), "glTF");
    }
  EXPECT_EQ(collision_title({"a/shot.json", ""}), "Collision of shot.json");
}

TEST(CollisionEvaluation, SaysWhatWasMeasured) {
  CollisionEvaluation e;
  e.scene = "boxes";
  e.scores.restitution = collision::ValueScore{0.62, 0.6, 0.02, true};
  e.scores.motions = {{"box", 61, 0.01, 0.008, 0.006, radians(1.5)}, {"ball", 58, 0.02, 0.02, 0.001, std::nullopt}};
  e.scores.true_impacts = e.scores.impacts = e.scores.found = 1;
  e.scores.time = 0.1;
  const auto json = nlohmann::json::parse(evaluation_json(e));
  EXPECT_EQ(json["capability"], "collision");
  EXPECT_EQ(json["restitution"]["covered"], true);
  EXPECT_EQ(json["mass_ratio"], nullptr);
  EXPECT_EQ(json["motions"][0]["rotation_deg"], 1.5);
  EXPECT_EQ(json["motions"][1]["rotation_deg"], nullptr);
  EXPECT_EQ(json["penetration"], nullptr);
  const std::string text = evaluation_table(e);
  for (const char* part : {"0.6200", "no value", "1.50°", "0.100 frames", "1 of 1"}) EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

}  // namespace
}  // namespace unseen::report
