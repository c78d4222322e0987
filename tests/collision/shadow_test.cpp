// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/shadow.h"

#include <gtest/gtest.h>

#include "collision/tracks/candidates.h"
#include "collision/tracks/chain.h"
#include "collision/tracks/tracks.h"
#include "collision/video/regions.h"
#include "collision/video/worst_channel.h"
#include "little_videos.h"

namespace unseen::collision::test {
namespace {

/// Bounces once, off a floor at 210 px, in frame 20.
Vec2 bouncing(int k) {
  const double t = k - 20.0;
  return {40.0 + 6.0 * k, 198.0 - (t < 0 ? -14.0 : 10.0) * t + 0.35 * t * t};
}

/// A wall of one colour, a little lighter on one side.
cv::Mat plain(const cv::Scalar& color) {
  cv::Mat picture(kHeight, kWidth, CV_8UC3);
  for (int x = 0; x < kWidth; ++x) picture.col(x).setTo(color * (0.95 + 0.1 * x / kWidth));
  return picture;
}

/// A matt ball lit from the upper left, four shades in a pixel.
void draw_ball(cv::Mat& frame, const Vec2& center, double radius, const cv::Scalar& color) {
  const Vec3 lamp = Vec3(-0.4, -0.8, 0.5).normalized();
  for (int y = 0; y < frame.rows; ++y)
    for (int x = 0; x < frame.cols; ++x)
      for (int i = 0; i < 4; ++i) {
        const Vec2 d = (Vec2(x + 0.25 - 0.5 * (i & 1), y + 0.25 - 0.5 * (i >> 1)) - center) / radius;
        if (d.squaredNorm() >= 1.0) continue;
        const double light = 0.45 + 0.6 * std::max(0.0, lamp.dot(Vec3(d.x(), d.y(), std::sqrt(1.0 - d.squaredNorm()))));
        cv::Vec3b& p = frame.at<cv::Vec3b>(y, x);
        for (int c = 0; c < 3; ++c) p[c] = cv::saturate_cast<unsigned char>(p[c] + (light * color[c] - p[c]) / (4 - i));
      }
}

void draw_shadow(cv::Mat& frame, const Vec2& center, double radius) {
  cv::Mat light(frame.size(), CV_32FC3, cv::Scalar(1, 1, 1));
  draw_disc(light, center, radius, cv::Scalar(0.6, 0.6, 0.6));
  cv::GaussianBlur(light, light, {7, 7}, 2.0);
  cv::Mat lit;
  frame.convertTo(lit, CV_32FC3);
  lit = lit.mul(light);
  lit.convertTo(frame, CV_8UC3);
}

cv::Mat gray(const cv::Mat& frame) {
  cv::Mat one, three;
  cv::cvtColor(frame, one, cv::COLOR_BGR2GRAY);
  cv::cvtColor(one, three, cv::COLOR_GRAY2BGR);
  return three;
}

Footage film(const std::string& name, const std::function<cv::Mat(int)>& draw) {
  const Scratch scratch(name);
  Shot shot;
  shot.name = shot.video = scratch.file("clip.avi");
  Random random(4);
  write_video(shot.video, 40, [&](int k) {
    cv::Mat frame = draw(k);
    add_noise(frame, 2.0, random);
    return frame;
  });
  Context context;
  return find_regions(shot, context);
}

Shot bounce_shot() {
  Shot shot;
  shot.name = shot.video = "clip";
  shot.bodies.resize(2);
  shot.bodies[0].name = "ball";
  shot.bodies[0].shape = Shape::sphere;
  shot.bodies[0].radius = 0.03;
  shot.bodies[1].name = "floor";
  shot.bodies[1].shape = Shape::fixed;
  return shot;
}

/// Meetings found in a film of a bouncing ball.
std::size_t bounces(const Footage& footage) {
  const Shot shot = bounce_shot();
  ShotCamera camera;
  camera.camera = {300.0, 300.0, 159.5, 119.5, kWidth, kHeight};
  Context context;
  return find_tracks(shot, camera, footage, context).meetings.size();
}

TEST(Shadow, ADarkBallInAGrayClipIsSeenToBounce) {
  const cv::Mat background = plain(cv::Scalar::all(140));
  EXPECT_EQ(bounces(film("graydark", [&](int k) {
    cv::Mat frame = background.clone();
    draw_ball(frame, bouncing(k), 12.0, cv::Scalar::all(80));
    return gray(frame);
  })), 1u);
}

TEST(Shadow, ABallOfTheWallsHueIsSeenToBounce) {
  const cv::Mat background = plain(cv::Scalar(125, 140, 150));
  EXPECT_EQ(bounces(film("grayball", [&](int k) {
    cv::Mat frame = background.clone();
    draw_ball(frame, bouncing(k), 12.0, cv::Scalar(88, 98, 105));
    return frame;
  })), 1u);
}

TEST(Shadow, WhatHidesTheBackgroundsTextureIsABody) {
  const cv::Mat background = gray(wall());
  const Footage footage = film("graywall", [&](int k) {
    cv::Mat frame = background.clone();
    draw_disc(frame, bouncing(k), 14.0, cv::Scalar::all(70));
    return frame;
  });
  for (int k = 2; k < 38; ++k)
    for (const Region& r : footage.regions[k])
      if (r.shadow) { EXPECT_NE(r.sign, ShadowSign::texture) << k; }
  EXPECT_EQ(bounces(footage), 1u);
}

TEST(Shadow, AShadowInAGrayClipIsNoBody) {
  const Vec2 beside(46.0, -20.0);
  const cv::Mat background = gray(wall());
  const Footage footage = film("grayshadow", [&](int k) {
    cv::Mat frame = background.clone();
    draw_shadow(frame, bouncing(k) + beside, 14.0);
    draw_disc(frame, bouncing(k), 14.0, cv::Scalar::all(235));
    return frame;
  });
  ShotCamera camera;
  camera.camera = {300.0, 300.0, 159.5, 119.5, kWidth, kHeight};
  int shadows = 0;
  for (const auto& frame : candidates_of(footage, camera, true))
    for (const Candidate& c : frame)
      if (c.frame > 1 && (c.pixel - bouncing(c.frame)).norm() > 20.0 && c.area > 100.0) {
        ++shadows;
        EXPECT_TRUE(c.shadow) << c.frame;
      }
  EXPECT_GT(shadows, 10);
}

/// In how many of 30 frames the largest region is all of a bouncing ball of 20 px radius.
int whole_balls(const Footage& footage) {
  int whole = 0;
  for (int k = 5; k < 35; ++k) {
    const std::vector<Region>& regions = footage.regions[k];
    EXPECT_FALSE(regions.empty()) << k;
    whole += !regions.empty() && std::abs(regions[0].diameter - 40.5) < 3.0 && (regions[0].centroid - bouncing(k)).norm() < 2.0;
  }
  return whole;
}

TEST(Shadow, AWhiteBallKeepsItsShadedSideInAGrayClip) {
  const cv::Mat background = plain(cv::Scalar::all(170));
  const Footage footage = film("grayside", [&](int k) {
    cv::Mat frame = background.clone();
    draw_ball(frame, bouncing(k), 20.0, cv::Scalar::all(240));
    return gray(frame);
  });
  EXPECT_GE(whole_balls(footage), 26);  // in a few frames the band that is as bright as the wall parts it
}

/// Half of the ball is the floor with less light, as far as colours tell; its outline says that it is a ball.
TEST(Shadow, ABallKeepsItsShadedSideOfTheFloorsColor) {
  const cv::Mat background = plain(cv::Scalar(100, 160, 110));
  const Footage footage = film("greenside", [&](int k) {
    cv::Mat frame = background.clone();
    draw_ball(frame, bouncing(k), 20.0, cv::Scalar(112, 208, 143));
    return frame;
  });
  EXPECT_GE(whole_balls(footage), 27);
}

/// A part with a rim of the floor around it: what is left without the shadow reaches around that, as a body does around its shaded side; the
/// floor's texture in it tells. Where it is not `textured`, the dark place is a patch on the body.
Shade shade_within_a_rim(const cv::Mat& floor, bool textured, cv::Mat& dark) {
  cv::Mat ball = cv::Mat::zeros(floor.size(), CV_8U), part, frame = floor.clone(), shaded;
  const Vec2 center(150.0, 100.0);
  dark = ball.clone();
  draw_disc(ball, center, 24.0, cv::Scalar::all(255));
  draw_disc(dark, center + Vec2(18.0, 20.0), 18.0, cv::Scalar::all(255));
  dark &= ~ball;
  if (textured) floor.convertTo(shaded, CV_8UC3, 0.65);
  else shaded = cv::Mat(floor.size(), CV_8UC3, cv::mean(floor) * 0.65);
  shaded.copyTo(frame, dark);
  frame.setTo(cv::Scalar(220, 90, 60), ball);
  Random random(4);
  add_noise(frame, 2.0, random);
  cv::dilate(ball | dark, part, cv::getStructuringElement(cv::MORPH_ELLIPSE, {9, 9}));
  return find_shade(frame, {floor, cv::Mat(floor.size(), CV_32F, cv::Scalar(2.0))}, worst_difference(frame, floor), part);
}

TEST(Shadow, TheFloorsTextureTellsAShadowThatLiesWithinTheRestOfAPart) {
  cv::Mat dark;
  const Shade shade = shade_within_a_rim(wall(), true, dark);
  EXPECT_GT(cv::countNonZero(shade.mask & dark), 0.8 * cv::countNonZero(dark));
  const Shade none = shade_within_a_rim(wall(), false, dark);
  EXPECT_LT(cv::countNonZero(none.mask & dark), 0.2 * cv::countNonZero(dark));
}

/// Two sides of a box that tumbles: one red, one of the wall's colour in less light; and the shadow that it casts on a wall close behind.
TEST(Shadow, ABoxKeepsItsSideOfTheWallsColor) {
  const cv::Mat background = plain(cv::Scalar(132, 138, 142));
  const auto draw = [](cv::Mat& frame, int k, double from, double to, const cv::Scalar& color) {
    const double turn = 0.3 + 0.05 * k;
    const Vec2 e1(std::cos(turn), std::sin(turn)), e2(-e1.y(), e1.x()), c = bouncing(k) - Vec2(0, 30);
    std::vector<cv::Point> corners;
    for (const auto& [u, v] : {std::pair(from, -18.0), {to, -18.0}, {to, 18.0}, {from, 18.0}}) {
      const Vec2 p = c + u * e1 + v * e2;
      corners.emplace_back(cv::Point(cvRound(p.x()), cvRound(p.y())));
    }
    cv::fillConvexPoly(frame, corners, color, cv::LINE_AA);
  };
  for (const bool shadow : {false, true}) {
    const Footage footage = film("graybox", [&](int k) {
      cv::Mat frame = background.clone();
      if (shadow) {
        cv::Mat beside = frame.clone();
        draw(beside, k, -24.0, 26.0, cv::Scalar(100, 105, 108));
        const cv::Mat move = (cv::Mat_<double>(2, 3) << 1, 0, 4, 0, 1, 6);
        cv::warpAffine(beside, frame, move, frame.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
      }
      draw(frame, k, -24.0, 0.0, cv::Scalar(60, 60, 190));
      draw(frame, k, 0.0, 26.0, shadow ? cv::Scalar(70, 160, 60) : cv::Scalar(100, 105, 108));
      return frame;
    });
    int whole = 0;
    for (int k = 5; k < 35; ++k) {
      ASSERT_FALSE(footage.regions[k].empty()) << k;
      whole += std::abs(footage.regions[k][0].area / (50.0 * 36.0) - 1.0) < 0.15;
    }
    EXPECT_GE(whole, 27) << (shadow ? "with a shadow beside it" : "");
  }
}

/// The shadow on the floor never bounces, and is seen in every frame as one long flight.
TEST(Shadow, AFlatShadowIsFollowedLessThanItsBall) {
  Candidates candidates(60);
  for (int k = 0; k < 60; ++k) {
    const double t = k < 22 ? k : k < 45 ? k - 22.0 : k - 45.0;
    const double height = 0.25 * (k < 22 ? 22.0 * 22.0 - t * t : t * ((k < 45 ? 23.0 : 15.0) - t));
    Candidate ball, shadow;
    ball.frame = shadow.frame = k;
    ball.u = shadow.u = k;
    ball.pixel = {300.0 + 2.0 * k, 320.0 - height};
    ball.diameter = 36.0, ball.area = 1018.0, ball.round = 0.95;
    shadow.pixel = {320.0 + 2.0 * k, 345.0};
    shadow.diameter = 7.0, shadow.area = 230.0, shadow.round = 0.19;
    candidates[static_cast<std::size_t>(k)] = {ball, shadow};
  }
  Context context;
  const Tracks tracks = find_chain(bounce_shot(), ShotCamera(), candidates, 0, 120.0, 0.3, context);
  ASSERT_FALSE(tracks.points.empty());
  for (const TrackPoint& p : tracks.points) EXPECT_EQ(p.diameter, 36.0);
}

}  // namespace
}  // namespace unseen::collision::test
