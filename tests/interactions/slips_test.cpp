// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/people/slips.h"

#include <gtest/gtest.h>

#include "interactions/method_samples.h"
#include "interactions/people/identity_costs.h"
#include "interactions/people/merge_takes.h"

namespace unseen::interactions {
namespace {

/// Somebody alone at 25 frames a second, with the generator's noise.
Take somebody(int seed) {
  SynthOptions options = test::synth_options(seed, 12);
  options.fps = 25;
  return merge_takes({simulate(options).take});
}

void exchange(Detection& detection, int first, int last) {
  const Detection before = detection;
  for (int k = first; k <= last; ++k) {
    detection.pixels.col(k) = before.pixels.col(first + last - k);
    detection.confidence[k] = before.confidence[first + last - k];
    if (before.local) detection.local->col(k) = before.local->col(first + last - k);
  }
}

/// px²: by how much a pair of joints that both sides have would move if they were exchanged.
double width(const Detection& d, int first, int last) {
  double sum = 0;
  for (int k = first; k <= last; ++k) sum += (d.pixels.col(k) - d.pixels.col(first + last - k)).squaredNorm() / (last - first + 1);
  return sum;
}

bool same(const Detection& a, const Detection& b) {
  return a.pixels == b.pixels && (a.confidence == b.confidence).all() && a.local.has_value() == b.local.has_value() && (!a.local || *a.local == *b.local);
}

TEST(Slips, OfTheOtherSideAreExchanged) {
  for (const auto& [first, last] : {std::pair<int, int>{right_ankle, left_ankle}, {right_wrist, left_wrist}})
    for (const std::size_t length : {1u, 3u, 6u}) {
      const Take truth = somebody(4001);
      Take slipped = truth;
      int wrong = 0;
      for (std::size_t i = 20; i + 20 < slipped.detections.size(); i += 20) {
        for (std::size_t k = i; k < i + length; ++k) exchange(slipped.detections[k], first, last);
        wrong += width(truth.detections[i], first, last) > 2500 && width(truth.detections[i + length - 1], first, last) > 2500;
      }
      ASSERT_GT(wrong, 3);
      undo_slips(slipped);
      int left = 0;
      for (std::size_t i = 20; i + 20 < slipped.detections.size(); i += 20)
        left += !same(slipped.detections[i], truth.detections[i]) && width(truth.detections[i], first, last) > 2500 && width(truth.detections[i + length - 1], first, last) > 2500;
      EXPECT_LE(10 * left, wrong) << length << " frames from joint " << first;
    }
}

TEST(Slips, OfOneJointAreNotSeen) {
  const Take truth = somebody(4002);
  Take slipped = truth;
  std::vector<std::pair<std::size_t, int>> wrong;
  for (std::size_t i = 10; i + 10 < slipped.detections.size(); i += 10) {
    const int k = static_cast<int>(i / 10) % kJoints;
    if (truth.detections[i - 1].confidence[k] * truth.detections[i].confidence[k] * truth.detections[i + 1].confidence[k] > 0) wrong.emplace_back(i, k);
    slipped.detections[i].pixels.col(k) += Vec2(150, -90);
  }
  ASSERT_GT(wrong.size(), 10u);
  undo_slips(slipped);
  std::size_t unseen = 0, expected = 0;
  for (const auto& [i, k] : wrong) expected += slipped.detections[i].confidence[k] == 0.0;
  for (std::size_t i = 0; i < truth.detections.size(); ++i) unseen += (slipped.detections[i].confidence != truth.detections[i].confidence).count();
  EXPECT_GE(10 * expected, 9 * wrong.size());
  EXPECT_LE(unseen, expected + 1) << "and no other";
}

TEST(Slips, AreNotSeenInLegsThatCross) {  // nor in hands that wave, at any frame rate
  for (const int seed : {4001, 4002, 4003, 4004})
    for (const double fps : {10.0, 25.0, 50.0}) {
      SynthOptions options = test::synth_options(seed, 15);
      options.fps = fps;
      const SynthTake synth = simulate(options);
      Take exact = merge_takes({synth.take});
      for (Detection& d : exact.detections) {
        const auto& person = synth.truth.people[0];
        const auto at = std::find_if(person.begin(), person.end(), [&](const RecordedFrame& f) { return f.frame == d.frame; });
        ASSERT_NE(at, person.end());
        const View view = test::true_view(synth);
        for (int k = 0; k < kJoints; ++k) d.pixels.col(k) = exact.camera.project(view.T_world_camera.inverse() * Vec3(at->pose.col(k)));
      }
      const Take before = exact;
      undo_slips(exact);
      for (std::size_t i = 0; i < before.detections.size(); ++i) EXPECT_TRUE(same(exact.detections[i], before.detections[i])) << seed << " at " << fps << ", frame " << before.detections[i].frame;
    }
}

TEST(Slips, DoNotTellPeopleApart) {
  const Take truth = somebody(4003);
  const Sightings sightings = sightings_of(truth);
  for (int i = 11; i + 1 < static_cast<int>(truth.detections.size()); i += 10) {
    Take sides = truth, joint = truth;
    Detection& turned = sides.detections[static_cast<std::size_t>(i)];
    exchange(turned, right_ankle, left_ankle);
    exchange(turned, right_wrist, left_wrist);
    joint.detections[static_cast<std::size_t>(i)].pixels.col(i % kJoints) += Vec2(500, -300);
    const auto cost = [&](const Take& take) { return link_cost(take, sightings, i - 1, i) + link_cost(take, sightings, i, i + 1); };
    EXPECT_LE(cost(sides), 1.3 * cost(truth) + 1e-9) << i;
    EXPECT_LE(cost(joint), 3.0 * cost(truth) + 0.1) << i;
    Take other = truth;  // somebody else, where nobody's sides are exchanged
    other.detections[static_cast<std::size_t>(i)].pixels.colwise() += Vec2(500, -300);
    EXPECT_GT(cost(other), 10.0 * cost(truth)) << i;
  }
}

}  // namespace
}  // namespace unseen::interactions
