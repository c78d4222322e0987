// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/regions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>

#include "collision/video/stabilise.h"
#include "little_videos.h"
#include "unseen/core/error.h"

namespace unseen::collision::test {
namespace {

/// Largest distance of the region nearest to each true centre, over the frames in [first, last].
double worst_error(const Footage& footage, int first, int last, const std::function<Vec2(int)>& truth) {
  double worst = 0.0;
  for (int k = first; k <= last; ++k) {
    double nearest = 1e9;
    for (const Region& r : footage.regions[k]) nearest = std::min(nearest, (r.centroid - truth(k)).norm());
    worst = std::max(worst, nearest);
  }
  return worst;
}

TEST(Regions, CentroidAndDiameterOfAMovingDisc) {
  const Scratch scratch("disc");
  const std::string path = scratch.file("disc.avi");
  Random random(1);
  const cv::Mat background = wall();
  write_video(path, 40, [&](int k) {
    cv::Mat frame = background.clone();
    draw_disc(frame, thrown(k), 12.0, kRed);
    add_noise(frame, 3.0, random);
    return frame;
  });
  Context context;
  const Footage footage = find_regions(shot_of(path), context);
  ASSERT_EQ(footage.regions.size(), 40u);
  EXPECT_EQ(footage.width, kWidth);
  EXPECT_NEAR(footage.fps, 50.0, 1e-9);
  EXPECT_NEAR(footage.times[10], 0.2, 1e-9);
  EXPECT_LT(worst_error(footage, 1, 39, thrown), 0.3);
  for (int k = 1; k < 40; ++k) {
    ASSERT_EQ(footage.regions[k].size(), 1u) << k;
    const Region& r = footage.regions[k][0];
    EXPECT_NEAR(r.diameter, 24.5, 1.3) << k;
    EXPECT_NEAR(r.circle, 25.0, 3.0) << k;
    EXPECT_GT(r.color.x(), 1.5 * r.color.z()) << k;
    EXPECT_EQ(r.mask.size(), r.box.size());
    EXPECT_NEAR(cv::countNonZero(r.mask), r.area, 1e-9);
  }
  EXPECT_TRUE(context.take_warnings().empty());
  EXPECT_TRUE(footage.shift.empty());
  EXPECT_FALSE(footage.moving_camera);
}

TEST(Regions, BlurLeavesCentroidAndWidthAlone) {
  const Scratch scratch("blur");
  const std::string path = scratch.file("blur.avi");
  const cv::Mat background = wall();
  const auto place = [](int k) { return Vec2(40.0 + 11.0 * k, 120.0 + 4.0 * k); };
  write_video(path, 20, [&](int k) {
    cv::Mat sum = cv::Mat::zeros(background.size(), CV_32FC3);
    for (int i = 0; i < 16; ++i) {  // half of a frame's time
      cv::Mat frame = background.clone();
      draw_disc(frame, place(k) + ((i + 0.5) / 16.0 - 0.5) * 0.5 * Vec2(11.0, 4.0), 12.0, kRed);
      cv::accumulate(frame, sum);
    }
    sum.convertTo(sum, CV_8UC3, 1.0 / 16.0);
    return sum;
  });
  Context context;
  const Footage footage = find_regions(shot_of(path), context);
  EXPECT_LT(worst_error(footage, 1, 18, place), 0.5);
  for (int k = 1; k < 19; ++k) EXPECT_NEAR(footage.regions[k][0].diameter, 24.5, 2.0) << k;
}

TEST(Regions, FlickerAndBlackFramesAreNoMovers) {
  const Scratch scratch("flicker");
  const std::string path = scratch.file("flicker.avi");
  const cv::Mat background = wall();
  write_video(path, 30, [&](int k) {
    cv::Mat frame = background.clone();
    draw_disc(frame, thrown(k), 12.0, kRed);
    return cv::Mat(frame * (k == 11 ? 0.02 : 0.85 + 0.15 * std::sin(2.1 * k)));
  });
  Context context;
  const Footage footage = find_regions(shot_of(path), context);
  EXPECT_TRUE(footage.regions[11].empty());
  for (int k = 1; k < 30; ++k) {
    if (k != 11) { EXPECT_EQ(footage.regions[k].size(), 1u) << k; }
  }
  EXPECT_LT(worst_error(footage, 1, 10, thrown), 0.5);
}

/// A film by an unsteady hand whose first frames are black.
void expect_steadied(int black) {
  const Scratch scratch("hand");
  const std::string path = scratch.file("hand.avi");
  const cv::Mat background = wall(12);
  const auto sway = [](int k) { return Vec2(4.0 * std::sin(0.35 * k), 3.0 * std::cos(0.23 * k) - 3.0); };
  write_video(path, 40, [&](int k) {
    if (k < black) return cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar::all(0));
    cv::Mat m = (cv::Mat_<double>(2, 3) << 1, 0, -12 - sway(k).x(), 0, 1, -12 - sway(k).y()), frame;
    cv::warpAffine(background, frame, m, {kWidth, kHeight}, cv::INTER_LINEAR);
    draw_disc(frame, thrown(k) - sway(k), 12.0, kRed);
    return frame;
  });
  Context context;
  const Footage footage = find_regions(shot_of(path), context);
  ASSERT_EQ(footage.shift.size(), 40u);
  EXPECT_FALSE(footage.moving_camera);
  EXPECT_LT(worst_error(footage, black + 1, 36, [&](int k) { return Vec2(thrown(k) - sway(k)); }), 0.5);
  for (int k = black; k < 40; ++k) {
    EXPECT_NEAR(footage.shift[k].at<double>(0, 2), sway(k).x() - sway(black).x(), 0.5) << k;
    EXPECT_NEAR(footage.shift[k].at<double>(1, 2), sway(k).y() - sway(black).y(), 0.5) << k;
  }
}

TEST(Regions, UnsteadyHandIsUndone) { expect_steadied(0); }
TEST(Regions, UnsteadyHandIsUndoneAfterBlackFrames) { expect_steadied(2); }

TEST(Regions, APanIsNoticed) {
  const Scratch scratch("pan");
  const std::string path = scratch.file("pan.avi");
  const cv::Mat background = wall(60);
  write_video(path, 30, [&](int k) { return background(cv::Rect(4 * k, 60, kWidth, kHeight)).clone(); });
  Context context;
  EXPECT_TRUE(find_regions(shot_of(path), context).moving_camera);
  EXPECT_TRUE(warned(context, "camera moves"));
}

TEST(Regions, WhatRestsMostOfTheTimeIsNoBackground) {
  const Scratch scratch("rest");
  const std::string path = scratch.file("rest.avi");
  const cv::Mat background = wall();
  const auto place = [](int k) { return Vec2(60.0 + 9.0 * std::min(k, 12), 60.0 + std::min(k, 12) * std::min(k, 12) * 0.8); };
  write_video(path, 40, [&](int k) {
    cv::Mat frame = background.clone();
    draw_disc(frame, place(k), 14.0, kRed);
    return frame;
  });
  Context context;
  const Footage footage = find_regions(shot_of(path), context);
  EXPECT_LT(worst_error(footage, 1, 39, place), 0.6);
  for (const Region& r : footage.regions[2]) EXPECT_TRUE((r.centroid - place(2)).norm() < 1.0 || r.area < 60.0);  // no ghost of it
}

TEST(Regions, WhatWaitsUntilItIsHitIsNoBackground) {
  const Scratch scratch("waits");
  const std::string path = scratch.file("waits.avi");
  const auto hit = [](int k) { return Vec2(150.0 + 4.5 * std::max(0, k - 36), 120.0); };
  const auto striker = [](int k) { return Vec2(k < 36 ? 122.0 - 3.0 * (36 - k) : 122.0 + 1.6 * (k - 36), 120.0); };  // goes on over its place
  for (const bool rough : {false, true}) {
    const cv::Mat background = rough ? wall() : cv::Mat(kHeight, kWidth, CV_8UC3, cv::Scalar(125, 140, 150));
    Random random(4);
    write_video(path, 60, [&](int k) {
      cv::Mat frame = background.clone();
      draw_disc(frame, hit(k), 14.0, cv::Scalar(205, 130, 85));
      draw_disc(frame, striker(k), 14.0, kRed);
      add_noise(frame, 1.5, random);
      return frame;
    });
    Context context;
    const Footage footage = find_regions(shot_of(path), context);
    EXPECT_LT(worst_error(footage, 1, 30, hit), 1.0) << rough;  // apart until then
    EXPECT_LT(worst_error(footage, 1, 30, striker), 1.0) << rough;
    EXPECT_LT(worst_error(footage, 42, 58, hit), 1.0) << rough;
    EXPECT_LT(worst_error(footage, 42, 58, striker), rough ? 3.0 : 1.0) << rough;  // behind a part of it nothing was ever seen
    for (const Region& r : footage.regions[58]) EXPECT_TRUE((r.centroid - hit(58)).norm() < 3.0 || (r.centroid - striker(58)).norm() < 3.0 || r.area < 60.0) << rough;
  }
}

TEST(Regions, ABodyThatLingersLeavesNoGhost) {
  const Scratch scratch("linger");
  const std::string path = scratch.file("linger.avi");
  const cv::Mat background = wall();
  const auto place = [](int k) { return Vec2(160.0 + 0.9 * (k - 30), 60.0 + 0.06 * (k - 30) * (k - 30)); };  // its top covers some pixels in two frames of three
  Random random(2);
  write_video(path, 60, [&](int k) {
    cv::Mat frame = background.clone();
    draw_disc(frame, place(k), 26.0, cv::Scalar(120 + 110 * std::cos(0.3 * k), 120 + 110 * std::sin(0.3 * k), 220));  // it turns
    add_noise(frame, 2.0, random);
    return frame;
  });
  Context context;
  const Footage footage = find_regions(shot_of(path), context);
  EXPECT_LT(worst_error(footage, 1, 58, place), 1.0);
  for (const int k : {2, 57})
    for (const Region& r : footage.regions[k]) EXPECT_TRUE((r.centroid - place(k)).norm() < 2.0 || r.area < 60.0) << k;
}

/// Between its white and its black the wall is the median; most frames are far off that, but they are no noise.
TEST(Regions, ASpottedBodyThatLingersIsSeenWhole) {
  const Scratch scratch("spotted");
  const std::string path = scratch.file("spotted.avi");
  const cv::Mat background = wall();
  const auto place = [](int k) { return Vec2(160.0 + 1.4 * (k - 30), 60.0 + 0.06 * (k - 30) * (k - 30)); };
  Random random(3);
  write_video(path, 60, [&](int k) {
    cv::Mat frame = background.clone();
    const Vec2 center = place(k);
    draw_disc(frame, center, 26.0, cv::Scalar(230, 230, 230));
    for (double angle = 0.2 * k; angle < 0.2 * k + 6.2; angle += 1.2566)
      draw_disc(frame, center + 14.0 * Vec2(std::cos(angle), std::sin(angle)), 9.5, cv::Scalar(25, 25, 25));
    add_noise(frame, 2.0, random);
    return frame;
  });
  Context context;
  const Footage footage = find_regions(shot_of(path), context);
  EXPECT_LT(worst_error(footage, 1, 58, place), 2.0);
}

TEST(Regions, AShadowIsCutOffOrMarked) {
  const Scratch scratch("shadow");
  const std::string path = scratch.file("shadow.avi");
  const cv::Mat background = wall();
  const auto draw = [&](int k, const Vec2& off) {
    cv::Mat frame = background.clone(), light(frame.size(), CV_32FC3, cv::Scalar(1, 1, 1));
    draw_disc(light, thrown(k) + off, 12.0, cv::Scalar(0.6, 0.6, 0.6));
    cv::GaussianBlur(light, light, {7, 7}, 2.0);
    frame.convertTo(frame, CV_32FC3);
    frame = frame.mul(light);
    frame.convertTo(frame, CV_8UC3);
    draw_disc(frame, thrown(k), 12.0, kRed);
    return frame;
  };
  write_video(path, 30, [&](int k) { return draw(k, Vec2(k < 15 ? 9.0 : 40.0, 4.0)); });
  Context context;
  const Footage footage = find_regions(shot_of(path), context);
  EXPECT_LT(worst_error(footage, 2, 28, thrown), 1.0);
  int seen = 0;
  for (int k = 16; k < 29; ++k)
    for (const Region& r : footage.regions[k])
      if ((r.centroid - thrown(k)).norm() > 10.0) {
        ++seen;
        EXPECT_TRUE(r.shadow) << k;
      }
  EXPECT_GT(seen, 5);
}

/// Regions of a film of sixty frames of what `draw` draws, behind a post.
Footage behind_a_post(const std::string& name, const cv::Rect& post, const std::function<void(cv::Mat&, int)>& draw) {
  const Scratch scratch(name);
  const std::string path = scratch.file(name + ".avi");
  Random random(3);
  const cv::Mat background = wall();
  write_video(path, 60, [&](int k) {
    cv::Mat frame = background.clone();
    draw(frame, k);
    cv::rectangle(frame, post, cv::Scalar(40, 60, 50), cv::FILLED);
    add_noise(frame, 2.0, random);
    return frame;
  });
  Context context;
  return find_regions(shot_of(path), context);
}

TEST(Regions, WhatSomethingBeforeTheSceneCutsIsMarked) {
  const cv::Rect post(150, 0, 30, kHeight);
  constexpr double kRadius = 18.0;
  const auto place = [](int k) { return Vec2(70.0 + 3.0 * k, 120.0 + 0.05 * (k - 30) * (k - 30)); };
  const Footage footage = behind_a_post("post", post, [&](cv::Mat& frame, int k) { draw_disc(frame, place(k), kRadius, kRed); });
  int cut = 0;
  for (int k = 1; k < 59; ++k)
    for (const Region& r : footage.regions[k]) {
      if (r.shadow || r.area < 200.0) continue;
      const double x = place(k).x(), left = post.x - x, right = x - (post.x + post.width);
      if (std::max(left, right) > kRadius + 3.0) {
        EXPECT_FALSE(r.covered) << k;
      } else if (std::max(left, right) < 0.6 * kRadius) {
        EXPECT_TRUE(r.covered) << k;
        ++cut;
      }
    }
  EXPECT_GT(cut, 6);
}

TEST(Regions, WhatIsCutInACornerIsClipped) {
  const cv::Rect post(150, 0, 60, kHeight);
  const double reach = std::sqrt(2.0) * 16.0;  // of a square that stands on a corner, from its middle
  const auto place = [](int k) { return Vec2(40.0 + 2.5 * k, 120.0); };
  const Footage footage = behind_a_post("corner", post, [&](cv::Mat& frame, int k) {
    std::vector<cv::Point> corners;
    for (const Vec2& side : {Vec2(1, 0), Vec2(0, 1), Vec2(-1, 0), Vec2(0, -1)}) {
      const Vec2 corner = 16.0 * (place(k) + reach * side);  // sixteenths of a pixel
      corners.emplace_back(static_cast<int>(std::lround(corner.x())), static_cast<int>(std::lround(corner.y())));
    }
    cv::fillConvexPoly(frame, corners, kRed, cv::LINE_AA, 4);
  });
  int clipped = 0;
  for (int k = 1; k < 59; ++k)
    for (const Region& r : footage.regions[k]) {
      if (r.shadow || r.area < 200.0) continue;
      const double hidden = place(k).x() + reach - post.x;  // of the corner; the chord is twice as long
      EXPECT_FALSE(r.clipped && hidden < -3.0) << k;
      EXPECT_FALSE(r.covered && hidden < 4.0) << k;
      EXPECT_TRUE(r.clipped || hidden <= 6.0 || hidden >= 32.0) << k;
      clipped += r.clipped && !r.covered;
    }
  EXPECT_GT(clipped, 1);
}

TEST(Regions, RoiFramesAndRateOfTheShot) {
  const Scratch scratch("roi");
  const std::string path = scratch.file("roi.avi");
  const cv::Mat background = wall();
  write_video(path, 30, [&](int k) {
    cv::Mat frame = background.clone();
    draw_disc(frame, thrown(k), 12.0, kRed);
    return frame;
  });
  Shot shot = shot_of(path);
  shot.fps = 200.0;
  shot.roi = {0, 0, 150, 240};
  shot.frames = {3, 20};
  Context context;
  const Footage footage = find_regions(shot, context);
  EXPECT_NEAR(footage.times[8], 0.04, 1e-9);
  EXPECT_EQ(footage.times.size(), 21u);
  EXPECT_TRUE(footage.regions[1].empty());
  EXPECT_LT(worst_error(footage, 4, 15, thrown), 0.4);
  EXPECT_TRUE(footage.regions[20].empty() || footage.regions[20][0].at_border);
  for (const auto& frame : footage.regions)
    for (const Region& r : frame) EXPECT_LE(r.box.br().x, 150);
  shot.roi = {400, 0, 10, 10};
  EXPECT_THROW(find_regions(shot, context), InputError);
}

// A wall with a strong texture above a floor with a weak one: the drift of the camera is told by all of the picture.
TEST(Stabiliser, CornersComeFromAllPartsOfThePicture) {
  Random random(9);
  cv::Mat texture(360, 640, CV_32F);
  for (int y = 0; y < texture.rows; ++y)
    for (int x = 0; x < texture.cols; ++x) texture.at<float>(y, x) = 128.0f + (y < 90 ? 60.0f : 14.0f) * static_cast<float>(random.normal());
  cv::GaussianBlur(texture, texture, {}, 2.0);
  Stabiliser stabiliser;
  constexpr double kDrift = 0.2;  // px a frame
  for (int k = 0; k < 40; ++k) {
    cv::Mat moved, gray;
    cv::warpAffine(texture, moved, cv::Mat((cv::Mat_<double>(2, 3) << 1, 0, kDrift * k, 0, 1, 0)), texture.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
    moved.convertTo(gray, CV_8U);
    stabiliser.add(gray, true);
  }
  const Stabiliser::Motion motion = stabiliser.finish(1.0);
  ASSERT_EQ(motion.shift.size(), 40u);
  EXPECT_LT(motion.lost, 0.05);
  EXPECT_NEAR(motion.shift[39].at<double>(0, 2), -39 * kDrift, 0.2);
}

}  // namespace
}  // namespace unseen::collision::test
