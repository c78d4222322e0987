// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <algorithm>

#include "interactions/database/cut.h"
#include "interactions/database/saliency.h"
#include "interactions/scenelets_sample.h"
#include "unseen/core/error.h"

namespace unseen::interactions {
namespace {

Database build(const std::vector<Recording>& recordings) {
  Context context;
  return build_database(recordings, {}, context);
}

TEST(Cut, CoversTheArcLengthOfAStraightWalk) {
  const Recording r = simple_recording(6, 0, 50);
  const std::vector<Track> tracks = tracks_of(r.people[0], r.fps, r.name);
  ASSERT_EQ(tracks.size(), 1u);
  const std::vector<Clip> clips = cut(tracks[0], r.fps, {});
  int walking = 0;
  for (std::size_t i = 1; i < clips.size() && clips[i].last < 6 * 50; ++i, ++walking) {
    EXPECT_NEAR(clips[i].last - clips[i].first, 30, 2);                      // 0.6 m at 1 m/s and 50 frames/s
    EXPECT_NEAR(clips[i].middle - clips[i - 1].middle, 5, 1);                // 0.1 m
    EXPECT_NEAR(clips[i].middle * 2, clips[i].last + clips[i].first, 2);
  }
  EXPECT_GT(walking, 45);
}

TEST(Cut, OfAStillSitterLastsTwoSecondsAndComesEverySecond) {
  Track track;
  Random random(3);
  for (int i = 0; i < 300; ++i) {  // 30 s at 10 frames/s with a millimetre of noise
    track.poses.push_back(simple_pose(1));
    track.poses.back().colwise() += Vec3(0.001 * random.normal(), 0.001 * random.normal(), 0.001 * random.normal());
  }
  track.valid.assign(300, true);
  track.actions.assign(300, Action::sit);
  const std::vector<Clip> clips = cut(track, 10, {});
  EXPECT_NEAR(static_cast<double>(clips.size()), 28, 1);
  for (const Clip& clip : clips) EXPECT_EQ(clip.last - clip.first, 20);
}

TEST(Cut, SmoothingTakesJitterAndLeavesTheWay) {
  Random random(4);
  std::vector<Vec3> path, noisy;
  for (int i = 0; i < 400; ++i) {
    path.emplace_back(0.002 * i, 0, 1);
    noisy.push_back(path.back() + 0.002 * Vec3(random.normal(), random.normal(), random.normal()));
  }
  const std::vector<Vec3> smooth = smoothed(noisy);
  double rough_length = 0, length = 0, farthest = 0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    rough_length += (noisy[i] - noisy[i - 1]).norm();
    length += (smooth[i] - smooth[i - 1]).norm();
    if (i > 30 && i < 370) farthest = std::max(farthest, (smooth[i] - path[i]).tail<2>().norm());  // the ends draw in
  }
  EXPECT_GT(rough_length, 2 * 0.8);
  EXPECT_NEAR(length, 0.8, 0.1);
  EXPECT_LT(farthest, 0.003);
}

TEST(Tracks, ShortGapsAreInterpolatedAndLongOnesSplit) {
  Recording r = simple_recording(4, 0);
  auto& frames = r.people[0];
  const std::vector<RecordedFrame> all = frames;
  std::erase_if(frames, [](const RecordedFrame& f) { return f.frame % 2 == 1 || (f.frame > 20 && f.frame < 30); });
  const std::vector<Track> tracks = tracks_of(frames, r.fps, r.name);
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_EQ(tracks[0].first_frame, 0);
  EXPECT_EQ(tracks[0].poses.size(), 21u);
  EXPECT_EQ(tracks[1].first_frame, 30);
  for (std::size_t i = 0; i < 21; ++i) {
    EXPECT_EQ(tracks[0].valid[i], i % 2 == 0);
    EXPECT_LT((tracks[0].poses[i].col(pelvis) - all[i].pose.col(pelvis)).norm(), 1e-9);  // it walks straight
  }
}

TEST(Tracks, FramesOutOfOrderAreTheCallersFault) {
  Recording r = simple_recording(2, 0);
  std::swap(r.people[0][3], r.people[0][4]);
  EXPECT_THROW(build({r}), InputError);
  r = simple_recording(2, 0);
  r.people[0][3].pose(0, 0) = std::nan("");
  EXPECT_THROW(build({r}), InputError);
  r = simple_recording(2, 0);
  r.fps = 0;
  EXPECT_THROW(build({r}), InputError);
}

TEST(Database, ScenesStandInTheFrameOfTheMiddlePose) {
  const Recording r = simple_recording(5, 10);
  const Database database = build({r});
  ASSERT_GT(database.scenelets.size(), 20u);
  for (const Scenelet& s : database.scenelets) {
    const Placement frame = frame_of(s.poses[static_cast<std::size_t>(s.middle)]);
    EXPECT_LT(frame.position.norm(), 1e-9);
    EXPECT_NEAR(frame.angle, 0, 1e-9);
    EXPECT_LT((s.origin * s.poses[static_cast<std::size_t>(s.middle)] - r.people[0][static_cast<std::size_t>(s.center)].pose).norm(), 1e-9);
    for (const Object& object : s.objects) EXPECT_LT(((s.origin * object).center() - r.objects[static_cast<std::size_t>(object.id)].center()).norm(), 1e-9);
    EXPECT_EQ(s.poses.size(), s.valid.size());
    EXPECT_EQ(s.poses.size(), s.actions.size());
  }
}

TEST(Database, ObjectsAreThoseWithinReachOfTheFootprint) {
  Recording r = simple_recording(5, 0);
  r.objects = {box_object(0, "couch", "seat", Vec3(2, 2.9, 0.4), Vec3(30, 4, 0.4)),   // its side is 0.9 m from the way, its centre 2.9 m
               box_object(1, "table", "top", Vec3(2, -3.1, 0.7), Vec3(30, 4, 0.1))};  // 1.1 m
  const Database database = build({r});
  ASSERT_GT(database.scenelets.size(), 20u);
  for (const Scenelet& s : database.scenelets) {
    ASSERT_EQ(s.objects.size(), 1u);
    EXPECT_EQ(s.objects[0].category, "couch");
  }
}

TEST(Saliency, IsTheFormulaOfTheThesis) {
  const Database database = build({simple_recording(4, 6), simple_recording(3, 2, 10, "another")});
  const std::vector<double> density = densities(database.scenelets);
  std::vector<Eigen::Matrix<float, kJointLines, kDescriptorPoses>> motions;
  for (const Scenelet& s : database.scenelets) motions.push_back(motion_descriptor(s.poses));
  for (std::size_t l = 0; l < database.scenelets.size(); l += 7) {
    const Scenelet& s = database.scenelets[l];
    for (std::size_t j = 0; j < s.layout.size(); ++j) {
      double above = 0, below = 0;
      for (std::size_t k = 0; k < database.scenelets.size(); ++k) {
        const double g = std::exp(-0.5 * std::pow(motion_distance(motions[l], motions[k]) / 0.13, 2)) / density[k];
        above += g * static_cast<double>(database.scenelets[k].layout[j]);
        below += g;
      }
      EXPECT_NEAR(s.saliency[j], above / below, 1e-4);
    }
  }
}

TEST(Saliency, IsHighForSittingAndLowForWalking) {
  std::vector<Recording> recordings;
  for (int i = 0; i < 6; ++i) {  // the table stands somewhere else in each
    recordings.push_back(simple_recording(5, 5, 10, "recording " + std::to_string(i)));
    recordings.back().objects[1].parts[0].box.center = Vec3(0.8 * i, i % 2 ? 0.9 : -0.9, 0.7);
  }
  const Database database = build(recordings);
  int walks = 0, sits = 0;
  for (const Scenelet& s : database.scenelets) {
    const bool walking = std::all_of(s.actions.begin(), s.actions.end(), [](Action a) { return a == Action::walk; });
    const bool sitting = s.middle == 10;  // a second before the middle: it does not move
    EXPECT_TRUE(!walking || s.highest_saliency < 0.35) << s.highest_saliency;
    EXPECT_TRUE(!sitting || s.highest_saliency > 0.6) << s.highest_saliency;
    walks += walking;
    sits += sitting;
  }
  EXPECT_GT(walks, 20);
  EXPECT_GT(sits, 10);
}

TEST(Saliency, DensityIsTheKernelEstimate) {
  std::vector<Scenelet> two(3);
  two[1].origin.position = Vec3(0.2, 0, 0);
  two[2].recording = 1;
  const double peak = 1 / (2 * kPi * 0.04);
  const std::vector<double> density = densities(two);
  EXPECT_NEAR(density[0], peak * (1 + std::exp(-0.5)), 1e-9);
  EXPECT_NEAR(density[2], peak, 1e-9);
}

TEST(Join, IsTheDatabaseOfAllRecordings) {
  const Recording a = simple_recording(4, 6), b = simple_recording(3, 2, 10, "another");
  const Database both = build({a, b}), joined = join({build({a}), build({b}), build({a})}, {}, {});  // what is there is not taken twice
  ASSERT_EQ(joined.scenelets.size(), both.scenelets.size());
  ASSERT_EQ(joined.recordings.size(), 2u);
  for (std::size_t i = 0; i < both.scenelets.size(); ++i) {
    EXPECT_EQ(joined.scenelets[i].recording, both.scenelets[i].recording);
    EXPECT_EQ(joined.scenelets[i].saliency, both.scenelets[i].saliency);
    EXPECT_EQ(joined.scenelets[i].highest_saliency, both.scenelets[i].highest_saliency);
  }
}

TEST(Join, OfNothingIsEmpty) { EXPECT_TRUE(join({}, {}, {}).scenelets.empty()); }

}  // namespace
}  // namespace unseen::interactions
