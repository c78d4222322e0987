// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/interactions/synth.h"

#include <gtest/gtest.h>

#include <set>

#include "unseen/core/error.h"

namespace unseen::interactions {
namespace {

constexpr double kHandBreadth = 0.09;  // m

SynthTake take_of(int seed, int people = 1, double fps = 10, double seconds = 40, int objects = 4) {
  SynthOptions options;
  options.seed = seed;
  options.people = people;
  options.fps = fps;
  options.seconds = seconds;
  options.objects = objects;
  return simulate(options);
}

double depth_inside(const OrientedBox& box, const Vec3& p) { return (box.half_size - (box.axes.transpose() * (p - box.center)).cwiseAbs()).minCoeff(); }
double distance_to(const OrientedBox& box, const Vec3& p) {
  return ((box.axes.transpose() * (p - box.center)).cwiseAbs() - box.half_size).cwiseMax(0.0).norm();
}

double lowest_ankle(const std::vector<RecordedFrame>& frames) {
  double z = 1e9;
  for (const RecordedFrame& f : frames) z = std::min({z, f.pose(2, right_ankle), f.pose(2, left_ankle)});
  return z;
}

TEST(Synth, LimbLengthsNeverChange) {
  for (int seed = 0; seed < 6; ++seed) {
    const Recording truth = take_of(seed, 2).truth;
    for (const auto& frames : truth.people)
      for (const auto& [a, b] : kBones) {
        const double length = (frames.front().pose.col(a) - frames.front().pose.col(b)).norm();
        for (const RecordedFrame& f : frames) ASSERT_NEAR((f.pose.col(a) - f.pose.col(b)).norm(), length, 1e-9) << kJointNames[a] << ", frame " << f.frame;
      }
  }
}

TEST(Synth, BodiesHaveHumanProportions) {
  for (int seed = 0; seed < 30; ++seed) {
    const Pose p = take_of(seed, 1, 10, 1).truth.people.at(0).front().pose;
    const auto bone = [&](Joint a, Joint b) { return (p.col(a) - p.col(b)).norm(); };
    const double leg = bone(right_hip, right_knee) + bone(right_knee, right_ankle), arm = bone(right_shoulder, right_elbow) + bone(right_elbow, right_wrist);
    EXPECT_GT(p(2, head), 1.3);
    EXPECT_LT(p(2, head), 1.95);
    EXPECT_NEAR(leg / p(2, head), 0.51, 0.04);  // of people that stand, face 0.93 of the height
    EXPECT_NEAR(arm / leg, 0.66, 0.05);
    EXPECT_NEAR(bone(pelvis, thorax) / leg, 0.60, 0.065);
    EXPECT_GT(bone(right_shoulder, left_shoulder), bone(right_hip, left_hip));
  }
}

TEST(Synth, NobodyIsInsideFurniture) {
  for (int seed = 0; seed < 25; ++seed) {
    const Recording truth = take_of(seed, 1 + seed % 3).truth;
    for (const auto& frames : truth.people)
      for (const RecordedFrame& f : frames)
        for (const Object& object : truth.objects)
          for (const Part& part : object.parts)
            for (int j = 0; j < kJoints; ++j)
              ASSERT_LT(depth_inside(part.box, f.pose.col(j)), kHandBreadth)
                  << kJointNames[static_cast<std::size_t>(j)] << " in " << object.category << " " << part.name << ", seed " << seed << ", frame " << f.frame;
  }
}

TEST(Synth, FeetOnTheFloorDoNotSkate) {
  for (int seed = 0; seed < 8; ++seed) {
    const auto frames = take_of(seed, 1, 30).truth.people.at(0);
    const double sole = lowest_ankle(frames);
    int walking = 0, planted = 0;
    for (std::size_t k = 1; k < frames.size(); ++k) {
      bool any = false;
      for (const Joint ankle : {right_ankle, left_ankle}) {
        const Vec3 before = frames[k - 1].pose.col(ankle), now = frames[k].pose.col(ankle);
        if (std::max(before.z(), now.z()) > sole + 0.001) continue;
        any = true;
        ASSERT_LT((now - before).norm(), 0.012) << "seed " << seed << ", frame " << frames[k].frame;  // a foot about to be lifted moves that much
        planted += (now - before).norm() < 1e-4;
      }
      if (frames[k].action != Action::walk) continue;
      ++walking;
      EXPECT_TRUE(any || std::min(frames[k].pose(2, right_ankle), frames[k].pose(2, left_ankle)) < sole + 0.03) << "nobody jumps; frame " << frames[k].frame;
    }
    EXPECT_GT(planted, 0.8 * walking);
  }
}

TEST(Synth, PeopleWalkAtAWalkingPaceAndNothingJerks) {
  for (int seed = 0; seed < 10; ++seed) {
    const auto frames = take_of(seed, 1, 30).truth.people.at(0);
    for (std::size_t k = 1; k < frames.size(); ++k) {
      const Pose step = (frames[k].pose - frames[k - 1].pose) * 30.0;
      EXPECT_LT(step.col(pelvis).head<2>().norm(), 1.6) << "seed " << seed << ", frame " << frames[k].frame;
      EXPECT_LT(step.colwise().norm().maxCoeff(), 7.0) << "seed " << seed << ", frame " << frames[k].frame;
      if (k < 2) continue;
      const Pose change = (frames[k].pose - 2.0 * frames[k - 1].pose + frames[k - 2].pose) * 900.0;
      EXPECT_LT(change.col(pelvis).norm(), 12.0) << "seed " << seed << ", frame " << frames[k].frame;
    }
  }
}

TEST(Synth, KneesBendForward) {
  for (int seed = 0; seed < 6; ++seed) {
    const auto frames = take_of(seed).truth.people.at(0);
    for (const RecordedFrame& f : frames) {
      if (f.action != Action::walk && f.action != Action::stand) continue;
      for (const auto& [hip, knee, ankle] : {std::array{right_hip, right_knee, right_ankle}, std::array{left_hip, left_knee, left_ankle}}) {
        const Vec3 line = f.pose.col(ankle) - f.pose.col(hip), upper = f.pose.col(knee) - f.pose.col(hip);
        const Vec3 bulge = upper - upper.dot(line) / line.squaredNorm() * line;
        EXPECT_GT(bulge.dot(facing(f.pose)), -0.01) << "seed " << seed << ", frame " << f.frame;
      }
    }
  }
}

TEST(Synth, WhoSitsStillIsOverASeat) {
  int sitting = 0;
  for (int seed = 0; seed < 20; ++seed) {
    const Recording truth = take_of(seed).truth;
    const auto& frames = truth.people.at(0);
    for (std::size_t k = 5; k < frames.size(); ++k) {
      bool still = true;
      for (std::size_t i = k - 5; i <= k; ++i) still = still && frames[i].action == Action::sit && (frames[i].pose.col(pelvis) - frames[k].pose.col(pelvis)).norm() < 1e-6;
      if (!still) continue;
      ++sitting;
      double least = 1e9;
      for (const Object& object : truth.objects)
        for (const Part& part : object.parts)
          if (part.name == "seat" && part.box.contains(Vec3(frames[k].pose(0, pelvis), frames[k].pose(1, pelvis), part.box.center.z())))
            least = std::min(least, frames[k].pose(2, pelvis) - part.box.center.z() - part.box.half_size.z());
      EXPECT_GT(least, 0.03) << "seed " << seed << ", frame " << frames[k].frame;
      EXPECT_LT(least, 0.15) << "seed " << seed << ", frame " << frames[k].frame;
    }
  }
  EXPECT_GT(sitting, 500);
}

TEST(Synth, UsedObjectsAreTouchedAndOthersAreNotSatOn) {
  for (int seed = 0; seed < 40; ++seed) {
    const Recording truth = take_of(seed, 1 + seed % 2).truth;
    const std::set<int> used(truth.interacted.begin(), truth.interacted.end());
    for (const Object& object : truth.objects) {
      double touch = 1e9;
      bool sat = false;
      for (const auto& frames : truth.people)
        for (const RecordedFrame& f : frames)
          for (const Part& part : object.parts) {
            for (const Joint j : {pelvis, right_wrist, left_wrist}) touch = std::min(touch, distance_to(part.box, f.pose.col(j)));
            sat = sat || ((f.action == Action::sit || f.action == Action::lie) && part.name == "seat" && distance_to(part.box, f.pose.col(pelvis)) < 0.15);
          }
      if (used.count(object.id) > 0)
        EXPECT_LT(touch, 0.13) << object.category << ", seed " << seed;
      else
        EXPECT_FALSE(sat) << object.category << ", seed " << seed;
    }
  }
}

TEST(Synth, EveryCategoryIsUsed) {
  std::set<std::string> used, actions;
  for (int seed = 0; seed < 40; ++seed) {
    const Recording truth = take_of(seed).truth;
    EXPECT_EQ(truth.objects.size(), 4u);
    for (const int id : truth.interacted) used.insert(truth.objects.at(static_cast<std::size_t>(id)).category);
    for (const RecordedFrame& f : truth.people.at(0)) actions.insert(kActions[static_cast<std::size_t>(f.action)]);
  }
  EXPECT_EQ(used, (std::set<std::string>{"bed", "chair", "couch", "desk", "shelf", "stool", "table"}));
  EXPECT_EQ(actions.size(), std::size(kActions));
}

TEST(Synth, PeopleKeepApart) {
  for (int seed = 0; seed < 4; ++seed) {
    const Recording truth = take_of(seed, 4, 10, 40, 5).truth;
    ASSERT_EQ(truth.people.size(), 4u);
    for (std::size_t k = 0; k < truth.people[0].size(); ++k)
      for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < a; ++b)
          EXPECT_GT((truth.people[a][k].pose.col(pelvis) - truth.people[b][k].pose.col(pelvis)).norm(), 0.5) << "seed " << seed << ", frame " << k;
  }
}

TEST(Synth, StillPeopleOnlyWalkAndStand) {
  for (int seed = 0; seed < 5; ++seed) {
    SynthOptions options;
    options.seed = seed;
    options.still = true;
    options.people = 2;
    const SynthTake synth = simulate(options);
    EXPECT_TRUE(synth.truth.interacted.empty());
    EXPECT_EQ(synth.truth.objects.size(), 4u);
    for (const auto& frames : synth.truth.people)
      for (const RecordedFrame& f : frames) EXPECT_TRUE(f.action == Action::walk || f.action == Action::stand);
  }
}

TEST(Synth, OptionsOutsideTheirRangeAreRefused) {
  for (auto spoil : std::vector<void (*)(SynthOptions&)>{[](SynthOptions& o) { o.people = 5; }, [](SynthOptions& o) { o.people = 0; }, [](SynthOptions& o) { o.objects = 1; },
                                                         [](SynthOptions& o) { o.fps = 0; }, [](SynthOptions& o) { o.noise = -1; },
                                                         [](SynthOptions& o) { o.seconds = std::nan(""); }, [](SynthOptions& o) { o.seed = -1; }}) {
    SynthOptions options;
    spoil(options);
    EXPECT_THROW(simulate(options), InputError);
  }
}

}  // namespace
}  // namespace unseen::interactions
