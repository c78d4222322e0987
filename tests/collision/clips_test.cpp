// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>

#include "collision/tracks/tracks.h"
#include "collision/video/regions.h"

namespace unseen::collision::test {
namespace {

namespace fs = std::filesystem;

const fs::path kData = fs::path(UNSEEN_SOURCE_DIR) / "../shared/data/collision";

struct Found {
  Footage footage;
  Tracks tracks;
  std::vector<std::string> warnings;
};

/// Tracks of a clip; of one ball and a floor unless `two` are free. Nothing if the clip is not there.
std::optional<Found> look_at(const std::string& name, std::optional<double> fps = {}, bool two = false) {
  if (!fs::exists(kData / name)) return {};
  Shot shot;
  shot.name = name;
  shot.video = (kData / name).string();
  shot.fps = fps;
  shot.bodies.resize(2);
  for (Body& body : shot.bodies) body.radius = 0.03;
  if (!two) shot.bodies[1].shape = Shape::fixed;
  if (two) shot.gravity = 0.0;
  Context context;
  Found found;
  found.footage = find_regions(shot, context);
  ShotCamera camera;
  camera.camera = {1000, 1000, 0.5 * found.footage.width, 0.5 * found.footage.height, found.footage.width, found.footage.height};
  found.tracks = find_tracks(shot, camera, found.footage, context);
  found.warnings = context.take_warnings();
  return found;
}

/// Centroids by another tracker, by frame.
std::map<int, Vec2> other_track(const std::string& name) {
  std::map<int, Vec2> track;
  std::ifstream in(kData / "tracks" / name);
  for (std::string line; std::getline(in, line);) {
    double frame = 0, x = 0, y = 0;
    char comma = 0;
    if (std::istringstream(line) >> frame >> comma >> x >> comma >> y) track[static_cast<int>(frame)] = {x, y};
  }
  return track;
}

/// Median distance of the flights' points from another tracker's, px.
double median_off(const Tracks& tracks, const std::map<int, Vec2>& other) {
  std::vector<double> off;
  for (const TrackPoint& p : tracks.points)
    if (const auto it = other.find(p.frame); it != other.end()) off.push_back((p.pixel - it->second).norm());
  std::sort(off.begin(), off.end());
  return off.empty() ? 1e9 : off[off.size() / 2];
}

bool meets_near(const Tracks& tracks, double frame, double fps, double tolerance) {
  for (const auto& m : tracks.meetings)
    if (std::abs(m.time * fps - frame) < tolerance) return true;
  return false;
}

TEST(Clips, BallOnAFloor) {
  const auto found = look_at("arza_bounceAmeen.avi");
  if (!found) GTEST_SKIP() << "the shared clips are not there";
  EXPECT_GE(found->tracks.meetings.size(), 4u);
  // The lowest points of the other track: 76 and 77, 91 and 92, 102, 110.
  for (const double frame : {76.3, 91.5, 102.2, 110.0}) EXPECT_TRUE(meets_near(found->tracks, frame, found->footage.fps, 0.6)) << frame;
  EXPECT_LT(median_off(found->tracks, other_track("arza_bounceAmeen_track.csv")), 3.0);
  for (const TrackPoint& p : found->tracks.points) EXPECT_NEAR(p.diameter, 86.0, 12.0) << p.frame;
}

TEST(Clips, TennisBallInAThinnedClip) {
  const auto found = look_at("and_tennis.mp4", 20.0);
  if (!found) GTEST_SKIP() << "the shared clips are not there";
  EXPECT_GE(found->tracks.meetings.size(), 3u);
  EXPECT_LT(median_off(found->tracks, other_track("and_tennis_track.csv")), 2.0);
  ASSERT_FALSE(found->warnings.empty());
  EXPECT_NE(found->warnings.back().find("one frame in 6"), std::string::npos);
  // Between frames 5 and 6 the ball falls two steps; at 24 pictures a second gravity fits its size (390 px/m within a tenth).
  const FlightSpan& first = found->tracks.spans.front();
  double fall = 0, count = 0;
  for (std::size_t i = first.begin; i + 2 < first.end; ++i) {
    const TrackPoint &a = found->tracks.points[i], &b = found->tracks.points[i + 1], &c = found->tracks.points[i + 2];
    fall += 2.0 * ((c.pixel.y() - b.pixel.y()) / (c.time - b.time) - (b.pixel.y() - a.pixel.y()) / (b.time - a.time)) / (c.time - a.time);
    ++count;
  }
  EXPECT_NEAR(fall / count / 9.81, 390.0, 45.0);
}

TEST(Clips, TableTennisBall) {
  const auto found = look_at("and_pong_h1.mp4", 20.0);
  if (!found) GTEST_SKIP() << "the shared clips are not there";
  EXPECT_GE(found->tracks.meetings.size(), 3u);
  for (const double frame : {7.8, 17.7, 25.2}) EXPECT_TRUE(meets_near(found->tracks, frame, 20.0, 0.5)) << frame;
  EXPECT_LT(median_off(found->tracks, other_track("and_pong_h1_track.csv")), 2.0);
}

TEST(Clips, ATossIsOneFlight) {
  const auto found = look_at("tracker_BallTossOut.mov");
  if (!found) GTEST_SKIP() << "the shared clips are not there";
  EXPECT_EQ(found->tracks.spans.size(), 1u);
  EXPECT_GE(found->tracks.points.size(), 17u);
  EXPECT_TRUE(found->tracks.meetings.empty());
}

TEST(Clips, ABallThatFallsBackIntoTheHandMeetsNothing) {
  const auto found = look_at("trfl_ball.mp4");
  if (!found) GTEST_SKIP() << "the shared clips are not there";
  EXPECT_GE(found->tracks.points.size(), 10u);
  EXPECT_TRUE(found->tracks.meetings.empty());
}

TEST(Clips, AGliderInTheAirMeetsNothing) {
  const auto found = look_at("tracker_diabolo_cm2.mp4", 240.0);
  if (!found) GTEST_SKIP() << "the shared clips are not there";
  EXPECT_TRUE(found->tracks.meetings.empty());
}

TEST(Clips, APoorClipMeetsNothing) {
  const auto found = look_at("lfel_bola.mp4");
  if (!found) GTEST_SKIP() << "the shared clips are not there";
  EXPECT_TRUE(found->tracks.meetings.empty());
}

TEST(Clips, ManyCollisionsWithFlickerAndHands) {
  const auto found = look_at("ppb_flummies.webm", {}, true);
  if (!found) GTEST_SKIP() << "the shared clips are not there";
  EXPECT_LE(found->tracks.meetings.size(), 1u);
  EXPECT_EQ(found->tracks.collisions_seen > 0, !found->tracks.meetings.empty());
}

}  // namespace
}  // namespace unseen::collision::test
