// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/interactions_result.h"

#include <gtest/gtest.h>

#include <cmath>

#include "interactions/result_samples.h"
#include "unseen/core/error.h"
#include "unseen/report/interactions_evaluation.h"
#include "unseen/report/interactions_scene.h"

namespace unseen::interactions::test {
namespace {

using report::parse_interactions_result;

TEST(InteractionsResult, IsTheSameAfterWritingAndReading) {
  const Reconstruction a = sample_result();
  const Reconstruction b = parse_interactions_result(result_text(a), "test");
  EXPECT_EQ(result_text(b), result_text(a));
  EXPECT_EQ(b.T_world_camera.rotation, a.T_world_camera.rotation);
  EXPECT_EQ(b.camera.fy, a.camera.fy);
  EXPECT_EQ(b.camera.height, a.camera.height);
  EXPECT_EQ(b.fps, a.fps);
  EXPECT_NEAR(b.ground.pitch, a.ground.pitch, 1e-15);
  EXPECT_EQ(b.ground.source, a.ground.source);
  ASSERT_EQ(b.objects.size(), a.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    EXPECT_EQ(b.objects[i].object.id, a.objects[i].object.id);
    EXPECT_EQ(b.objects[i].confidence, a.objects[i].confidence);
    EXPECT_EQ(b.objects[i].windows, a.objects[i].windows);
    ASSERT_EQ(b.objects[i].object.parts.size(), a.objects[i].object.parts.size());
    for (std::size_t p = 0; p < a.objects[i].object.parts.size(); ++p) {
      const Part &x = a.objects[i].object.parts[p], &y = b.objects[i].object.parts[p];
      EXPECT_EQ(y.name, x.name);
      EXPECT_EQ(y.box.center, x.box.center);
      EXPECT_EQ(y.box.axes, x.box.axes);
      EXPECT_EQ(y.box.half_size, x.box.half_size);
    }
  }
  ASSERT_EQ(b.people.size(), a.people.size());
  for (std::size_t p = 0; p < a.people.size(); ++p) {
    EXPECT_EQ(b.people[p].id, a.people[p].id);
    EXPECT_EQ(b.people[p].likelihood, a.people[p].likelihood);
    ASSERT_EQ(b.people[p].frames.size(), a.people[p].frames.size());
    for (std::size_t f = 0; f < a.people[p].frames.size(); ++f) {
      const PersonFrame &x = a.people[p].frames[f], &y = b.people[p].frames[f];
      EXPECT_EQ(y.frame, x.frame);
      EXPECT_EQ(y.pose, x.pose);
      EXPECT_EQ(y.source, x.source);
      EXPECT_EQ(y.action, x.action);
      EXPECT_TRUE((y.confidence == x.confidence).all());
    }
  }
  ASSERT_EQ(b.windows.size(), a.windows.size());
  EXPECT_EQ(b.windows[1].scenelet, a.windows[1].scenelet);
  EXPECT_EQ(b.windows[1].placement.angle, a.windows[1].placement.angle);
  EXPECT_EQ(b.evidence.columns, a.evidence.columns);
  EXPECT_TRUE(b.evidence.probability.empty()) << "the map is a file of its own";
  EXPECT_EQ(b.summary.warnings, a.summary.warnings);
}

TEST(InteractionsResult, TheBoxAroundAnObjectHoldsItsParts) {
  const Mat3 turned = Eigen::AngleAxisd(0.5, Vec3::UnitZ()).toRotationMatrix();
  const Object chair = {0, "chair", {{"back", {turned * Vec3(0, 0.3, 0.75) + Vec3(2, 3, 0), turned, Vec3(0.25, 0.05, 0.25)}},
                                     {"seat", {turned * Vec3(0, 0, 0.45) + Vec3(2, 3, 0), turned, Vec3(0.25, 0.25, 0.05)}}}};
  const OrientedBox box = report::upright_box(chair);
  EXPECT_NEAR((box.half_size - Vec3(0.25, 0.3, 0.3)).norm(), 0, 1e-12);
  EXPECT_NEAR((box.center - (turned * Vec3(0, 0.05, 0.7) + Vec3(2, 3, 0))).norm(), 0, 1e-12);
  EXPECT_NEAR((box.axes - turned).norm(), 0, 1e-12);
}

TEST(InteractionsResult, WhatDoesNotFitTogetherIsNamed) {
  const Json good = Json::parse(result_text(sample_result()));
  const auto expect_error = [&](const char* pointer, const Json& value, const std::string& error) {
    Json json = good;
    json[Json::json_pointer(pointer)] = value;
    try {
      (void)parse_interactions_result(json.dump(), "test");
      ADD_FAILURE() << pointer;
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(error), std::string::npos) << e.what();
    }
  };
  expect_error("/capability", "planes", "capability: found \"planes\"");
  expect_error("/objects/1/id", good["objects"][0]["id"], "objects[1].id");
  expect_error("/objects/0/windows", {0, 7}, "objects[0].windows[1]: found 7, expected an index below 2");
  expect_error("/objects/0/superclass", "shelf", "objects[0].superclass");
  expect_error("/objects/0/center/0", 77, "objects[0].center");
  expect_error("/objects/0/yaw", 1.0, "objects[0].yaw");
  expect_error("/objects/0/parts/0/axes/0/0", 0.5, "objects[0].parts[0].axes");
  expect_error("/objects/0/confidence", 1.5, "objects[0].confidence");
  expect_error("/people/0/frames/2/frame", 0, "people[0].frames[2].frame");
  expect_error("/people/0/frames/0/action", "dancing", "people[0].frames[0].action: found \"dancing\", expected one of standing, walking");
  expect_error("/people/0/frames/0/joints/3", Json::array({1, 2}), "people[0].frames[0].joints[3]");
  expect_error("/people/1/likelihood", Json::array(), "people[1].likelihood");
  expect_error("/windows/0/last", 0, "windows[0].last");
  expect_error("/T_world_camera/0/0", 2, "T_world_camera");
}

TEST(InteractionsEvaluation, JsonAndTableSayTheSame) {
  report::InteractionsEvaluation e;
  e.scene = "attic";
  e.scores.interacted = 3, e.scores.found = 2, e.scores.false_objects = 4;
  e.scores.mean_distance = 0.517;
  e.scores.objects = {{3, 1, "chair", Superclass::sit, true, 0.517}, {4, -1, "shelf", Superclass::shelf, true, {}}, {-1, 9, "table", Superclass::table, false, {}}};
  e.scores.occluded = PoseScore{81, 12, 0.19, 0.0794};
  e.scores.confusion = {{1, 2, 3, 4}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 55}};
  const Json json = Json::parse(report::evaluation_json(e));
  EXPECT_EQ(json["found"], 2);
  EXPECT_EQ(json["false_objects"], 4);
  EXPECT_EQ(json["distance"]["mean"], 0.517);
  EXPECT_TRUE(json["distance"]["sd"].is_null());
  EXPECT_TRUE(json["objects"][1]["found"].is_null());
  EXPECT_EQ(json["poses"]["occluded"]["world"], 0.0794);
  EXPECT_TRUE(json["poses"]["all"].is_null());
  const std::string table = report::evaluation_table(e);
  for (const char* text : {"2 of 3", "51.7 cm", "chair 3 (found 1)", "table (found 9)", "not found", "0.079", "19.0 cm", "12 frames", "55"})
    EXPECT_NE(table.find(text), std::string::npos) << text << "\n" << table;
}

TEST(Takes, OfARecordAreThoseItLists) {
  EXPECT_EQ(report::takes_of({"take.json", ""}), std::vector<std::string>{"take.json"});
  EXPECT_EQ(report::interactions_title({"lounge/take.json, hall.json", ""}), "Interactions of lounge, hall.json");
  std::string many;  // longer than any path may be
  for (int i = 0; i < 400; ++i) many += (i > 0 ? ", " : "") + std::string("a-room/take-of-it.json");
  EXPECT_EQ(report::takes_of({many, ""}).size(), 400u);
}

}  // namespace
}  // namespace unseen::interactions::test
