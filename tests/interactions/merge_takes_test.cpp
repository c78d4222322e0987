// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/people/merge_takes.h"

#include <gtest/gtest.h>

#include <set>

#include "interactions/method_samples.h"
#include "unseen/core/error.h"

namespace unseen::interactions {
namespace {

Take simulated_take(int seed, int people) { return simulate(test::synth_options(seed, 8, people)).take; }

TEST(MergeTakes, NumberFramesAndPeopleOn) {
  const Take a = simulated_take(5001, 1), b = [&] {
    Take other = simulated_take(5002, 2);
    other.camera = a.camera;
    other.remarks = {"odd"};
    return other;
  }();
  const Take all = merge_takes({a, b});
  EXPECT_EQ(all.people, 3);
  EXPECT_EQ(all.remarks, (std::vector<std::string>{"odd"}));
  EXPECT_LE(all.detections.size(), a.detections.size() + b.detections.size());
  EXPECT_GT(all.detections.size(), (a.detections.size() + b.detections.size()) * 9 / 10);
  std::set<std::pair<int, int>> seen;
  int last_of_a = 0, first_of_b = 1 << 30, before = 0;
  for (const Detection& d : all.detections) {
    EXPECT_GE(d.frame, before) << "by frame";
    before = d.frame;
    EXPECT_TRUE(seen.emplace(d.frame, d.person).second) << "a person is once in a frame";
    ASSERT_GE(d.person, 0);
    ASSERT_LT(d.person, 3);
    if (d.person == 0) last_of_a = std::max(last_of_a, d.frame);
    else first_of_b = std::min(first_of_b, d.frame);
  }
  EXPECT_GT(first_of_b, last_of_a + 5 * a.fps) << "no window reaches from one take into the next";
  // Detections themselves are as they were.
  const Detection& end = all.detections.back();
  const auto same = [&](const Detection& d) { return d.pixels == end.pixels && (d.confidence == end.confidence).all(); };
  EXPECT_EQ(std::count_if(b.detections.begin(), b.detections.end(), same), 1);
}

TEST(MergeTakes, OfOneTakeIsTheTakeWithItsPeopleTold) {
  const Take a = simulated_take(5001, 1), all = merge_takes({a});
  ASSERT_EQ(all.detections.size(), a.detections.size());
  for (std::size_t i = 0; i < all.detections.size(); ++i) {
    EXPECT_EQ(all.detections[i].frame, a.detections[i].frame);
    EXPECT_EQ(all.detections[i].person, 0);
  }
}

TEST(MergeTakes, TheCamerasPlaceMayStandInAnyOfThem) {
  Take a = simulated_take(5001, 1), b = a;
  a.up = std::nullopt;
  a.camera_height = std::nullopt;
  b.up = Vec3(0, -1, 0);
  b.camera_height = 1.7;
  const Take all = merge_takes({a, b});
  EXPECT_EQ(all.up, b.up);
  EXPECT_EQ(all.camera_height, b.camera_height);
}

/// What the caller did wrong, by field.
std::string refused(const std::vector<Take>& takes) {
  try {
    merge_takes(takes);
  } catch (const InputError& e) {
    return e.field;
  }
  return "nothing";
}

TEST(MergeTakes, RefuseWhatIsNotOneCamera) {
  Take a = simulated_take(5001, 1);
  a.up = Vec3(0, -1, 0);
  a.camera_height = 1.7;
  const auto with = [&](const auto& change) {
    Take other = a;
    change(other);
    return refused({a, other});
  };
  EXPECT_EQ(with([](Take&) {}), "nothing");
  EXPECT_EQ(with([](Take& t) { t.camera.fx *= 1.1; }), "camera");
  EXPECT_EQ(with([](Take& t) { t.camera.cy += 30; }), "camera");
  EXPECT_EQ(with([](Take& t) { t.camera.width /= 2; }), "camera");
  EXPECT_EQ(with([](Take& t) { t.up = Vec3(0, -0.99, -0.1).normalized(); }), "up");
  EXPECT_EQ(with([](Take& t) { t.camera_height = 1.5; }), "camera_height");
  EXPECT_EQ(with([](Take& t) { t.fps = 25; }), "fps");
  EXPECT_EQ(with([](Take& t) { t.detections.clear(); }), "joints");
  EXPECT_NE(refused({}), "nothing");
}

}  // namespace
}  // namespace unseen::interactions
