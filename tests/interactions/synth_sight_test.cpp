// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <set>

#include "unseen/interactions/synth.h"

namespace unseen::interactions {
namespace {

SynthTake noisy_take_of(int seed, int people, double noise = 5) {
  SynthOptions options;
  options.seed = seed;
  options.people = people;
  options.noise = noise;
  return simulate(options);
}

/// Does any of the points on the way lie in a box that is larger by `grow`?
bool passes_through(const std::vector<Object>& objects, const Vec3& from, const Vec3& to, double grow) {
  const int steps = static_cast<int>((to - from).norm() / 0.002) + 1;
  for (const Object& object : objects)
    for (const Part& part : object.parts) {
      OrientedBox box = part.box;
      box.half_size.array() += grow;
      for (int k = 0; k <= steps; ++k)
        if (box.contains(from + (to - from) * (static_cast<double>(k) / steps))) return true;
    }
  return false;
}

/// Least distance of points on the way to points on a figure's bones.
double closest(const Pose& pose, const Vec3& from, const Vec3& to) {
  double least = 1e9;
  for (const auto& [a, b] : kBones)
    for (int i = 0; i <= 20; ++i)
      for (int k = 0; k <= 200; ++k)
        least = std::min(least, (from + (to - from) * (k / 200.0) - pose.col(a) - (pose.col(b) - pose.col(a)) * (i / 20.0)).norm());
  return least;
}

TEST(SynthSight, HiddenJointsAreThoseBehindFurniture) {
  int hidden = 0, seen = 0;
  for (int seed = 0; seed < 4; ++seed) {
    const Recording truth = noisy_take_of(seed, 1).truth;
    const Vec3 eye = truth.T_world_camera.translation;
    for (std::size_t k = 0; k < truth.people[0].size(); k += 40)
      for (int j = 0; j < kJoints; ++j) {
        const RecordedFrame& f = truth.people[0][k];
        const bool flag = f.occluded[static_cast<std::size_t>(j)];
        (flag ? hidden : seen) += 1;
        const double beside = flag ? 0.003 : -0.003;  // m
        EXPECT_EQ(passes_through(truth.objects, eye, f.pose.col(j), beside), flag) << "seed " << seed << ", frame " << f.frame;
      }
  }
  EXPECT_GT(hidden, 20);
  EXPECT_GT(seen, 200);
}

TEST(SynthSight, JointsAreHiddenByOtherPeopleToo) {
  int by_others = 0;
  for (int seed = 0; seed < 3; ++seed) {
    const Recording truth = noisy_take_of(seed, 2).truth;
    const Vec3 eye = truth.T_world_camera.translation;
    for (std::size_t k = 0; k < truth.people[0].size(); k += 8)
      for (const int who : {0, 1})
        for (int j = 0; j < kJoints; ++j) {
          const RecordedFrame& f = truth.people[static_cast<std::size_t>(who)][k];
          if (passes_through(truth.objects, eye, f.pose.col(j), 0.003)) continue;
          const double near = closest(truth.people[static_cast<std::size_t>(1 - who)][k].pose, eye, f.pose.col(j));
          const bool flag = f.occluded[static_cast<std::size_t>(j)];
          by_others += flag;
          EXPECT_TRUE(!flag || near < 0.25) << near;
          EXPECT_TRUE(flag || near >= 0.02) << near;
        }
  }
  EXPECT_GT(by_others, 5);
}

TEST(SynthSight, TheCameraStandsAsPromised) {
  for (int seed = 0; seed < 30; ++seed) {
    const SynthTake synth = noisy_take_of(seed, 1);
    const RigidTransform& T = synth.truth.T_world_camera;
    ASSERT_TRUE(T.is_rigid(1e-12));
    EXPECT_NEAR(T.translation.head<2>().norm(), 0, 1e-12);
    EXPECT_GE(T.translation.z(), 0.8);
    EXPECT_LE(T.translation.z(), 1.8);
    const Vec3 forward = T.rotation.col(2);
    EXPECT_NEAR(forward.x(), 0, 1e-12);
    const double pitch = std::asin(-forward.z());
    EXPECT_GE(pitch, -1e-12);
    EXPECT_LE(pitch, radians(10.0) + 1e-12);
    EXPECT_NEAR((T.rotation.col(0) - Vec3::UnitX()).norm(), 0, 1e-12);
  }
}

struct Residuals {
  double sum = 0, squares = 0, confidence = 0;
  int count = 0, confident = 0, far = 0;
  void add(double error, double c) {
    sum += error;
    squares += error * error;
    confidence += c;
    ++count;
    confident += c > 0.5;
  }
};

TEST(SynthSight, NoiseAndConfidenceAreAsSaid) {
  const double noise = 6;
  Residuals visible, hidden;
  for (int seed = 0; seed < 25; ++seed) {
    const SynthTake synth = noisy_take_of(seed, 1, noise);
    const RigidTransform to_camera = synth.truth.T_world_camera.inverse();
    for (const Detection& d : synth.take.detections) {
      const RecordedFrame& f = synth.truth.people[0].at(static_cast<std::size_t>(d.frame));
      for (int j = 0; j < kJoints; ++j) {
        if (d.confidence[j] == 0) continue;
        const Vec2 error = d.pixels.col(j) - synth.take.camera.project(to_camera * f.pose.col(j));
        Residuals& r = f.occluded[static_cast<std::size_t>(j)] ? hidden : visible;
        r.add(error.x(), d.confidence[j]);
        r.far += d.confidence[j] > 0.5 && error.norm() > 4.0 * noise;
      }
    }
  }
  ASSERT_GT(visible.count, 20000);
  ASSERT_GT(hidden.count, 5000);
  EXPECT_NEAR(visible.sum / visible.count, 0, 0.2);
  EXPECT_NEAR(std::sqrt(visible.squares / visible.count), noise, 0.03 * noise);
  EXPECT_NEAR(visible.confidence / visible.count, 0.85, 0.01);
  EXPECT_NEAR(hidden.confidence / hidden.count, 0.9 * 0.2 + 0.1 * 0.85, 0.03);
  EXPECT_NEAR(static_cast<double>(hidden.confident) / hidden.count, 0.1, 0.03);
  EXPECT_GT(hidden.far, 0.5 * hidden.confident);
  EXPECT_LT(visible.far, visible.count / 500);  // of a Gaussian in two dimensions: exp(−8), 3 in 10,000
}

TEST(SynthSight, LiftedPosesAreAboutRightWhereLimbsAreSeen) {
  double turned = 0;
  int bones = 0;
  for (int seed = 0; seed < 5; ++seed) {
    const SynthTake synth = noisy_take_of(seed, 1);
    const Mat3 to_camera = synth.truth.T_world_camera.rotation.transpose();
    for (const Detection& d : synth.take.detections) {
      ASSERT_TRUE(d.local.has_value());
      EXPECT_EQ(d.local->col(pelvis).norm(), 0.0);
      const Pose truth = to_camera * synth.truth.people[0].at(static_cast<std::size_t>(d.frame)).pose;
      const bool all_seen = (d.confidence > 0.5).all();
      for (const auto& [a, b] : kBones) {
        const Vec3 is = truth.col(b) - truth.col(a), lifted = d.local->col(b) - d.local->col(a);
        EXPECT_NEAR(lifted.norm(), is.norm(), 1e-9);
        if (!all_seen) continue;
        turned += std::atan2(is.cross(lifted).norm(), is.dot(lifted));
        ++bones;
      }
    }
  }
  EXPECT_GT(degrees(turned / bones), 1.0);
  EXPECT_LT(degrees(turned / bones), 12.0);

  SynthOptions options;
  options.lifted = false;
  const Take plain = simulate(options).take;
  for (const Detection& d : plain.detections) EXPECT_FALSE(d.local.has_value());
}

TEST(SynthSight, AllPeopleAreDetectedInSomeOrder) {
  const SynthTake synth = noisy_take_of(2, 3);
  std::set<int> first;  // which true person is the first of its frame's list
  const RigidTransform to_camera = synth.truth.T_world_camera.inverse();
  int last = -1;
  for (const Detection& d : synth.take.detections) {
    EXPECT_GE(d.frame, last);
    EXPECT_EQ(d.person, -1);
    if (d.frame != last) {
      double least = 1e9;
      int who = -1;
      for (int p = 0; p < 3; ++p) {
        const Pose& pose = synth.truth.people[static_cast<std::size_t>(p)].at(static_cast<std::size_t>(d.frame)).pose;
        double sum = 0;
        for (int j = 0; j < kJoints; ++j)
          if (d.confidence[j] > 0) sum += (synth.take.camera.project(to_camera * pose.col(j)) - d.pixels.col(j)).norm();
        if (sum < least) least = sum, who = p;
      }
      first.insert(who);
    }
    last = d.frame;
  }
  EXPECT_EQ(first.size(), 3u);
}

}  // namespace
}  // namespace unseen::interactions
