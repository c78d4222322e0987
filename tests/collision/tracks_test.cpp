// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/tracks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <set>

#include "collision/pair_scene.h"
#include "collision/tracks/arcs.h"
#include "collision/tracks/chain.h"
#include "unseen/core/random.h"

namespace unseen::collision::test {
namespace {

constexpr double kDepth = 2.0, kPixels = kFocal / kDepth;  ///< m; px a metre

Body floor_body() {
  Body b;
  b.name = "floor";
  b.shape = Shape::fixed;
  return b;
}

Sighting seen(int frame, const Vec2& metres, double radius, int body, double noise, Random& random) {
  return {frame, Vec2(640, 360) + kPixels * metres + noise * Vec2(random.normal(), random.normal()), kPixels * radius, body};
}

bool warned(Context& context, const std::string& word) {
  for (const std::string& w : context.take_warnings())
    if (w.find(word) != std::string::npos) return true;
  return false;
}

/// A ball that falls from 0.6 m above the floor (y down, floor at y = 0.6) and bounces.
struct Bouncing {
  double c = 0.75, vx = 0.2;
  std::vector<double> impacts;

  Vec2 at(double t) {
    const double g = 9.81;
    double start = 0.0, y0 = 0.0, v = 0.0;
    impacts.clear();
    for (;;) {
      const double hit = start + (-v + std::sqrt(v * v + 2.0 * g * (0.6 - y0))) / g;
      if (t <= hit || impacts.size() > 20) break;
      v = -c * (v + g * (hit - start));
      y0 = 0.6;
      start = hit;
      impacts.push_back(hit);
    }
    const double s = t - start;
    return {-0.4 + vx * t, y0 + v * s + 0.5 * g * s * s};
  }
};

Shot chain_shot() {
  Shot shot;
  shot.name = "shot";
  shot.bodies = {ball("ball", 0.03), floor_body()};
  return shot;
}

TEST(Chain, EveryBounceAtItsTime) {
  Random random(1);
  Bouncing motion;
  std::vector<Sighting> sightings;
  for (int k = 0; k < 200; ++k)
    if (random.uniform() > 0.1) sightings.push_back(seen(k, motion.at(k / kFps), 0.03, -1, 0.5, random));
  motion.at(199 / kFps);
  Context context;
  const Tracks tracks = find_tracks(chain_shot(), camera(), sightings, kFps, context);
  ASSERT_GE(tracks.meetings.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(tracks.meetings[i].time, motion.impacts[i], 0.15 / kFps) << i;
  EXPECT_EQ(tracks.collisions_seen, static_cast<int>(tracks.meetings.size()));
  EXPECT_NEAR(tracks.noise, 0.5, 0.15);
  for (const FlightSpan& span : tracks.spans)
    for (std::size_t i = span.begin; i < span.end; ++i) {
      EXPECT_EQ(tracks.points[i].body, 0);
      EXPECT_NEAR(tracks.points[i].diameter, 30.0, 1e-9);
      // No point of a span lies on the other side of an impact.
      for (const double t : motion.impacts)
        EXPECT_FALSE(tracks.points[span.begin].time < t - 0.2 / kFps && tracks.points[i].time > t + 0.2 / kFps);
    }
}

// 24 frames a second in 60: one and two by turns repeat the frame before.
TEST(Chain, AConvertedFilmIsFollowedByItsOwnFrames) {
  Bouncing motion;
  Footage footage;
  footage.width = 1280, footage.height = 720, footage.fps = 60;
  for (int k = 0; k < 90; ++k) {
    const int own = 2 * (k / 5) + (k % 5 >= 2 ? 1 : 0);
    footage.times.push_back(own / 24.0);
    footage.doubled.push_back(k % 5 == 1 || k % 5 > 2);
    Region region;
    region.frame = k;
    region.centroid = Vec2(640, 360) + kPixels * motion.at(own / 24.0);
    region.diameter = region.circle = 30;
    region.area = 0.25 * kPi * 900;
    region.box = {static_cast<int>(region.centroid.x()) - 15, static_cast<int>(region.centroid.y()) - 15, 31, 31};
    region.mask = cv::Mat::zeros(31, 31, CV_8U);
    cv::circle(region.mask, {15, 15}, 15, cv::Scalar(255), cv::FILLED);
    footage.regions.push_back({region});
  }
  motion.at(1.4);
  Context context;
  Shot shot = chain_shot();
  shot.video = "converted.mp4";
  const Tracks tracks = find_tracks(shot, camera(), footage, context);
  ASSERT_GE(tracks.meetings.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(tracks.meetings[i].time, motion.impacts[i], 0.01) << i;
  for (const TrackPoint& p : tracks.points) EXPECT_NEAR(p.time, footage.times[static_cast<std::size_t>(p.frame)], 1e-9);
  EXPECT_TRUE(context.take_warnings().empty());
}

// In a few frames a shaded side of the ball passes for background: the outline is smaller there, and its centre is off.
TEST(Chain, FramesInWhichAPartOfTheBallIsNotSeenBreakNoFlight) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    Random random(seed);
    Bouncing ball;
    std::vector<Sighting> sightings;
    for (int k = 0; k < 150; k += 2) {
      Sighting s = seen(k, ball.at(k / kFps), 0.05, 0, 0.3, random);
      if (const double part = 0.12 + 0.06 * random.uniform(); random.uniform() < 0.2) s.radius *= 1.0 - part, s.pixel.y() -= 50.0 * part;
      sightings.push_back(s);
    }
    Shot shot = chain_shot();
    shot.video = "film";
    Context context;
    const Tracks tracks = find_chain(shot, camera(), candidates_of(sightings, camera()), 0, kFps, 0.5, context);
    ASSERT_EQ(tracks.meetings.size(), ball.impacts.size()) << seed;
    for (std::size_t i = 0; i < ball.impacts.size(); ++i) EXPECT_NEAR(tracks.meetings[i].time, ball.impacts[i], 1.0 / kFps) << seed;
  }
}

TEST(Chain, RestingAndHeldFramesAreNoFlight) {
  Random random(2);
  std::vector<Sighting> sightings;
  for (int k = 0; k < 120; ++k) {  // held, dropped, rolls along the floor
    const double t = std::clamp((k - 40) / kFps, 0.0, 0.3);
    sightings.push_back(seen(k, {k < 76 ? 0.0 : 0.3 * (k - 76) / kFps, 4.905 * t * t}, 0.03, -1, 0.4, random));
  }
  Context context;
  const Tracks tracks = find_tracks(chain_shot(), camera(), sightings, kFps, context);
  ASSERT_EQ(tracks.spans.size(), 1u);
  EXPECT_TRUE(tracks.meetings.empty());
  EXPECT_NEAR(tracks.points.front().frame, 41, 7);
  EXPECT_NEAR(tracks.points.back().frame, 76, 2);
}

TEST(Chain, ALostFrameIsFoundAndPutBack) {
  Random random(3);
  Bouncing motion;
  std::vector<Sighting> sightings;
  for (int k = 0; k < 120; ++k) sightings.push_back(seen(k, motion.at((k + (k >= 25 ? 1 : 0)) / kFps), 0.03, -1, 0.3, random));
  motion.at(120 / kFps);
  Context context;
  const Tracks tracks = find_tracks(chain_shot(), camera(), sightings, kFps, context);
  EXPECT_TRUE(warned(context, "after frame 24"));
  for (const TrackPoint& p : tracks.points) EXPECT_NEAR(p.time, (p.frame + (p.frame >= 25 ? 1 : 0)) / kFps, 1e-9);
  ASSERT_GE(tracks.meetings.size(), 2u);
  EXPECT_NEAR(tracks.meetings[0].time, motion.impacts[0], 0.15 / kFps);
}

TEST(Chain, ThinnedClipsKeepTheirDuration) {
  // Every sixth frame of 144 a second is dropped and the rest is said to come at 120.
  Random random(4);
  Bouncing motion;
  std::vector<Sighting> sightings;
  for (int k = 0; k < 150; ++k) sightings.push_back(seen(k, motion.at((k + k / 5) / 144.0), 0.03, -1, 0.3, random));
  motion.at(180 / 144.0);
  Context context;
  const Tracks tracks = find_tracks(chain_shot(), camera(), sightings, kFps, context);
  EXPECT_TRUE(warned(context, "one frame in 6"));
  for (const TrackPoint& p : tracks.points) EXPECT_NEAR(p.time, (p.frame + p.frame / 5) / 144.0, 1e-9);
  ASSERT_GE(tracks.meetings.size(), 2u);
  EXPECT_NEAR(tracks.meetings[1].time, motion.impacts[1], 0.2 / 144.0);
}

TEST(Chain, AFlightAloneHasNoMeeting) {
  Random random(5);
  std::vector<Sighting> sightings;
  for (int k = 0; k < 60; ++k) {
    const double t = k / kFps;
    sightings.push_back(seen(k, {-0.5 + 2.0 * t, 0.2 - 2.5 * t + 4.905 * t * t}, 0.03, -1, 1.0, random));
  }
  Context context;
  const Tracks tracks = find_tracks(chain_shot(), camera(), sightings, kFps, context);
  EXPECT_EQ(tracks.spans.size(), 1u);
  EXPECT_GT(tracks.points.size(), 55u);
  EXPECT_TRUE(tracks.meetings.empty());
  EXPECT_TRUE(find_tracks(chain_shot(), camera(), std::vector<Sighting>{}, kFps, context).spans.empty());
}

/// Two balls that meet at 0.5 s.
struct Meeting {
  Vec2 pa{-0.06, 0.0}, pb{0.06, 0.02};
  Vec2 before_a{1.5, 0.4}, before_b{-1.2, -0.3}, after_a{-0.8, 0.0}, after_b{1.0, 0.1};

  Vec2 at(int body, double t, double tc = 0.5) const {
    const double s = t - tc;
    const Vec2 v = body == 0 ? (s < 0 ? before_a : after_a) : (s < 0 ? before_b : after_b);
    return (body == 0 ? pa : pb) + v * s + Vec2(0, 4.905 * s * s);
  }
};

void expect_pair(const Tracks& tracks, const Meeting& motion, double tc, int least) {
  ASSERT_EQ(tracks.meetings.size(), 1u);
  EXPECT_NEAR(tracks.meetings[0].time, tc, 0.3 / kFps);
  ASSERT_EQ(tracks.spans.size(), 4u);
  for (const int s : tracks.meetings[0].before) EXPECT_LT(tracks.points[tracks.spans[static_cast<std::size_t>(s)].end - 1].time, tc);
  for (const int s : tracks.meetings[0].after) EXPECT_GE(tracks.points[tracks.spans[static_cast<std::size_t>(s)].begin].time, tc);
  for (const FlightSpan& span : tracks.spans) {
    EXPECT_GE(static_cast<int>(span.end - span.begin), least);
    for (std::size_t i = span.begin; i < span.end; ++i) {
      const TrackPoint& p = tracks.points[i];
      EXPECT_EQ(p.body, span.body);
      EXPECT_LT((p.pixel - Vec2(640, 360) - kPixels * motion.at(p.body, p.time, tc)).norm(), 6.0) << p.frame << " " << p.body;
    }
  }
}

/// Unlabelled sightings of both, in an order that says nothing, with a share missing.
std::vector<Sighting> both(const Meeting& motion, double ra, double rb, double noise, double missing, Random& random, int gap = 0) {
  std::vector<Sighting> sightings;
  for (int k = 20; k < 100; ++k) {
    if (std::abs(k - 60) < gap) continue;
    std::vector<Sighting> frame;
    if (random.uniform() >= missing) frame.push_back(seen(k, motion.at(0, k / kFps), ra, -1, noise, random));
    if (random.uniform() >= missing) frame.push_back(seen(k, motion.at(1, k / kFps), rb, -1, noise, random));
    if (frame.size() == 2 && random.uniform() < 0.5) std::swap(frame[0], frame[1]);
    sightings.insert(sightings.end(), frame.begin(), frame.end());
  }
  return sightings;
}

TEST(Pair, FourFlightsOfUnlabelledSightings) {
  Random random(6);
  const Meeting motion;
  Context context;
  const Tracks tracks = find_tracks(pair_shot(0.08, 0.05), camera(), both(motion, 0.08, 0.05, 0.5, 0.0, random), kFps, context);
  expect_pair(tracks, motion, 0.5, 25);
  EXPECT_EQ(tracks.collisions_seen, 1);
  EXPECT_NEAR(tracks.noise, 0.5, 0.15);
}

TEST(Pair, MissingFramesAndAHiddenImpact) {
  Random random(7);
  const Meeting motion;
  Context context;
  expect_pair(find_tracks(pair_shot(0.08, 0.05), camera(), both(motion, 0.08, 0.05, 0.7, 0.3, random, 6), kFps, context), motion, 0.5, 12);
}

TEST(Pair, AFlightGoesOnWhereSilhouettesHadMerged) {
  Random random(17);
  const Meeting motion;
  std::vector<Sighting> sightings = both(motion, 0.08, 0.05, 0.5, 0.0, random);
  std::erase_if(sightings, [](const Sighting& s) { return s.frame > 68 && s.frame < 80; });
  Context context;
  const Tracks tracks = find_tracks(pair_shot(0.08, 0.05), camera(), sightings, kFps, context);
  expect_pair(tracks, motion, 0.5, 20);
  for (const int s : tracks.meetings[0].after) {
    EXPECT_LT(tracks.points[tracks.spans[static_cast<std::size_t>(s)].begin].frame, 64);
    EXPECT_GT(tracks.points[tracks.spans[static_cast<std::size_t>(s)].end - 1].frame, 95);
  }
  EXPECT_EQ(tracks.collisions_seen, 1);
}

TEST(Arcs, EndWhereSilhouettesMergeAtTheImpact) {
  Random random(18);
  const Meeting motion;
  std::vector<Sighting> sightings = both(motion, 0.08, 0.05, 0.1, 0.0, random);
  std::erase_if(sightings, [](const Sighting& s) { return s.frame > 56 && s.frame < 63; });
  for (int k = 57; k < 63; ++k) {
    const double t = k / kFps;
    sightings.push_back(seen(k, 0.72 * motion.at(0, t) + 0.28 * motion.at(1, t), 0.09, -1, 0.1, random));  // of both together
  }
  Context context;
  const std::vector<Arc> arcs = find_arcs(candidates_of(sightings, camera()), 0.5, 0.5, context);
  ASSERT_GE(arcs.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_GE(arcs[i].points.size(), 35u);
    EXPECT_TRUE(arcs[i].end() < 57.0 || arcs[i].begin() > 62.0) << arcs[i].begin() << " to " << arcs[i].end();
  }
}

TEST(Pair, AThirdMoverIsLeftOut) {
  Random random(8);
  const Meeting motion;
  std::vector<Sighting> sightings = both(motion, 0.08, 0.05, 0.5, 0.1, random);
  for (int k = 20; k < 100; ++k) {
    const double t = k / kFps - 0.5;
    sightings.push_back(seen(k, {0.5 - 0.9 * t, -0.3 + 0.5 * t + 4.905 * t * t}, 0.06, -1, 0.5, random));
    if (k % 3 == 0) sightings.push_back(seen(k, {random.uniform(-1, 1), random.uniform(-0.6, 0.6)}, 0.05, -1, 0.5, random));
  }
  Context context;
  const Tracks tracks = find_tracks(pair_shot(0.08, 0.05), camera(), sightings, kFps, context);
  expect_pair(tracks, motion, 0.5, 20);
}

TEST(Pair, SizesSayWhichIsWhich) {
  Random random(9);
  Meeting motion, exchanged;
  std::swap(exchanged.pa, exchanged.pb);
  std::swap(exchanged.before_a, exchanged.before_b);
  std::swap(exchanged.after_a, exchanged.after_b);
  const auto sightings = both(motion, 0.08, 0.05, 0.5, 0.0, random);
  Context context;
  expect_pair(find_tracks(pair_shot(0.05, 0.08), camera(), sightings, kFps, context), exchanged, 0.5, 25);
}

TEST(Pair, LabelsAreKept) {
  Random random(10);
  const Meeting motion;
  std::vector<Sighting> sightings;
  for (int k = 20; k < 100; ++k)
    for (int body = 1; body >= 0; --body) sightings.push_back(seen(k, motion.at(body, k / kFps), 0.06, body, 0.5, random));
  Context context;
  expect_pair(find_tracks(pair_shot(0.06, 0.06), camera(), sightings, kFps, context), motion, 0.5, 25);
}

TEST(Pair, PassingByIsNoCollision) {
  Random random(11);
  std::vector<Sighting> sightings;
  for (int k = 0; k < 80; ++k) {
    const double t = k / kFps - 0.33;
    sightings.push_back(seen(k, {1.5 * t, 0.2 + 4.905 * t * t}, 0.06, -1, 0.5, random));
    sightings.push_back(seen(k, {-1.2 * t, -0.2 - 0.4 * t + 4.905 * t * t}, 0.06, -1, 0.5, random));
  }
  Context context;
  const Tracks tracks = find_tracks(pair_shot(0.06, 0.06), camera(), sightings, kFps, context);
  EXPECT_TRUE(tracks.meetings.empty());
  EXPECT_EQ(tracks.collisions_seen, 0);
  EXPECT_EQ(tracks.spans.size(), 2u);
}

TEST(Pair, SeveralCollisionsAreCounted) {
  Random random(12);
  const Meeting motion;
  std::vector<Sighting> sightings = both(motion, 0.06, 0.06, 0.4, 0.0, random);
  for (Sighting s : both(motion, 0.06, 0.06, 0.4, 0.0, random)) {
    s.frame += 120;
    s.pixel += Vec2(100, 20);
    sightings.push_back(s);
  }
  Context context;
  const Tracks tracks = find_tracks(pair_shot(0.06, 0.06), camera(), sightings, kFps, context);
  EXPECT_EQ(tracks.collisions_seen, 2);
  EXPECT_EQ(tracks.meetings.size(), 1u);
}

// The background bites into the outline of one ball after the collision: its centre jumps and wanders, and its flight breaks into pieces.
TEST(Pair, PiecesOfAFlightAreNoSecondCollision) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    Random random(seed);
    const Meeting motion;
    std::vector<Sighting> sightings;
    for (int k = 20; k < 110; ++k)
      for (int body = 0; body < 2; ++body)
        if (body == 0 || k < 75) sightings.push_back(seen(k, motion.at(body, k / kFps), body == 0 ? 0.08 : 0.05, -1, 0.4, random));
    for (int begin = 78; begin < 110;) {
      const int end = begin + 5 + static_cast<int>(10.0 * random.uniform());
      const Vec2 off = 8.0 * Vec2(random.uniform() - 0.5, random.uniform() - 0.5), drift = 1.5 * Vec2(random.uniform() - 0.5, random.uniform() - 0.5);
      for (Sighting& s : sightings)
        if (s.frame >= begin && s.frame < end) s.pixel += off + (s.frame - begin) * drift;
      begin = end;
    }
    std::erase_if(sightings, [](const Sighting& s) { return s.frame > 74 && s.frame < 78; });
    Context context;
    EXPECT_EQ(find_tracks(pair_shot(0.08, 0.05), camera(), sightings, kFps, context).collisions_seen, 1) << seed;
  }
}

TEST(Pair, DistortionIsTakenOut) {
  Random random(13);
  const Meeting motion;
  ShotCamera bent = camera();
  bent.distortion = {-0.15, 0.03, 0.0, 0.0, 0.0};
  std::vector<Sighting> sightings = both(motion, 0.08, 0.05, 0.2, 0.0, random);
  for (Sighting& s : sightings) {
    const Vec2 n = (s.pixel - Vec2(640, 360)) / kFocal;
    const double r = n.squaredNorm();
    s.pixel = Vec2(640, 360) + kFocal * (1.0 - 0.15 * r + 0.03 * r * r) * n;
  }
  Context context;
  expect_pair(find_tracks(pair_shot(0.08, 0.05), bent, sightings, kFps, context), motion, 0.5, 25);
}

}  // namespace
}  // namespace unseen::collision::test
