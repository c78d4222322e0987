// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "unseen/collision/synth.h"

namespace unseen::collision {
namespace {

using Picture = std::vector<std::uint8_t>;

SynthOptions small(const std::string& scene) {
  SynthOptions options;
  options.scene = scene;
  options.width = 480;
  options.height = 270;
  options.fps = 60;
  options.noise = 0;
  options.exposure = 0;
  options.shadow = false;
  return options;
}

std::vector<Picture> film(const SynthShot& shot, const SynthOptions& options, int threads = 0) {
  std::vector<Picture> pictures;
  Context context;
  context.threads = threads;
  render(shot, options, context, [&](int, const Picture& bgr) { pictures.push_back(bgr); });
  return pictures;
}

/// The picture without the bodies.
Picture still(SynthShot shot, const SynthOptions& options) {
  for (FramePose& f : shot.truth.frames)
    for (auto& s : f.bodies)
      if (s) s->p.x() += 1000;
  return film(shot, options).front();
}

/// Pixels that differ from the still picture by more than `least` levels.
cv::Mat mask_of(const Picture& picture, const Picture& background, int width, int height, int least = 12) {
  cv::Mat mask(height, width, CV_8U);
  for (int i = 0; i < width * height; ++i) {
    int most = 0;
    for (int c = 0; c < 3; ++c) {
      const auto at = static_cast<std::size_t>(3 * i + c);
      most = std::max(most, std::abs(picture[at] - background[at]));
    }
    mask.data[i] = most > least ? 255 : 0;
  }
  return mask;
}

Vec2 centroid(const cv::Moments& m) { return {m.m10 / m.m00, m.m01 / m.m00}; }

std::vector<cv::Point2f> outline(const Truth& truth, const BodyState& s) {
  std::vector<cv::Point2f> points, hull;
  const RigidTransform T = truth.T_world_camera.inverse();
  const Vec3 half = 0.5 * truth.bodies[0].box;
  for (int i = 0; i < 8; ++i) {
    const Vec2 p = truth.camera.project(T * (s.p + s.q * half.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1))));
    points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  }
  cv::convexHull(points, hull);
  return hull;
}

TEST(SynthRender, ABoxCoversItsProjection) {
  const SynthOptions options = small("box-floor");
  const SynthShot shot = simulate(options);
  const std::vector<Picture> pictures = film(shot, options);
  ASSERT_EQ(pictures.size(), shot.truth.frames.size());
  const Picture background = still(shot, options);
  int compared = 0;
  for (std::size_t f = 0; f < pictures.size(); f += 3) {
    const auto hull = outline(shot.truth, *shot.truth.frames[f].bodies[0]);
    const cv::Rect box = cv::boundingRect(hull);
    if (box.x < 1 || box.y < 1 || box.br().x >= options.width - 1 || box.br().y >= options.height - 1) continue;
    const cv::Moments seen = cv::moments(mask_of(pictures[f], background, options.width, options.height), true), expected = cv::moments(hull);
    EXPECT_LT((centroid(seen) - centroid(expected)).norm(), 1) << "frame " << f;
    EXPECT_NEAR(std::sqrt(seen.m00 / expected.m00), 1, 0.06) << "frame " << f;
    ++compared;
  }
  EXPECT_GT(compared, 3);
}

TEST(SynthRender, SameBytesAtAnyNumberOfThreads) {
  SynthOptions options = small("box-ball");
  options.noise = 3;
  options.exposure = 0.5;
  options.shadow = true;
  options.frames = 12;
  options.fps = 30;
  const SynthShot shot = simulate(options);
  EXPECT_EQ(film(shot, options, 1), film(shot, options, 4));
}

TEST(SynthRender, NoiseHasItsStandardDeviationAndNoPattern) {
  SynthOptions options = small("balls");
  const SynthShot shot = simulate(options);
  const std::vector<Picture> exact = film(shot, options);
  options.noise = 4;
  const std::vector<Picture> noisy = film(shot, options);
  double sum = 0, squares = 0, neighbours = 0;
  const std::size_t count = exact[0].size() - 3;
  const auto difference = [&](std::size_t i) { return static_cast<double>(noisy[0][i]) - exact[0][i]; };
  for (std::size_t i = 0; i < count; ++i) {
    sum += difference(i);
    squares += difference(i) * difference(i);
    neighbours += difference(i) * difference(i + 3);
  }
  EXPECT_NEAR(sum / count, 0, 0.1);
  EXPECT_NEAR(std::sqrt(squares / count), 4, 0.1);
  EXPECT_NEAR(neighbours / squares, 0, 0.02);
}

TEST(SynthRender, TheCurtainHidesTheImpact) {
  SynthOptions options = small("balls");
  options.curtain = true;
  const SynthShot shot = simulate(options);
  const std::vector<Picture> pictures = film(shot, options);
  const Picture background = still(shot, options);
  const auto impact = static_cast<std::size_t>(shot.truth.impacts[0].frame);
  const Vec2 contact = shot.truth.camera.project(shot.truth.T_world_camera.inverse() * shot.truth.impacts[0].contact_point);
  const cv::Mat mask = mask_of(pictures[impact], background, options.width, options.height);
  EXPECT_EQ(mask.at<std::uint8_t>(static_cast<int>(contact.y()), static_cast<int>(contact.x())), 0);
  EXPECT_LT(cv::countNonZero(mask), cv::countNonZero(mask_of(pictures[0], background, options.width, options.height)));
}

TEST(SynthRender, AnOpenShutterBlursAlongTheMotion) {
  SynthOptions options = small("ball-floor");
  options.fps = 30;
  const SynthShot shot = simulate(options);
  const std::vector<Picture> sharp = film(shot, options);
  const Picture background = still(shot, options);
  options.exposure = 1;
  const std::vector<Picture> blurred = film(shot, options);
  const std::size_t f = 3;  // falls
  const cv::Mat narrow = mask_of(sharp[f], background, options.width, options.height, 1);
  const cv::Mat wide = mask_of(blurred[f], background, options.width, options.height, 1);
  const cv::Rect a = cv::boundingRect(narrow), b = cv::boundingRect(wide);
  const BodyState& s = *shot.truth.frames[f].bodies[0];
  const double drop = s.v.norm() / 30 * shot.truth.camera.fx / s.p.y();
  EXPECT_NEAR(b.height - a.height, drop, 0.35 * drop);
  EXPECT_LT((centroid(cv::moments(narrow, true)) - centroid(cv::moments(wide, true))).norm(), 1.0);
}

}  // namespace
}  // namespace unseen::collision
