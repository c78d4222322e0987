// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>

#include "io/codecs.h"
#include "unseen/core/error.h"
#include "unseen/io/write_video.h"
#include "unseen/report/collision_shot.h"
#include "unseen/report/collision_truth.h"

namespace unseen {
namespace {

using namespace collision;

struct SynthFiles : testing::Test {
  std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / (std::string("synth-") + testing::UnitTest::GetInstance()->current_test_info()->name());
  SynthOptions options;

  void SetUp() override {
    std::filesystem::create_directories(folder);
    options.video = false;
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name, std::ios::binary) << text; }

  void write_all(const SynthShot& scene) {
    write("shot.json", report::collision_shot_json(scene.shot));
    write("truth.json", report::collision_truth_json(scene.truth, describe(options)));
    write("observations.json", report::collision_sightings_json(scene.shot));
    for (const Body& b : scene.shot.bodies)
      if (b.shape == Shape::mesh) write(b.name + ".obj", report::body_obj(b));
  }
};

void expect_same(const BodyState& a, const BodyState& b) {
  EXPECT_EQ(a.p, b.p);
  EXPECT_EQ(a.v, b.v);
  EXPECT_EQ(a.k, b.k);
  EXPECT_EQ(a.q.coeffs(), b.q.coeffs());
}

TEST_F(SynthFiles, TruthAndShotComeBackToTheSameBits) {
  for (const std::string& scene : synth_scenes()) {
    SCOPED_TRACE(scene);
    options.scene = scene;
    const SynthShot made = simulate(options);
    write_all(made);
    const Truth truth = report::read_collision_truth(folder / "truth.json");
    EXPECT_EQ(truth.scene, scene);
    EXPECT_EQ(truth.T_world_camera.rotation, made.truth.T_world_camera.rotation);
    EXPECT_EQ(truth.camera.fx, made.truth.camera.fx);
    EXPECT_EQ(truth.restitution, made.truth.restitution);
    EXPECT_EQ(truth.mass_ratio, made.truth.mass_ratio);
    ASSERT_EQ(truth.impacts.size(), made.truth.impacts.size());
    for (std::size_t i = 0; i < truth.impacts.size(); ++i) {
      EXPECT_EQ(truth.impacts[i].impulse, made.truth.impacts[i].impulse);
      EXPECT_EQ(truth.impacts[i].contact_point, made.truth.impacts[i].contact_point);
      EXPECT_EQ(truth.impacts[i].time, made.truth.impacts[i].time);
      EXPECT_EQ(truth.impacts[i].between, made.truth.impacts[i].between);
    }
    ASSERT_EQ(truth.frames.size(), made.truth.frames.size());
    for (std::size_t i = 0; i < truth.frames.size(); ++i)
      for (std::size_t b = 0; b < 2; ++b) {
        ASSERT_EQ(truth.frames[i].bodies[b].has_value(), made.truth.frames[i].bodies[b].has_value());
        if (truth.frames[i].bodies[b]) expect_same(*truth.frames[i].bodies[b], *made.truth.frames[i].bodies[b]);
      }
    const Shot shot = report::read_shot(folder / "shot.json");
    ASSERT_EQ(shot.bodies.size(), 2u);
    for (std::size_t b = 0; b < 2; ++b) {
      EXPECT_EQ(shot.bodies[b].shape, made.shot.bodies[b].shape);
      EXPECT_EQ(shot.bodies[b].mesh.vertices, made.shot.bodies[b].mesh.vertices);
      EXPECT_EQ(shot.bodies[b].mass, made.shot.bodies[b].mass);
    }
    EXPECT_EQ(shot.gravity, made.shot.gravity);
    EXPECT_EQ(shot.metres_per_pixel, made.shot.metres_per_pixel);
    EXPECT_EQ(shot.floor.has_value(), made.shot.floor.has_value());
    ASSERT_EQ(shot.observations.size(), made.shot.observations.size());
    EXPECT_EQ(shot.observations.back().pixel, made.shot.observations.back().pixel);
    ASSERT_EQ(shot.orientations.size(), made.shot.orientations.size());
    for (std::size_t i = 0; i < shot.orientations.size(); ++i)
      EXPECT_LT(shot.orientations[i].q.angularDistance(made.shot.orientations[i].q), 1e-7);
  }
}

TEST_F(SynthFiles, BrokenTruthIsRefused) {
  const SynthShot made = simulate(options);
  write_all(made);
  const auto refused = [&](const std::function<void(nlohmann::json&)>& change) {
    nlohmann::json json = nlohmann::json::parse(report::collision_truth_json(made.truth, describe(options)));
    change(json);
    write("broken.json", json.dump());
    EXPECT_THROW(report::read_collision_truth(folder / "broken.json"), InputError);
  };
  refused([](auto& j) { j["capability"] = "collision"; });
  refused([](auto& j) { j["bodies"].erase(1); });
  refused([](auto& j) { j["impacts"][0]["between"][1] = "green"; });
  refused([](auto& j) { j["impacts"][0]["between"][1] = j["impacts"][0]["between"][0]; });
  refused([](auto& j) { j["impacts"][0]["normal"] = {1, 1, 0}; });
  refused([](auto& j) { j["restitution"]["sd"] = 0.1; });
  refused([](auto& j) { j["restitution"]["value"] = 1.5; });
  refused([](auto& j) { j["frames"][3]["frame"] = 2; });
  refused([](auto& j) { j["frames"][3]["a"]["q"] = {1, 1, 0, 0}; });
  refused([](auto& j) { j["frames"][3]["b"].erase("p"); });
  refused([](auto& j) { j.erase("T_world_camera"); });
  refused([](auto& j) { j["fps"] = 0; });
}

TEST_F(SynthFiles, AVideoComesBackAsItWasWritten) {
  options.width = 320;
  options.height = 180;
  options.fps = 60;
  options.video = true;
  const SynthShot scene = simulate(options);
  Context context;
  for (const char* name : {"shot.mp4", "shot.avi"}) {
    io::VideoFile file(folder / name, options.width, options.height, options.fps);
    std::vector<std::vector<std::uint8_t>> pictures;
    render(scene, options, context, [&](int, const std::vector<std::uint8_t>& bgr) {
      file.add(bgr);
      pictures.push_back(bgr);
    });
    file.close();
    const auto video = io::codecs().video_reader();
    ASSERT_TRUE(video->open((folder / name).string(), cv::CAP_FFMPEG));
    EXPECT_NEAR(video->get(cv::CAP_PROP_FPS), 60, 1e-3);
    cv::Mat frame;
    std::size_t count = 0;
    for (; video->read(frame); ++count) {
      ASSERT_LT(count, pictures.size());
      const cv::Mat exact(options.height, options.width, CV_8UC3, pictures[count].data());
      EXPECT_LT(cv::norm(frame, exact, cv::NORM_L1) / static_cast<double>(exact.total() * 3), 6) << name << " frame " << count;
    }
    EXPECT_EQ(count, pictures.size());
  }
  EXPECT_THROW(io::VideoFile(folder / "missing" / "shot.mp4", 64, 64, 30), InputError);
}

}  // namespace
}  // namespace unseen
