// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/interactions_take.h"

#include <gtest/gtest.h>

#include <cmath>

#include "interactions/take_samples.h"
#include "unseen/core/error.h"
#include "unseen/io/write_png.h"

namespace unseen::interactions::test {
namespace {

using report::read_take;

/// Where our joints must be found; of those that were made, by hand: pelvis (500, 360), thorax (500, 160), neck (500, 130).
const std::array<const char*, kJoints> kNames = {"r ankle", "r knee", "r hip", "l hip", "l knee", "l ankle", "mid hip", "neck",
                                                 "", "nose", "r wrist", "r elbow", "r shoulder", "l shoulder", "l elbow", "l wrist"};

void expect_the_person(const Detection& d, double dx = 0, double tolerance = 1e-9) {
  for (int j = 0; j < kJoints; ++j) {
    const auto at = j == neck ? std::array<double, 3>{500, 130, 0} : kPerson.at(kNames[static_cast<std::size_t>(j)]);
    EXPECT_NEAR(d.pixels(0, j), at[0] + dx, tolerance) << kJointNames[static_cast<std::size_t>(j)];
    EXPECT_NEAR(d.pixels(1, j), at[1], tolerance) << kJointNames[static_cast<std::size_t>(j)];
    const bool made = j == pelvis || j == thorax || j == neck;
    EXPECT_TRUE(made || std::abs(d.confidence[j] - at[2]) < 1e-9) << kJointNames[static_cast<std::size_t>(j)];
  }
}

bool remarked(const Take& take, const std::string& what) {
  for (const std::string& r : take.remarks)
    if (r.find(what) != std::string::npos) return true;
  return false;
}

/// The message of the InputError that reading gives.
std::string error_of(const std::filesystem::path& path) {
  try {
    (void)read_take(path);
  } catch (const InputError& e) {
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
    return e.what();
  }
  return "no error";
}

void expect_error(const std::filesystem::path& path, const std::string& what) {
  const std::string message = error_of(path);
  EXPECT_NE(message.find(what), std::string::npos) << message << "\n lacks " << what;
}

TEST(TakeRead, OpenPoseBody25HasEveryJointWhereItIs) {
  const Folder folder;
  folder.write("joints/walk_000000000012_keypoints.json", openpose_frame(Json::array({openpose_person(kBody25)})));
  const Take t = read_take(folder.write("take.json", take("openpose", "joints")));
  ASSERT_EQ(t.detections.size(), 1u);
  EXPECT_EQ(t.detections[0].frame, 12);
  EXPECT_EQ(t.detections[0].person, -1);
  expect_the_person(t.detections[0]);
  EXPECT_EQ(t.detections[0].confidence[pelvis], 0.7);
  EXPECT_EQ(t.detections[0].confidence[neck], 0.88) << "the lower of thorax and head";
  EXPECT_EQ(t.camera.fx, 1500);
  EXPECT_EQ(t.fps, 25);
  EXPECT_FALSE(t.camera_assumed);
  EXPECT_TRUE(t.remarks.empty());
}

TEST(TakeRead, OpenPoseFramesMayLieBesideTheTakeAndOtherFiles) {
  const test::Folder folder;
  for (int i = 0; i < 3; ++i) folder.write("walk_" + std::to_string(i) + "_keypoints.json", openpose_frame(Json::array({openpose_person(kBody25)})));
  folder.write("intrinsics.json", Json{{"fx", 1000}});
  folder.write("list7.json", Json::array({1, 2}));
  Json json = take("openpose", ".");
  json["people"] = 1;
  EXPECT_EQ(read_take(folder.write("take2.json", json)).detections.size(), 3u);
}

TEST(TakeRead, OpenPoseCoco18LacksThePelvisWhichIsMade) {
  const Folder folder;
  folder.write("joints/0.json", openpose_frame({openpose_person(kCoco18), openpose_person(kCoco18, 400)}));
  folder.write("joints/1.json", openpose_frame(Json::array()));
  Json json = take("openpose", "joints");
  json["people"] = 2;
  const Take t = read_take(folder.write("take.json", json));
  ASSERT_EQ(t.detections.size(), 2u);
  expect_the_person(t.detections[0]);
  expect_the_person(t.detections[1], 400);
  EXPECT_EQ(t.detections[0].confidence[pelvis], 0.69) << "the lower of the hips";
}

TEST(TakeRead, CocoKeypointsHaveEveryJointWhereItIs) {
  const Folder folder;
  folder.write("list.json", Json{coco_person(3), coco_person(4, 50)});
  folder.write("whole.json", Json{{"images", {{{"id", 3}, {"width", 1000}, {"height", 900}}}}, {"annotations", {coco_person(3), coco_person(4, 50)}}});
  for (const char* name : {"list.json", "whole.json"}) {
    const Take t = read_take(folder.write("take.json", take("coco", name)));
    ASSERT_EQ(t.detections.size(), 2u);
    EXPECT_EQ(t.detections[1].frame, 4);
    expect_the_person(t.detections[0]);
    expect_the_person(t.detections[1], 50);
    EXPECT_EQ(t.detections[0].confidence[thorax], 0.84) << "the lower of the shoulders";
    EXPECT_EQ(t.camera.width, 1920) << "the take's own size counts";
  }
}

TEST(TakeRead, CocoLabelsAreNoConfidences) {
  const Folder folder;
  Json person = coco_person(0);
  for (std::size_t i = 2; i < 51; i += 3) person["keypoints"][i] = i < 6 ? 1 : 2;
  person["image_id"] = "seq7_000042.jpg";
  folder.write("joints.json", Json{person});
  const Take t = read_take(folder.write("take.json", take("coco", "joints.json")));
  EXPECT_EQ(t.detections[0].frame, 42);
  EXPECT_LT(t.detections[0].confidence[head], 0.5) << "labelled, but not visible";
  EXPECT_EQ(t.detections[0].confidence[right_wrist], 1.0);
}

TEST(TakeRead, MediaPipeLayoutsAllSayTheSame) {
  const Folder folder;
  Json rows = Json::array();
  for (const Json& l : landmarks()) rows.push_back({l["x"], l["y"], l["z"], l["visibility"]});
  const std::vector<Json> layouts = {Json{{{"frame", 0}, {"landmarks", landmarks()}}, {{"frame", 1}, {"landmarks", landmarks()}}},
                                     {{"frames", {{{"landmarks", landmarks()}}, {{"landmarks", {landmarks()}}}}}},
                                     Json::array({landmarks(), rows}), Json::array({Json::array({landmarks()}), Json::array({rows})}),
                                     Json::array({{{"pose_landmarks", landmarks()}}, {{"pose_landmarks", landmarks()}}, nullptr, Json::array()}),
                                     Json::array({{{"landmark", landmarks()}}, {{"pose_landmarks", {{"landmark", landmarks()}}}}})};
  for (const Json& layout : layouts) {
    folder.write("joints.json", layout);
    const Take t = read_take(folder.write("take.json", take("mediapipe", "joints.json")));
    ASSERT_EQ(t.detections.size(), 2u);
    for (int f = 0; f < 2; ++f) {
      EXPECT_EQ(t.detections[static_cast<std::size_t>(f)].frame, f);
      expect_the_person(t.detections[static_cast<std::size_t>(f)], 0, 1e-6);
      EXPECT_FALSE(t.detections[static_cast<std::size_t>(f)].local);
    }
  }
}

TEST(TakeRead, MediaPipeWorldLandmarksAreRootCentredMetres) {
  const Folder folder;
  folder.write("joints.json", Json{{{"landmarks", landmarks()}, {"world_landmarks", landmarks(30, true)}}});
  const Take t = read_take(folder.write("take.json", take("mediapipe", "joints.json")));
  ASSERT_TRUE(t.detections.at(0).local);
  const Pose& p = *t.detections[0].local;
  EXPECT_NEAR(p.col(pelvis).norm(), 0, 1e-12);
  EXPECT_NEAR((p.col(right_hip) - Vec3(-0.4, 0.02, 0.005)).norm(), 0, 1e-12);
  EXPECT_NEAR((p.col(head) - Vec3(0, -2.6, -0.235)).norm(), 0, 1e-12);
}

TEST(TakeRead, I3dbDetectionsAreScaledAndMapped) {
  const Folder folder;
  Json initial = {{"3d", {{"00007", Json::object()}}}};
  for (int j = 0; j < kJoints; ++j) initial["3d"]["00007"][std::to_string(j)] = {1 + j, 2, 3};
  folder.write("skel_x_unannot.json", initial);
  for (const bool normalized : {false, true}) {
    folder.write("skel_x_2d_00.json", i3db_detections({7, 8}, normalized ? 0.8 : 0.002, normalized));
    const Take t = read_take(folder.write("take.json", take("i3db", ".")));
    ASSERT_EQ(t.detections.size(), 2u);
    for (int j = 0; j < kJoints; ++j) {
      if (j == neck) continue;
      const auto& at = kPerson.at(kNames[static_cast<std::size_t>(j)]);
      EXPECT_NEAR(t.detections[0].pixels(0, j), at[0], 1e-9);
      EXPECT_NEAR(t.detections[0].pixels(1, j), at[1], 1e-9);
    }
    EXPECT_NEAR(t.detections[0].confidence[right_knee], normalized ? 0.8 : 1 / (1 + std::exp(-0.5)), 1e-12);
    EXPECT_EQ(t.detections[0].confidence[pelvis], t.detections[0].confidence[left_hip]) << "the lower of the hips";
    ASSERT_TRUE(t.detections[0].local);
    EXPECT_FALSE(t.detections[1].local) << "no initial pose there";
    EXPECT_NEAR((t.detections[0].local->col(thorax) - Vec3(1, 0, 0)).norm(), 0, 1e-12);
  }
}

TEST(TakeRead, FramesOutOfOrderAreSortedAndRemarkedOn) {
  const Folder folder;
  folder.write("joints.json", Json{coco_person(9, 9), coco_person(2, 2), coco_person(5, 5)});
  const Take t = read_take(folder.write("take.json", take("coco", "joints.json")));
  ASSERT_EQ(t.detections.size(), 3u);
  for (const Detection& d : t.detections) expect_the_person(d, d.frame);
  EXPECT_LT(t.detections[0].frame, t.detections[1].frame);
  EXPECT_LT(t.detections[1].frame, t.detections[2].frame);
  EXPECT_TRUE(remarked(t, "out of order"));
}

TEST(TakeRead, TheSamePersonFoundTwiceIsOne) {
  const Folder folder;
  Json sure = coco_person(1, 1);
  for (std::size_t i = 2; i < 51; i += 3) sure["keypoints"][i] = 0.99;
  folder.write("joints.json", Json{coco_person(1), sure, coco_person(1, 200)});
  Json json = take("coco", "joints.json");
  json["people"] = 2;
  const Take t = read_take(folder.write("take.json", json));
  ASSERT_EQ(t.detections.size(), 2u);
  EXPECT_EQ(t.detections[0].confidence[left_knee], 0.99) << "the more confident one stays";
  EXPECT_TRUE(remarked(t, "nearly the same"));
}

TEST(TakeRead, ATrackersNamesBecomeNumbersOrNothing) {
  const Folder folder;
  Json a = coco_person(1), b = coco_person(1, 300), c = coco_person(2, 600);
  a["track_id"] = 17, b["track_id"] = 4, c["track_id"] = 99;
  folder.write("joints.json", Json{a, b});
  Json json = take("coco", "joints.json");
  json["people"] = 2;
  const Take few = read_take(folder.write("take.json", json));
  EXPECT_EQ(few.detections.at(0).person, 1);
  EXPECT_EQ(few.detections.at(1).person, 0);
  folder.write("joints.json", Json{a, b, c});
  const Take many = read_take(folder.path() / "take.json");
  for (const Detection& d : many.detections) EXPECT_EQ(d.person, -1);
  EXPECT_TRUE(remarked(many, "3 identities"));
  b["track_id"] = 17;
  folder.write("joints.json", Json{a, b});
  expect_error(folder.path() / "take.json", "person 0 twice");
}

TEST(TakeRead, AFolderIsNoTake) {
  const Folder folder;
  expect_error(folder.path(), "\"joints\" names the folder");
}

TEST(TakeRead, ACameraThatIsNotThereIsAssumed) {
  const Folder folder;
  folder.write("joints.json", Json{coco_person(1)});
  Json json = take("coco", "joints.json");
  json.erase("camera");
  const Take t = read_take(folder.write("take.json", json));
  EXPECT_TRUE(t.camera_assumed);
  EXPECT_EQ(t.camera.width, 1280) << "the smallest usual picture that holds y = 581";
  EXPECT_EQ(t.camera.height, 720);
  EXPECT_TRUE(remarked(t, "1280 x 720 is assumed"));
  EXPECT_NEAR(2 * std::atan2(640.0, t.camera.fx), kPi / 3, 1e-12);
  json["camera"] = {{"hfov_deg", 90}, {"width", 2000}, {"height", 1000}};
  const Take wide = read_take(folder.write("take.json", json));
  EXPECT_NEAR(wide.camera.fx, 1000, 1e-9);
  EXPECT_FALSE(wide.camera_assumed);
  json["camera"]["assumed"] = true;
  EXPECT_TRUE(read_take(folder.write("take.json", json)).camera_assumed);
  json["camera"] = {{"width", 1920}, {"height", 1080}};
  const Take sized = read_take(folder.write("take.json", json));
  EXPECT_TRUE(sized.camera_assumed);
  EXPECT_EQ(sized.camera.width, 1920);
  EXPECT_NEAR(2 * std::atan2(960.0, sized.camera.fx), kPi / 3, 1e-12);
  for (const double half : {0.0, 0.5}) {  // both usual ways to say where the middle is
    json["camera"] = {{"fx", 1600}, {"fy", 1600}, {"cx", 960 - half}, {"cy", 540 - half}};
    EXPECT_TRUE(remarked(read_take(folder.write("take.json", json)), "1920 x 1080 is assumed")) << half;
  }
}

TEST(TakeRead, JointsOutsideThePictureAreRemarkedOn) {
  const Folder folder;
  folder.write("joints.json", Json{coco_person(1)});
  Json json = take("coco", "joints.json");
  json["camera"]["width"] = 400, json["camera"]["cx"] = 200;
  EXPECT_TRUE(remarked(read_take(folder.write("take.json", json)), "wrong size"));
}

TEST(TakeRead, JointsOutsideThePictureInOneOfTenDetectionsAreErrors) {
  const Folder folder;
  for (const int outside : {1, 2}) {
    Json people = Json::array();
    for (int k = 0; k < 10; ++k) people.push_back(coco_person(k, k < outside ? 1600.0 : 0.0));
    folder.write("joints.json", people);
    EXPECT_EQ(remarked(read_take(folder.write("take.json", take("coco", "joints.json"))), "may be the wrong size"), outside > 1) << outside;
  }
}

TEST(TakeRead, HintsAreRead) {
  const Folder folder;
  folder.write("joints.json", Json{coco_person(1)});
  io::write_grey_png(folder.path() / "couch.png", 1920, 1080, std::vector<std::uint16_t>(1920 * 1080, 7));
  folder.write("lifted.json", Json{{"frames", {{{"frame", 1}, {"people", {std::vector<std::vector<double>>(16, {1, 2, 3})}}}}}});
  Json json = take("coco", "joints.json");
  json["up"] = {0, -2, 0};
  json["camera_height"] = 1.5;
  json["labels"] = {{{"frame", 1}, {"person", 0}, {"pixel", {500, 300}}}};
  json["masks"] = {{{"category", "couch"}, {"image", "couch.png"}}};
  json["lifted"] = "lifted.json";
  const Take t = read_take(folder.write("take.json", json));
  EXPECT_EQ(t.up.value(), Vec3(0, -1, 0));
  EXPECT_EQ(t.camera_height.value(), 1.5);
  ASSERT_EQ(t.labels.size(), 1u);
  EXPECT_EQ(t.labels[0].pixel, Vec2(500, 300));
  ASSERT_EQ(t.masks.size(), 1u);
  EXPECT_EQ(t.masks[0].inside.size(), 1920u * 1080u);
  EXPECT_NE(t.masks[0].inside[5], 0);
  ASSERT_TRUE(t.detections[0].local);
  EXPECT_EQ(t.detections[0].local->norm(), 0);
}

TEST(TakeRead, Lifted3DPosesMustBeMetres) {
  const Folder folder;
  folder.write("joints.json", Json{coco_person(1)});
  Json json = take("coco", "joints.json");
  json["lifted"] = "lifted.json";
  const auto path = folder.write("take.json", json);
  const auto write = [&](double unit) {  // somebody upright, 0.1 m from joint to joint
    Json pose = Json::array();
    for (const double height : {-0.3, -0.2, -0.1, -0.1, -0.2, -0.3, 0.0, 0.3, 0.4, 0.5, 0.0, 0.1, 0.3, 0.3, 0.1, 0.0}) pose.push_back({0.0, -height * unit, 3.0 * unit});
    folder.write("lifted.json", Json{{"frames", {{{"frame", 1}, {"people", {pose}}}}}});
  };
  write(2);
  EXPECT_NEAR(read_take(path).detections[0].local->col(head).y(), -1.0, 1e-9);
  write(2000);
  expect_error(path, "lifted.json: frames: found people 1600 m tall, expected 0.3 to 3 m");
  write(0.2);
  expect_error(path, "found people 0.16 m tall");
}

TEST(TakeRead, JointsAreNoSharesOfThePicture) {
  const Folder folder;
  const auto path = folder.write("take.json", take("coco", "joints.json"));
  Json person = coco_person(1);
  for (std::size_t i = 0; i < person["keypoints"].size(); ++i)
    if (i % 3 != 2) person["keypoints"][i] = person["keypoints"][i].get<double>() / 1000;
  folder.write("joints.json", Json{person});
  expect_error(path, "joints.json: joints: found coordinates within 0…1, expected pixels");
}

TEST(TakeRead, BadFieldsAreNamed) {
  const Folder folder;
  folder.write("joints.json", Json{coco_person(1)});
  const auto with = [&](const char* key, const Json& value) {
    Json json = take("coco", "joints.json");
    json[key] = value;
    return folder.write("take.json", json);
  };
  expect_error(with("joints", "nothing.json"), "joints: found \"nothing.json\"");
  expect_error(with("format", "alphapose"), "format: found \"alphapose\", expected openpose, coco, mediapipe or i3db");
  expect_error(with("people", 0), "people: found 0");
  expect_error(with("people", 1000), "people: found 1000");
  expect_error(with("fps", -1), "fps: found -1");
  expect_error(with("up", {0, 0, 0}), "up");
  expect_error(with("colour", 1), "colour: found an unknown field");
  expect_error(with("labels", {{{"frame", 1}, {"person", 3}, {"pixel", {1, 1}}}}), "labels[0].person: found 3");
  expect_error(with("camera", {{"fx", 1000}}), "camera");
  Json bent = camera();
  bent["distortion"] = {0.1, 0, 0, 0};
  expect_error(with("camera", bent), "camera.distortion");
  Json rolling = bent;
  rolling["distortion"] = {0, 0, 0, 0}, rolling["readout"] = 0.02;
  expect_error(with("camera", rolling), "camera.readout");
  io::write_grey_png(folder.path() / "small.png", 4, 3, std::vector<std::uint16_t>(12, 7));
  expect_error(with("masks", {{{"category", "couch"}, {"image", "small.png"}}}), "small.png: size: found 4 x 3 pixels, expected 1920 x 1080, as the take's picture has");
  expect_error(folder.path() / "none.json", "No such file");
  expect_error(folder.path(), "a folder");
}

TEST(TakeRead, BadJointsAreNamed) {
  const Folder folder;
  const auto coco = folder.write("take.json", take("coco", "joints.json"));
  Json wrong = coco_person(1);
  wrong["keypoints"].erase(50);
  folder.write("joints.json", Json{coco_person(0), wrong});
  expect_error(coco, "[1].keypoints: found an array of 50, expected 51 numbers");
  wrong = coco_person(1);
  wrong["keypoints"][7] = nullptr;
  folder.write("joints.json", Json{wrong});
  expect_error(coco, "[0].keypoints[7]: found null, expected a number");
  folder.write("joints.json", std::string("[{\"image_id\": 1, \"keypoints\": [NaN]}]"));
  expect_error(coco, "broken JSON");
  folder.write("joints.json", std::string(100'000, '['));
  expect_error(coco, "nested levels");
  folder.write("joints.json", std::string("{\"info\": {\"year\": 1}, \"annotations\": [{\"image_id\": 1, \"image_id\": 2}]}"));
  expect_error(coco, "joints.json: annotations.image_id: found twice in one object, expected once");
  folder.write("joints.json", Json::array());
  expect_error(coco, "no person in any frame");
  const auto openpose = folder.write("open.json", take("openpose", "frames"));
  std::filesystem::create_directories(folder.path() / "frames");
  expect_error(openpose, "no JSON file");
  Json person = openpose_person(kBody25);
  person["pose_keypoints_2d"].push_back(1);
  folder.write("frames/1.json", openpose_frame(Json::array({person})));
  expect_error(openpose, "people[0].pose_keypoints_2d: found an array of 76, expected 75 numbers (BODY_25) or 54 (COCO-18)");
  std::filesystem::remove(folder.path() / "frames/1.json");
  folder.write("frames/first.json", openpose_frame(Json::array({openpose_person(kBody25)})));
  expect_error(openpose, "no number below ten million in the name");
  folder.write("joints.json", Json::array({Json::array({1, 2, 3})}));
  expect_error(folder.write("media.json", take("mediapipe", "joints.json")), "[0]");
  expect_error(folder.write("i3db.json", take("i3db", ".")), "no skel_NAME_2d_00.json");
  Json frames = i3db_detections({1, 2}, 0.5, true);
  frames["3d"]["00001"].erase("9");
  folder.write("skel_a_2d_00.json", frames);
  expect_error(folder.path() / "i3db.json", "3d.00001: found an object, expected 16 joints");
}

}  // namespace
}  // namespace unseen::interactions::test
