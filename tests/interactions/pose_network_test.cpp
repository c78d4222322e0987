// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// A network whose output is known: it tells dots by their colours.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <opencv2/imgproc.hpp>

#include "interactions/little_onnx.h"
#include "io/codecs.h"
#include "unseen/core/error.h"
#include "unseen/report/pose_network.h"

namespace unseen::report {
namespace {

using namespace interactions;
namespace fs = std::filesystem;

constexpr int kWidth = 480, kHeight = 240;

/// Blue, green, red of a label: 26 directions of equal length, so that each has its largest product with itself.
std::array<float, 3> color(int label) {
  const double up = 0.05 + 0.9 * (label + 0.5) / 26.0, around = 0.05 + 1.47 * std::fmod(label * 0.618, 1.0), level = std::sqrt(1.0 - up * up);
  return {static_cast<float>(level * std::cos(around)), static_cast<float>(level * std::sin(around)), static_cast<float>(up)};
}

/// Where joint j is in a frame; no two dots touch.
Vec2 place(int j, int frame) {
  return {40.0 + 50.0 * (j % 8) + 3.0 * frame, 50.0 + 110.0 * (j / 8) + 2.5 * frame};
}

class PoseNetwork : public testing::Test {
 protected:
  PoseNetwork() { fs::create_directories(folder_); }
  ~PoseNetwork() override { fs::remove_all(folder_); }
  fs::path file(const std::string& name) const { return folder_ / name; }

  /// Dots without loss; joint j has the colour of label `labels[j]`, −1 = no dot.
  fs::path video(const std::array<int, kJoints>& labels, int frames = 4) const {
    const auto writer = io::codecs().video_writer(file("dots.avi").string(), io::fourcc('F', 'F', 'V', '1'), 12.5, {kWidth, kHeight});
    for (int f = 0; f < frames; ++f) {
      cv::Mat frame(kHeight, kWidth, CV_8UC3, cv::Scalar::all(0));
      for (int j = 0; j < kJoints; ++j) {
        if (labels[static_cast<std::size_t>(j)] < 0) continue;
        const auto c = color(labels[static_cast<std::size_t>(j)]);
        const Vec2 p = place(j, f);
        for (int radius = 7; radius > 0; --radius) {  // brightest in the middle
          const double light = 255 * (1.0 - 0.004 * (radius - 1));
          cv::circle(frame, {static_cast<int>(std::lround(16 * p.x())), static_cast<int>(std::lround(16 * p.y()))}, 16 * radius,
                     cv::Scalar(light * c[0], light * c[1], light * c[2]), cv::FILLED, cv::LINE_AA, 4);
        }
      }
      writer->write(frame);
    }
    return file("dots.avi");
  }

  /// Each of the first `known` channels answers to one colour, nearly 1 there and nothing at others; the rest is flat.
  fs::path network(int channels, int known) const {
    std::vector<std::array<float, 3>> weights;
    std::vector<float> biases;
    for (int c = 0; c < channels; ++c) {
      const float gain = 40;
      const auto w = c < known ? color(c) : std::array<float, 3>{0, 0, 0};
      weights.push_back({gain * w[0], gain * w[1], gain * w[2]});
      biases.push_back(c < known ? 1 - gain : 0.5F);
    }
    std::ofstream(file("net.onnx"), std::ios::binary) << unseen::test::little_onnx(weights, biases, kWidth, kHeight);
    return file("net.onnx");
  }

  PoseNetworkOptions same_size() const {
    PoseNetworkOptions options;
    options.height = kHeight;
    return options;
  }

  Context context_;

 private:
  fs::path folder_ = fs::temp_directory_path() / ("unseen_pose_network" + std::to_string(::getpid()));
};

TEST_F(PoseNetwork, FindsTheDotOfEachJoint) {
  std::array<int, kJoints> labels;
  for (int j = 0; j < kJoints; ++j) labels[static_cast<std::size_t>(j)] = j;
  const Take take = detect_poses(network(16, 16), video(labels), same_size(), context_);
  EXPECT_EQ(take.fps, 12.5);
  EXPECT_TRUE(take.camera_assumed);
  EXPECT_EQ(take.camera.width, kWidth);
  EXPECT_NEAR(2 * std::atan(0.5 * kWidth / take.camera.fx), kPi / 3, 1e-9);
  ASSERT_EQ(take.detections.size(), 4u);
  for (const Detection& d : take.detections)
    for (int j = 0; j < kJoints; ++j) {
      EXPECT_LT((d.pixels.col(j) - place(j, d.frame)).norm(), 3.0) << d.frame << " " << j;
      EXPECT_NEAR(d.confidence[j], 1.0, 0.2);
    }
}

TEST_F(PoseNetwork, ScalesWhatItFindsToTheVideo) {
  std::array<int, kJoints> labels;
  for (int j = 0; j < kJoints; ++j) labels[static_cast<std::size_t>(j)] = j;
  PoseNetworkOptions options;
  options.height = 120;
  options.width = 300;  // wider than the video: a part of it stays empty
  const Take take = detect_poses(network(16, 16), video(labels), options, context_);
  ASSERT_EQ(take.detections.size(), 4u);
  for (const Detection& d : take.detections)
    for (int j = 0; j < kJoints; ++j) EXPECT_LT((d.pixels.col(j) - place(j, d.frame)).norm(), 7.0) << d.frame << " " << j;
}

TEST_F(PoseNetwork, KnowsTheOrderOfOpenPose) {
  // Of BODY_25: nose 0, neck 1, right wrist 4, left wrist 7, middle of the hips 8, right hip 9, left ankle 14.
  std::array<int, kJoints> labels;
  labels.fill(-1);
  labels[head] = 0, labels[thorax] = 1, labels[right_wrist] = 4, labels[left_wrist] = 7, labels[pelvis] = 8, labels[right_hip] = 9,
  labels[left_ankle] = 14;
  for (const int channels : {25, 26, 78}) {
    const Take take = detect_poses(network(channels, 25), video(labels), same_size(), context_);
    ASSERT_EQ(take.detections.size(), 4u);
    for (const Detection& d : take.detections)
      for (int j = 0; j < kJoints; ++j) {
        if (j == neck) continue;  // made from its neighbours
        const bool there = labels[static_cast<std::size_t>(j)] >= 0;
        EXPECT_NEAR(d.confidence[j], there ? 1.0 : 0.0, 0.25) << channels << " " << j;
        if (there) {
          EXPECT_LT((d.pixels.col(j) - place(j, d.frame)).norm(), 3.0) << channels << " " << j;
        }
      }
  }
}

TEST_F(PoseNetwork, SaysWhatIsWrong) {
  std::array<int, kJoints> labels;
  for (int j = 0; j < kJoints; ++j) labels[static_cast<std::size_t>(j)] = j;
  const fs::path dots = video(labels);
  const auto message = [&](const fs::path& model, const fs::path& film) -> std::string {
    try {
      detect_poses(model, film, same_size(), context_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(file("none.onnx"), dots).find("no such file"), std::string::npos);
  EXPECT_NE(message(network(7, 7), dots).find("1 × 7 × 120 × 240"), std::string::npos);
  EXPECT_NE(message(network(16, 16), file("none.avi")).find("none.avi"), std::string::npos);
  const fs::path model = network(16, 16);
  for (const std::string& bytes : {std::string("not a network"), std::string()}) {
    std::ofstream(model, std::ios::binary) << bytes;
    EXPECT_NE(message(model, dots).find("a network that OpenCV reads"), std::string::npos);
  }
  labels.fill(-1);
  EXPECT_NE(message(network(16, 16), video(labels)).find("nobody in 4 frames"), std::string::npos);
}

}  // namespace
}  // namespace unseen::report
