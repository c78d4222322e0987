// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <algorithm>

#include "interactions/scene_samples.h"
#include "unseen/core/error.h"
#include "unseen/report/interactions_recording.h"

namespace unseen::interactions::test {
namespace {

namespace fs = std::filesystem;
using report::read_recording;

void expect_error(const fs::path& folder, const std::string& what) {
  try {
    (void)read_recording(folder);
    ADD_FAILURE() << "no error: " << what;
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find(what), std::string::npos) << e.what() << "\n lacks " << what;
  }
}

/// Some part of the box's surface: equal for equal boxes however their axes are ordered.
bool same_box(const OrientedBox& a, const OrientedBox& b) {
  const auto spread = [](const OrientedBox& x) { return Mat3(x.axes * x.half_size.cwiseAbs2().asDiagonal() * x.axes.transpose()); };
  return (a.center - b.center).norm() < 1e-9 && (spread(a) - spread(b)).norm() < 1e-9;
}

TEST(RecordingRead, BringsASceneBackToItsWorld) {
  const Folder folder;
  const Recording truth = sample_recording();
  write_scene(folder, truth);
  const Recording r = read_recording(folder.path());
  EXPECT_NEAR((r.T_world_camera.rotation - truth.T_world_camera.rotation).norm(), 0, 1e-9);
  EXPECT_NEAR((r.T_world_camera.translation - truth.T_world_camera.translation).norm(), 0, 1e-9) << "the shelf on the wall does not lift the floor";
  EXPECT_EQ(r.room, "the attic");
  EXPECT_EQ(r.name, folder.path().filename().string());
  EXPECT_EQ(r.fps, 25);
  EXPECT_EQ(r.interacted, truth.interacted);
  ASSERT_EQ(r.objects.size(), truth.objects.size());
  for (std::size_t i = 0; i < r.objects.size(); ++i) {
    EXPECT_EQ(r.objects[i].id, truth.objects[i].id);
    EXPECT_EQ(r.objects[i].category, truth.objects[i].category);
    ASSERT_EQ(r.objects[i].parts.size(), truth.objects[i].parts.size());
    for (std::size_t k = 0; k < r.objects[i].parts.size(); ++k) {
      EXPECT_EQ(r.objects[i].parts[k].name, truth.objects[i].parts[k].name);
      EXPECT_TRUE(same_box(r.objects[i].parts[k].box, truth.objects[i].parts[k].box));
      EXPECT_GT(r.objects[i].parts[k].box.axes(2, 2), 0.9) << "the last axis is up";
    }
  }
}

TEST(RecordingRead, KeepsValidFramesWithTheirActions) {
  const Folder folder;
  const Recording truth = sample_recording();
  write_scene(folder, truth);
  const Recording r = read_recording(folder.path());
  ASSERT_EQ(r.people.size(), 2u);
  for (std::size_t p = 0; p < 2; ++p) {
    ASSERT_EQ(r.people[p].size(), truth.people[p].size());
    for (std::size_t f = 0; f < r.people[p].size(); ++f) {
      const RecordedFrame &found = r.people[p][f], &real = truth.people[p][f];
      EXPECT_EQ(found.frame, real.frame);
      EXPECT_NEAR((found.pose - real.pose).norm(), 0, 1e-9);
      EXPECT_EQ(found.occluded, real.occluded);
      EXPECT_EQ(found.has_action, real.has_action);
      EXPECT_TRUE(!real.has_action || found.action == real.action);
    }
  }
}

TEST(RecordingRead, WithoutObjectsTheFloorIsBelowTheFeet) {
  const Folder folder;
  Recording truth = sample_recording();
  truth.objects.clear(), truth.interacted.clear();
  truth.T_world_camera.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  write_scene(folder, truth);
  EXPECT_NEAR(read_recording(folder.path()).T_world_camera.translation.z(), 1.37, 1e-9) << "ankles are 0.1 m high";
  EXPECT_TRUE(read_recording(folder.path()).uses_known) << "nobody uses any";
  fs::remove(folder.path() / "gt/interacted.json");
  EXPECT_FALSE(read_recording(folder.path()).uses_known);
}

TEST(RecordingRead, WhatIsMissingOrWrongIsNamed) {
  const Folder empty;
  expect_error(empty.path(), "gt: found nothing");
  const Folder folder;
  write_scene(folder, sample_recording());
  const auto with = [&](const std::string& name, const std::string& text, const std::string& error) {
    const fs::path file = folder.path() / name, kept = folder.path() / "kept";
    const bool was = fs::exists(file);
    if (was) fs::rename(file, kept);
    folder.write(name, text);
    expect_error(folder.path(), error);
    fs::remove(file);
    if (was) fs::rename(kept, file);
  };
  with("gt/actions.txt", "2\tdancing\n", "line 1: found \"dancing\"");
  with("gt/actions.txt", "two walking\n", "expected a frame and an action");
  with("gt/interacted.json", "[0, 9]", "[1]: found 9, expected the id of an object");
  with("gt/skel_a_GT_objects/chair.json", "{}", "NN_label_part.json");
  with("gt/skel_a_GT_objects/00_table_top.json", box_file({}, {}).dump(), "scales");
  with("gt/skel_a_GT_objects/00_table_top.json", box_file({Vec3::Zero(), Mat3::Identity(), Vec3::Ones()}, {}).dump(), "one label an object");
  with("gt/skel_a_GT_objects/05_table_top.json", box_file({Vec3::Zero(), 2 * Mat3::Identity(), Vec3::Ones()}, {}).dump(), "axes: found");
  with("gt/skel_a_GT.json", "{\"3d\": {}}", "no frame whose pose is valid");
  with("gt/skel_a_GT.json", "{\"3d\": {\"1\": {\"16\": [0,0,0]}}}", "3d.1.16");
  with("gt/skel_a_GT.json", "{\"3d\": {\"one\": {}}}", "3d.one");
  with("gt/skel_a_GT.json", "{\"3d\": {\"1\": {\"0\": [0,0,1e300]}}}", "3d.1.0");
  with("gt/more_objects/00_table_top.json", "{}", "a second folder of objects");
}

TEST(OriginalResult, IsInTheTruthsWorld) {
  const Folder folder;
  const Recording truth = sample_recording();
  const RigidTransform T = truth.T_world_camera.inverse();
  folder.write("skel_output.json", person_file(truth.people[0], T));
  folder.write("skel_output_objects/03_couch_back.json", box_file(truth.objects[0].parts[0].box, T));
  folder.write("skel_output_objects/04_couch_seat.json", box_file(truth.objects[0].parts[2].box, T));
  folder.write("skel_output_objects/04_table_top.json", box_file(truth.objects[2].parts[1].box, T));
  const Reconstruction r = report::read_original_result(folder.path(), truth);
  ASSERT_EQ(r.people.size(), 1u);
  EXPECT_NEAR((r.people[0].frames[0].pose - truth.people[0][0].pose).norm(), 0, 1e-9);
  ASSERT_EQ(r.objects.size(), 2u) << "a back alone is no object; two labels of one number are two";
  EXPECT_TRUE(same_box(r.objects[0].object.parts[0].box, truth.objects[0].parts[2].box));
  EXPECT_NE(r.objects[0].object.id, r.objects[1].object.id);
}

}  // namespace
}  // namespace unseen::interactions::test
