// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "io/codecs.h"
#include "perception_scenes.h"

namespace unseen::cuboids::test {
namespace {

namespace fs = std::filesystem;

cv::Mat read_picture(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return io::codecs().decode(std::vector<char>(std::istreambuf_iterator<char>(file), {}), cv::IMREAD_UNCHANGED);
}

/// A frame of mOSD beside the project: Kinect, depth in millimetres.
RgbdFrame load(const fs::path& folder) {
  const cv::Mat depth = read_picture(folder / "depth.png"), color = read_picture(folder / "color.png");
  RgbdFrame frame;
  frame.name = folder.filename().string();
  frame.camera = {525, 525, 319.5, 239.5, depth.cols, depth.rows};
  for (int y = 0; y < depth.rows; ++y)
    for (int x = 0; x < depth.cols; ++x) {
      frame.depth.push_back(0.001f * static_cast<float>(depth.at<std::uint16_t>(y, x)));
      const cv::Vec3b c = color.at<cv::Vec3b>(y, x);
      frame.color.push_back({c[2], c[1], c[0]});
    }
  return frame;
}

void mirror(RgbdFrame& frame) {
  frame.camera.cx = frame.camera.width - 1 - frame.camera.cx;
  for (int y = 0; y < frame.camera.height; ++y) {
    std::reverse(frame.depth.begin() + y * frame.camera.width, frame.depth.begin() + (y + 1) * frame.camera.width);
    std::reverse(frame.color.begin() + y * frame.camera.width, frame.color.begin() + (y + 1) * frame.camera.width);
  }
}

/// Without its first row and column.
void crop(RgbdFrame& frame) {
  std::size_t kept = 0;
  for (std::size_t i = frame.camera.width; i < frame.depth.size(); ++i) {
    if (i % frame.camera.width == 0) continue;
    frame.depth[kept] = frame.depth[i];
    frame.color[kept++] = frame.color[i];
  }
  frame.depth.resize(kept);
  frame.color.resize(kept);
  frame.camera.width -= 1, frame.camera.height -= 1;
  frame.camera.cx -= 1.0, frame.camera.cy -= 1.0;
}

/// Each depth off by a millimetre, or not.
void shake(RgbdFrame& frame, std::uint64_t seed) {
  Random random(seed);
  for (float& depth : frame.depth)
    if (depth > 0.0f) depth += 0.001f * static_cast<float>(std::lround(random.uniform(-1.5, 1.5)));
}

const std::map<std::string, std::size_t> kParts{{"mosd_learn7", 2},  {"mosd_learn18", 3}, {"mosd_learn19", 2}, {"mosd_learn20", 2},
                                                {"mosd_learn22", 3}, {"mosd_learn29", 3}, {"mosd_test3", 2}};

class MeasuredFrames : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const auto& [name, count] : kParts)
      if (!fs::exists(data / name / "depth.png")) GTEST_SKIP() << "the shared frame " << name << " is not there";
  }
  const fs::path data = fs::path(UNSEEN_SOURCE_DIR) / "../shared/data/cuboids";
};

TEST_F(MeasuredFrames, OneBoxForEachVisiblePart) {
  for (const auto& [name, count] : kParts) {
    const Perceived p = perceive(load(data / name));
    EXPECT_EQ(p.cuboids.size(), count) << name;
    for (const Cuboid& cuboid : p.cuboids) EXPECT_GT(cuboid.box.center.z() - cuboid.box.half_size.z(), -0.002) << name;
    if (name == "mosd_learn7") {  // the carton in front: 244 × 155 mm of it face the camera
      const OrientedBox& box = nearest(p.cuboids, {-0.1, 0.6, 0.08}).box;
      EXPECT_NEAR(2.0 * box.half_size.x(), 0.244, 0.008);
      EXPECT_NEAR(2.0 * box.half_size.z(), 0.155, 0.008);
    }
  }
}

TEST_F(MeasuredFrames, AsManyBoxesMirroredCroppedAndShaken) {
  for (const auto& [name, count] : kParts) {
    const auto count_of = [&](const auto& change) {
      RgbdFrame frame = load(data / name);
      change(frame);
      return perceive(frame).cuboids.size();
    };
    EXPECT_EQ(count_of(mirror), count) << name << " mirrored";
    EXPECT_EQ(count_of(crop), count) << name << " cropped";
    for (const std::uint64_t seed : {1, 2, 3}) EXPECT_EQ(count_of([seed](RgbdFrame& frame) { shake(frame, seed); }), count) << name << " shaken " << seed;
  }
}

/// A thick book with a round back lies on a flat one and on the table, a box leans on both, and a carton stands on it.
TEST_F(MeasuredFrames, ABookThatLeansOnAnotherIsItsOwn) {
  const fs::path folder = data / "mosd_test64";
  if (!fs::exists(folder / "depth.png")) GTEST_SKIP() << "the shared frame mosd_test64 is not there";
  const std::vector<std::function<void(RgbdFrame&)>> changes = {[](RgbdFrame&) {}, mirror, [](RgbdFrame& frame) { shake(frame, 1); }, [](RgbdFrame& frame) { mirror(frame), shake(frame, 2); }};
  for (std::size_t k = 0; k < changes.size(); ++k) {
    RgbdFrame frame = load(folder);
    changes[k](frame);
    const double side = k % 2 == 0 ? 1.0 : -1.0;
    const std::vector<Cuboid> fitted = perceive(frame).fitted;
    const OrientedBox &flat = nearest(fitted, {-0.1 * side, 0.7, 0.02}).box, &leaning = nearest(fitted, {0.016 * side, 0.68, 0.05}).box;
    EXPECT_GT(flat.axes.cwiseAbs().row(2).maxCoeff(), std::cos(radians(3.0))) << k;
    EXPECT_NEAR(flat.center.z(), 0.018, 0.004) << k;
    EXPECT_NEAR(flat.half_size.minCoeff(), 0.018, 0.004) << k;
    EXPECT_NEAR(degrees(std::acos(leaning.axes.cwiseAbs().row(2).maxCoeff())), 14.5, 2.0) << k;
    std::vector<double> sizes = {2.0 * leaning.half_size.x(), 2.0 * leaning.half_size.y(), 2.0 * leaning.half_size.z()};
    std::sort(sizes.begin(), sizes.end());
    EXPECT_NEAR(sizes[2], 0.235, 0.01) << k;
    EXPECT_NEAR(sizes[1], 0.155, 0.01) << k;
    EXPECT_NEAR(sizes[0], 0.035, 0.015) << k;
  }
}

}  // namespace
}  // namespace unseen::cuboids::test
