// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "unseen/report/interactions_truth.h"

namespace unseen::report {
namespace {

using namespace interactions;
using nlohmann::json;

SynthOptions options_of(int people) {
  SynthOptions options;
  options.people = people;
  options.seconds = 12;
  options.seed = 9;
  return options;
}

std::map<std::string, std::string> files_of(SynthOptions options) {
  std::map<std::string, std::string> files;
  const SynthTake synth = simulate(options);
  for (const SceneFile& f : interactions_scene_files(synth, describe(options))) EXPECT_TRUE(files.emplace(f.path, f.text).second) << f.path << " twice";
  return files;
}

Vec3 vector_of(const json& list) { return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()}; }

TEST(SynthFiles, TheSameSeedGivesTheSameBytes) {
  const auto one = files_of(options_of(2)), same = files_of(options_of(2));
  EXPECT_EQ(one, same);
  SynthOptions other = options_of(2);
  other.seed = 10;
  EXPECT_NE(one.at("take.json"), files_of(other).at("take.json"));
}

TEST(SynthFiles, KeypointsLieWhereTheTrueJointsProject) {
  SynthOptions options = options_of(1);
  options.noise = 0;
  auto files = files_of(options);
  const json take = json::parse(files.at("take.json")), truth = json::parse(files.at("gt/skel_synth-9_GT.json"));
  EXPECT_EQ(take.at("format"), "openpose");
  EXPECT_EQ(take.at("people"), 1);
  const json& camera = take.at("camera");
  // the order of the 16 joints, as names of BODY_25 places: https://github.com/CMU-Perceptual-Computing-Lab/openpose, doc/02_output.md
  const std::map<int, int> places = {{0, 11}, {1, 10}, {2, 9}, {3, 12}, {4, 13}, {5, 14}, {6, 8}, {7, 1}, {9, 0}, {10, 4}, {11, 3}, {12, 2}, {13, 5}, {14, 6}, {15, 7}};
  int compared = 0;
  for (int frame = 0; frame < 120; ++frame) {
    const json keypoints = json::parse(files.at(fmt::format("joints/{:06}_keypoints.json", frame)));
    if (keypoints.at("people").empty()) continue;
    const json& numbers = keypoints.at("people").at(0).at("pose_keypoints_2d");
    ASSERT_EQ(numbers.size(), 75u);
    for (const auto& [joint, place] : places) {
      if (numbers.at(3 * place + 2) == 0.0 || truth.at("occluded").at(std::to_string(frame)).at(joint) == 1) continue;
      const Vec3 p = vector_of(truth.at("3d").at(fmt::format("{:05}", frame)).at(std::to_string(joint)));
      EXPECT_NEAR(numbers.at(3 * place).get<double>(), camera.at("fx").get<double>() * p.x() / p.z() + camera.at("cx").get<double>(), 0.002);
      EXPECT_NEAR(numbers.at(3 * place + 1).get<double>(), camera.at("fy").get<double>() * p.y() / p.z() + camera.at("cy").get<double>(), 0.002);
      ++compared;
    }
  }
  EXPECT_GT(compared, 500);
}

TEST(SynthFiles, BoxesAreThoseOfTheTruthInCameraCoordinates) {
  SynthOptions options = options_of(1);
  const SynthTake synth = simulate(options);
  auto files = files_of(options);
  int boxes = 0;
  for (const auto& [path, text] : files) boxes += path.find("_GT_objects/") != std::string::npos;
  int parts = 0;
  for (const Object& object : synth.truth.objects)
    for (const Part& part : object.parts) {
      ++parts;
      const json box = json::parse(files.at(fmt::format("gt/skel_synth-9_GT_objects/{:02}_{}_{}.json", object.id, object.category, part.name)));
      for (int axis = 0; axis < 3; ++axis) {  // the middle of each face, by the file's columns
        Vec3 center, column;
        for (std::size_t r = 0; r < 3; ++r) {
          center[static_cast<Eigen::Index>(r)] = box.at("centroid").at(r).at(0);
          column[static_cast<Eigen::Index>(r)] = box.at("axes").at(r).at(static_cast<std::size_t>(axis));
        }
        const Vec3 face = synth.truth.T_world_camera * (center + 0.5 * box.at("scales").at(static_cast<std::size_t>(axis)).at(0).get<double>() * column);
        EXPECT_NEAR((face - part.box.center - part.box.half_size[axis] * part.box.axes.col(axis)).norm(), 0, 1e-9);
      }
    }
  EXPECT_EQ(boxes, parts);
  EXPECT_EQ(json::parse(files.at("gt/interacted.json")).get<std::vector<int>>(), synth.truth.interacted);
}

TEST(SynthFiles, EachPersonHasItsPosesAndActions) {
  SynthOptions options = options_of(3);
  const SynthTake synth = simulate(options);
  auto files = files_of(options);
  for (int p = 0; p < 3; ++p) {
    const auto& frames = synth.truth.people.at(static_cast<std::size_t>(p));
    const json skeleton = json::parse(files.at(fmt::format("gt/skel_synth-9-{}_GT.json", p)));
    EXPECT_EQ(skeleton.at("3d").size(), frames.size());
    const Vec3 head_of_last = vector_of(skeleton.at("3d").at("00119").at("9"));
    EXPECT_NEAR((synth.truth.T_world_camera * head_of_last - frames.at(119).pose.col(head)).norm(), 0, 1e-6);
    const std::string& actions = files.at(p == 0 ? "gt/actions.txt" : fmt::format("gt/actions-{}.txt", p));
    EXPECT_EQ(std::count(actions.begin(), actions.end(), '\n'), 120);
    EXPECT_EQ(actions.rfind("0\t", 0), 0u);
  }
}

TEST(SynthFiles, LiftedPosesGoWithTheKeypointsOfTheirFrame) {
  SynthOptions options = options_of(2);
  const SynthTake synth = simulate(options);
  auto files = files_of(options);
  std::size_t next = 0;
  const json lifted = json::parse(files.at("lifted.json"));
  for (const json& frame : lifted.at("frames")) {
    const json keypoints = json::parse(files.at(fmt::format("joints/{:06}_keypoints.json", frame.at("frame").get<int>())));
    ASSERT_EQ(frame.at("people").size(), keypoints.at("people").size());
    for (const json& pose : frame.at("people")) {
      ASSERT_EQ(pose.size(), 16u);
      EXPECT_NEAR((vector_of(pose.at(10)) - synth.take.detections.at(next).local->col(right_wrist)).norm(), 0, 1e-6);
      ++next;
    }
  }
  EXPECT_EQ(next, synth.take.detections.size());
  options.lifted = false;
  EXPECT_EQ(files_of(options).count("lifted.json"), 0u);
}

}  // namespace
}  // namespace unseen::report
