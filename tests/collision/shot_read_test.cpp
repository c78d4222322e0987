// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "unseen/core/error.h"
#include "unseen/report/collision_shot.h"

namespace unseen::report {
namespace {

namespace fs = std::filesystem;
using collision::Shape;
using collision::Shot;
using nlohmann::json;

/// A folder with a video's name, sightings and a mesh beside the shot file.
class ShotFile : public testing::Test {
 protected:
  ShotFile() {
    std::string pattern = (fs::temp_directory_path() / "unseen-shot-XXXXXX").string();
    folder = mkdtemp(pattern.data());
    write("v.mp4", "video");
    write("obs.json", R"([{"frame": 3, "x": 10.5, "y": 20, "radius": 4, "label": "ball"}, {"frame": 1, "x": 9, "y": 21}])");
    write("tetra.obj", "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
    good = json::parse(R"({"video": "v.mp4", "fps": 240, "camera": {"fx": 900, "fy": 910, "cx": 320, "cy": 240, "distortion": [0.1, 0, 0, 0]},
      "gravity": 9.8, "down": [0, 2, 0], "bodies": [{"name": "ball", "sphere": 0.05, "mass": 0.1}, {"name": "box", "box": [0.1, 0.2, 0.3]}],
      "roi": [1, 2, 300, 200], "frames": [5, 90], "floor": {"normal": [0, -2, 0], "offset": -3},
      "orientations": [{"body": "box", "t": 0.5, "q": [0, 1.001, 0, 0]}, {"body": "box", "frame": 60, "q": [1, 0, 0, 0]}]})");
  }
  ~ShotFile() override { fs::remove_all(folder); }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name, std::ios::binary) << text; }
  Shot read(const json& shot) const {
    write("shot.json", shot.dump());
    return read_shot(folder / "shot.json");
  }
  /// Changes one value and expects an error that names the field.
  void expect_refused(const std::string& pointer, const json& value, const std::string& field) const {
    json shot = good;
    shot[json::json_pointer(pointer)] = value;
    expect_refused(shot, field);
  }
  void expect_refused(const json& shot, const std::string& field) const {
    try {
      read(shot);
      ADD_FAILURE() << "took " << shot.dump();
    } catch (const InputError& e) {
      EXPECT_EQ(e.field, field) << e.what();
    }
  }

  fs::path folder;
  json good;
};

TEST_F(ShotFile, SaysWhatWasFilmed) {
  const Shot s = read(good);
  EXPECT_EQ(s.video, (folder / "v.mp4").string());
  EXPECT_EQ(s.fps, 240.0);
  EXPECT_EQ(s.camera.camera.fy, 910);
  EXPECT_EQ(s.camera.distortion[0], 0.1);
  EXPECT_FALSE(s.camera.assumed);
  EXPECT_EQ(*s.down, Vec3::UnitY());
  ASSERT_EQ(s.bodies.size(), 2u);
  EXPECT_EQ(s.bodies[0].radius, 0.05);
  EXPECT_EQ(s.bodies[0].mass, 0.1);
  EXPECT_EQ(s.bodies[1].box, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ((*s.roi)[2], 300);
  EXPECT_EQ((*s.frames)[1], 90);
  EXPECT_EQ(s.floor->normal, -Vec3::UnitY());
  EXPECT_EQ(s.floor->offset, -1.5);  // n·p = d divided by |n|
  ASSERT_EQ(s.orientations.size(), 2u);
  EXPECT_EQ(s.orientations[0].body, 1);
  EXPECT_DOUBLE_EQ(s.orientations[0].q.norm(), 1.0);
  EXPECT_EQ(s.orientations[1].time, 0.25);
}

TEST_F(ShotFile, WithoutACameraSixtyDegreesAreAssumed) {
  good.erase("camera");
  const Shot s = read(good);
  EXPECT_TRUE(s.camera.assumed);
  EXPECT_NEAR(*s.camera.hfov, kPi / 3, 1e-15);
  EXPECT_EQ(s.camera.camera.fx, 0.0);
  good["camera"] = {{"hfov_deg", 70}, {"assumed", true}};
  EXPECT_TRUE(read(good).camera.assumed);
  good["camera"] = {{"width", 1280}, {"height", 720}};
  EXPECT_TRUE(read(good).camera.assumed);
  EXPECT_NEAR(*read(good).camera.hfov, kPi / 3, 1e-15);
}

TEST_F(ShotFile, WhatIsFixedComesSecond) {
  good["bodies"] = json::parse(R"([{"name": "floor", "fixed": true, "normal": [0, -3, 0]}, {"name": "box", "size": 0.2}])");
  const Shot s = read(good);
  EXPECT_EQ(s.bodies[0].name, "box");
  EXPECT_EQ(s.bodies[0].shape, Shape::size);
  EXPECT_EQ(s.bodies[1].shape, Shape::fixed);
  EXPECT_EQ(*s.bodies[1].normal, -Vec3::UnitY());
  EXPECT_EQ(s.orientations[0].body, 0);
}

TEST_F(ShotFile, MeshesAreReadBesideTheFile) {
  good["bodies"][1] = {{"name", "box"}, {"mesh", "tetra.obj"}};
  const Shot s = read(good);
  EXPECT_EQ(s.bodies[1].shape, Shape::mesh);
  EXPECT_EQ(s.bodies[1].mesh.triangles.size(), 4u);
  write("tetra.obj", "v 0 0 0\nv 400 0 0\nv 0 0.1 0\nf 1 3 2\n");
  expect_refused(good, "bodies[1].mesh");  // 400 m
  write("tetra.obj", "v 0 0 0\nv 1e-9 0 0\nv 0 1e-9 0\nf 1 3 2\n");
  expect_refused(good, "bodies[1].mesh");
  write("tetra.obj", "v 0 0 0\n");
  expect_refused(good, "");  // no triangles: an error of that file
}

TEST_F(ShotFile, SightingsReplaceTheVideo) {
  good.erase("video");
  good["observations"] = "obs.json";
  const Shot s = read(good);
  EXPECT_EQ(s.video, "");
  ASSERT_EQ(s.observations.size(), 2u);
  EXPECT_EQ(s.observations[0].frame, 1);  // by frame
  EXPECT_EQ(s.observations[0].body, -1);
  EXPECT_EQ(s.observations[1].body, 0);
  EXPECT_EQ(s.observations[1].radius, 4);
  for (const char* bad : {"[]", "{}", "[1]", R"([{"frame": 1}])", R"([{"frame": -1, "x": 1, "y": 1}])", R"([{"frame": 1.5, "x": 1, "y": 1}])",
                          R"([{"frame": 1, "x": 1e9, "y": 1}])", R"([{"frame": 1, "x": null, "y": 1}])", R"([{"frame": 1, "x": 1, "y": 1, "z": 1}])",
                          R"([{"frame": 1, "x": 1, "y": 1, "label": "floor"}])", R"([{"frame": 1, "x": NaN, "y": 1}])"}) {
    write("obs.json", bad);
    EXPECT_THROW(read(good), InputError) << bad;
  }
}

TEST_F(ShotFile, ABodyIsSeenOnceAFrameAndAboutThePicture) {
  good.erase("video");
  good["observations"] = "obs.json";
  good["camera"] = {{"hfov_deg", 60}, {"width", 640}, {"height", 480}};
  const std::string twin = R"({"frame": 1, "x": 1, "y": 1, "label": "ball"})";
  for (const char* fine : {R"({"frame": 2, "x": 5, "y": 1, "label": "ball"})", R"({"frame": 1, "x": 5, "y": 1, "label": "box"})", R"({"frame": 1, "x": 5, "y": 1})",
                           R"({"frame": 1, "x": 1, "y": 1, "label": "ball"})", R"({"frame": 3, "x": -300, "y": 700})"}) {
    write("obs.json", "[" + twin + "," + fine + "]");
    EXPECT_EQ(read(good).observations.size(), 2u) << fine;
  }
  for (const char* bad : {R"({"frame": 1, "x": 5, "y": 1, "label": "ball"})", R"({"frame": 3, "x": 1000, "y": 1})", R"({"frame": 3, "x": 1, "y": -300})"}) {
    write("obs.json", "[" + twin + "," + bad + "]");
    EXPECT_THROW(read(good), InputError) << bad;
  }
}

TEST_F(ShotFile, WithoutAVideoItMustSayWhatAVideoWould) {
  good.erase("video");
  good["observations"] = "obs.json";
  json without = good;
  without.erase("fps");
  without.erase("orientations");
  expect_refused(without, "fps");
  good["camera"] = {{"hfov_deg", 60}};
  expect_refused(good, "camera");
  good["camera"] = {{"hfov_deg", 60}, {"width", 640}, {"height", 480}};
  EXPECT_EQ(read(good).camera.camera.width, 640);
  EXPECT_FALSE(read(good).camera.readout);
  good["camera"]["readout"] = -0.015;
  EXPECT_EQ(read(good).camera.readout, -0.015);
}

TEST_F(ShotFile, PlanarShotsMayHaveAScale) {
  good["gravity"] = 0;
  good["metres_per_pixel"] = 0.001;
  EXPECT_EQ(read(good).metres_per_pixel, 0.001);
  good["gravity"] = 9.81;
  expect_refused(good, "metres_per_pixel");
}

TEST_F(ShotFile, RefusesWhatCannotBe) {
  expect_refused("/vidoe", "v.mp4", "vidoe");
  expect_refused("/video", "none.mp4", "video");
  expect_refused("/video", 3, "video");
  expect_refused("/observations", "obs.json", "video");
  expect_refused("/fps", 0, "fps");
  expect_refused("/fps", "240", "fps");
  expect_refused("/gravity", 981, "gravity");
  expect_refused("/gravity", -9.81, "gravity");
  expect_refused("/down", {0, 0, 0}, "down");
  expect_refused("/down", {0, 1}, "down");
  expect_refused("/camera/fx", -900, "camera.fx");
  expect_refused("/camera/fz", 900, "camera.fz");
  expect_refused("/camera/hfov_deg", 60, "camera.fx");
  expect_refused("/camera", {{"fx", 900}}, "camera");
  expect_refused("/camera", {{"hfov_deg", 180}}, "camera.hfov_deg");
  expect_refused("/camera/width", 640, "camera");
  expect_refused("/camera/readout", "15 ms", "camera.readout");
  expect_refused("/camera/readout", 15, "camera.readout");
  expect_refused("/camera/distortion", {0.1}, "camera.distortion");
  expect_refused("/roi", {0, 0, 0, 5}, "roi");
  expect_refused("/roi", {-1, 0, 9, 5}, "roi[0]");
  expect_refused("/frames", {5, 5}, "frames");
  expect_refused("/frames", {5}, "frames");
  expect_refused("/floor/offset", 1e9, "floor.offset");
  expect_refused("/orientations/0/q", {0, 0.5, 0, 0}, "orientations[0].q");
  expect_refused("/orientations/0/q", {0, 1, 0}, "orientations[0].q");
  expect_refused("/orientations/0/body", "floor", "orientations[0].body");
  expect_refused("/orientations/0/frame", 3, "orientations[0]");
  json no_fps = good;
  no_fps.erase("fps");
  expect_refused(no_fps, "orientations[1].frame");
}

TEST_F(ShotFile, RefusesBodiesThatCannotBe) {
  expect_refused("/bodies", json::array({good["bodies"][0]}), "bodies");
  expect_refused("/bodies", json::array({good["bodies"][0], good["bodies"][1], good["bodies"][1]}), "bodies");
  expect_refused("/bodies", json::parse(R"([{"name": "a", "fixed": true}, {"name": "b", "fixed": true}])"), "bodies[1].fixed");
  expect_refused("/bodies/1/name", "ball", "bodies[1].name");
  expect_refused("/bodies/1/name", "", "bodies[1].name");
  expect_refused("/bodies/1/sphere", 0.1, "bodies[1]");
  expect_refused("/bodies/1/fixed", true, "bodies[1]");
  expect_refused("/bodies/1", {{"name", "floor"}, {"fixed", false}}, "bodies[1].fixed");
  expect_refused("/bodies/1", {{"name", "floor"}, {"fixed", true}, {"mass", 1}}, "bodies[1].mass");
  expect_refused("/bodies/1", {{"name", "thing"}}, "bodies[1]");
  expect_refused("/bodies/1/box/2", 400, "bodies[1].box[2]");
  expect_refused("/bodies/1/box/2", 1e-9, "bodies[1].box[2]");
  expect_refused("/bodies/1/box/2", nullptr, "bodies[1].box[2]");
  expect_refused("/bodies/0/sphere", -0.05, "bodies[0].sphere");
  expect_refused("/bodies/0/mass", 0, "bodies[0].mass");
  expect_refused("/bodies/0/normal", {0, 0, 1}, "bodies[0].normal");
  expect_refused("/bodies/0/color", "red", "bodies[0].color");
}

TEST_F(ShotFile, SaysThatABodyAloneNeedsSomethingToHit) {
  good["bodies"].erase(1);
  try {
    read(good);
    ADD_FAILURE();
  } catch (const InputError& e) {
    EXPECT_NE(e.expected.find("\"fixed\": true"), std::string::npos) << e.what();
  }
}

TEST_F(ShotFile, RefusesHostileText) {
  for (const std::string& text : {std::string(), std::string("["), std::string("[]"), std::string(1 << 20, '['), std::string("{\"video\": \"v.mp4\"}"),
                                  std::string("{\"gravity\": NaN}"), std::string(9 << 20, ' ')}) {
    write("shot.json", text);
    EXPECT_THROW(read_shot(folder / "shot.json"), InputError) << text.substr(0, 40);
  }
  EXPECT_THROW(read_shot(folder), InputError);
  EXPECT_THROW(read_shot(folder / "none.json"), InputError);
}

}  // namespace
}  // namespace unseen::report
