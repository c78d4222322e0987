// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/overlay.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "collision/sample.h"
#include "io/codecs.h"
#include "unseen/core/error.h"

namespace unseen::collision {
namespace {

namespace fs = std::filesystem;

/// A grey clip with a black disc where the ball of a sample is.
class OverlayTest : public testing::Test {
 protected:
  OverlayTest() : sample(sample_two_bodies()) {
    std::string pattern = (fs::temp_directory_path() / "unseen-overlay-XXXXXX").string();
    folder = mkdtemp(pattern.data());
    sample.shot.video = (folder / "clip.avi").string();
    const auto writer = io::codecs().video_writer(sample.shot.video, io::fourcc('M', 'J', 'P', 'G'), 120, {640, 480});
    for (int f = 0; f < 90; ++f) {
      cv::Mat frame(480, 640, CV_8UC3, cv::Scalar::all(128));
      writer->write(frame);
    }
  }
  ~OverlayTest() override { fs::remove_all(folder); }

  Vec2 center(int frame, std::size_t body) const {
    const Reconstruction& r = sample.result;
    return r.camera.project(r.T_world_camera.inverse() * r.frames[static_cast<std::size_t>(frame)].bodies[body]->p);
  }

  fs::path folder;
  Sample sample;
  Context context;
};

cv::Mat decoded(const OverlayPicture& p) { return io::codecs().decode(std::vector<char>(p.jpeg.begin(), p.jpeg.end()), cv::IMREAD_COLOR); }

/// The largest distance of a channel from grey within a few pixels.
double colored(const cv::Mat& picture, double x, double y) {
  const cv::Mat patch = picture(cv::Rect(cvRound(x) - 2, cvRound(y) - 2, 5, 5));
  double most = 0;
  for (const cv::Vec3b& c : cv::Mat_<cv::Vec3b>(patch)) most = std::max(most, std::abs(double(c[0]) - double(c[2])));
  return most;
}

TEST_F(OverlayTest, PicturesHaveTheTimesOfUnevenFrames) {
  for (FramePose& f : sample.result.frames)
    if (f.frame >= 20) f.time += 0.05;
  const int last = sample.result.frames.back().frame;
  const auto pictures = write_overlay(sample.shot, sample.result, "", context);
  EXPECT_DOUBLE_EQ(pictures[19].time, 19 / 120.0);
  EXPECT_DOUBLE_EQ(pictures[20].time, 20 / 120.0 + 0.05);
  const auto after = static_cast<std::size_t>(last) + 1;
  ASSERT_LT(after, pictures.size());
  EXPECT_NEAR(pictures[after].time, (last + 1) / 120.0 + 0.05, 1e-12) << "past the flights by the frame rate";
}

TEST_F(OverlayTest, DrawsTheBallWhereItIs) {
  const auto pictures = write_overlay(sample.shot, sample.result, "", context);
  ASSERT_EQ(pictures.size(), 90u);
  EXPECT_DOUBLE_EQ(pictures[20].time, 20 / 120.0);
  const cv::Mat picture = decoded(pictures[20]);
  const Vec2 c = center(20, 1);
  const double radius = 900 * 0.05 / 3.0;  // nearly: the ball is 3 m away
  for (const double angle : {0.3, 1.5, 2.9, 4.4}) {
    EXPECT_GT(colored(picture, c.x() + radius * std::cos(angle), c.y() + radius * std::sin(angle)), 60) << angle;
    EXPECT_LT(colored(picture, c.x() + 1.6 * radius * std::cos(angle), c.y() - 1.6 * radius * std::abs(std::sin(angle))), 60) << angle;
  }
}

TEST_F(OverlayTest, FollowsTheLens) {
  sample.shot.camera.distortion = {-0.3, 0, 0, 0, 0};
  const cv::Mat picture = decoded(write_overlay(sample.shot, sample.result, "", context)[3]);
  const Camera& k = sample.result.camera;
  const Vec2 c = center(3, 1);
  const double x = (c.x() - k.cx) / k.fx, y = (c.y() - k.cy) / k.fy, s = 1 - 0.3 * (x * x + y * y);
  EXPECT_GT(colored(picture, k.fx * x * s + k.cx + 900 * 0.05 / 3.0, k.fy * y * s + k.cy), 60);
}

TEST_F(OverlayTest, TheVideoHasAllFramesInSlowMotion) {
  const fs::path out = folder / "overlay.mp4";
  write_overlay(sample.shot, sample.result, out, context);
  const auto clip = io::codecs().video_reader();
  ASSERT_TRUE(clip->open(out.string(), cv::CAP_FFMPEG));
  EXPECT_EQ(clip->get(cv::CAP_PROP_FPS), 30);
  int frames = 0;
  for (cv::Mat frame; clip->read(frame); ++frames) EXPECT_EQ(frame.cols, 640);
  EXPECT_EQ(frames, 90);
}

TEST_F(OverlayTest, ALongShotGivesAtMostSoManyPictures) {
  for (int f = 61; f <= 4000; ++f) sample.result.frames.push_back({f, f / 120.0, {}});
  const auto pictures = write_overlay(sample.shot, sample.result, "", context);
  EXPECT_LE(pictures.size(), 10u);
  const bool has_impact = std::any_of(pictures.begin(), pictures.end(), [](const OverlayPicture& p) { return std::lround(p.time * 120) == 31; });
  EXPECT_TRUE(has_impact);
}

TEST_F(OverlayTest, CirclesWhatMovesWhereNothingWasSolved) {
  sample.result.frames.clear();
  sample.result.impacts.clear();
  sample.result.sighted = {{70, 1, {200, 300}, 40}, {71, std::nullopt, {400, 100}, 60}};
  const fs::path out = folder / "overlay.mp4";
  const auto pictures = write_overlay(sample.shot, sample.result, out, context);
  EXPECT_TRUE(fs::exists(out));
  ASSERT_EQ(pictures.size(), 80u) << "half a second around, as far as the clip goes";
  EXPECT_DOUBLE_EQ(pictures.front().time, 10 / 120.0);
  EXPECT_GT(colored(decoded(pictures[60]), 220, 300), 60);
  EXPECT_LT(colored(decoded(pictures[60]), 200, 300), 60) << "a circle, no disc";
  const cv::Mat grey = decoded(pictures[61]);
  EXPECT_LT(colored(grey, 430, 100), 30);
  EXPECT_GT(std::abs(grey.at<cv::Vec3b>(100, 432)[1] - grey.at<cv::Vec3b>(100, 450)[1]), 60) << "its light rim";
}

TEST_F(OverlayTest, LeavesOutCirclesBeyondAllBounds) {
  sample.result.frames.clear();
  sample.result.sighted = {{3, 0, {1e100, 10}, 5}, {3, 0, {10, 10}, 1e12}};
  EXPECT_FALSE(write_overlay(sample.shot, sample.result, "", context).empty());
}

TEST_F(OverlayTest, SkipsWhatHasNoVideoOrNoFlight) {
  const fs::path out = folder / "overlay.mp4";
  Sample s = sample;
  s.shot.video.clear();
  EXPECT_TRUE(write_overlay(s.shot, s.result, out, context).empty());
  s = sample;
  s.result.frames.clear();
  EXPECT_TRUE(write_overlay(s.shot, s.result, out, context).empty());
  EXPECT_FALSE(fs::exists(out));
  s = sample;
  s.shot.video = (folder / "none.avi").string();
  EXPECT_THROW(write_overlay(s.shot, s.result, out, context), InputError);
}

TEST_F(OverlayTest, EndsWhenAsked) {
  std::stop_source source;
  source.request_stop();
  context.stop = source.get_token();
  EXPECT_THROW(write_overlay(sample.shot, sample.result, "", context), Cancelled);
}

}  // namespace
}  // namespace unseen::collision
