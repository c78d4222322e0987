// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/people/identities.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "interactions/people/identity_costs.h"
#include "unseen/core/error.h"
#include "unseen/core/random.h"

namespace unseen::interactions {
namespace {

Take empty_take(int people, double fps = 10) {
  Take take;
  take.name = "take.json";
  take.camera = {1000, 1000, 960, 540, 1920, 1080};
  take.fps = fps;
  take.people = people;
  return take;
}

/// An upright body of 16 joints at a place in the picture. px
Detection body(int frame, const Vec2& at, double noise, Random& random, double confidence = 0.8) {
  Detection d;
  d.frame = frame;
  for (int j = 0; j < kJoints; ++j) d.pixels.col(j) = at + Vec2((j % 4 - 1.5) * 30, (j / 4 - 1.5) * 90) + noise * Vec2(random.normal(), random.normal());
  d.confidence.setConstant(confidence);
  return d;
}

double cost(const Take& take, const std::vector<int>& person) {
  const Sightings sightings = sightings_of(take);
  double sum = 0;
  for (int p = 0; p < take.people; ++p) {
    std::vector<int> path;
    for (std::size_t i = 0; i < person.size(); ++i)
      if (person[i] == p) path.push_back(static_cast<int>(i));
    sum += path_cost(take, sightings, path);
  }
  return sum;
}

/// The least cost over all ways to give each detection a person or nobody, labels kept.
double least_cost(const Take& take) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<int> person(take.detections.size(), -1);
  const std::function<void(std::size_t)> choose = [&](std::size_t i) {
    if (i == person.size()) {
      least = std::min(least, cost(take, person));
      return;
    }
    for (int p = -1; p < take.people; ++p) {
      if (take.detections[i].person >= 0 && p != take.detections[i].person) continue;
      bool free = true;
      for (std::size_t k = 0; k < i; ++k) free = free && (p < 0 || person[k] != p || take.detections[k].frame != take.detections[i].frame);
      person[i] = p;
      if (free) choose(i + 1);
    }
    person[i] = -1;
  };
  choose(0);
  return least;
}

/// A small take at random; `labels` detections name their person.
Take random_take(Random& random, int people, int labels) {
  Take take = empty_take(people, random.uniform() < 0.5 ? 0.4 : 0.8);  // memory of one or two slots
  const int frames = people == 2 ? 6 : 4;
  for (int frame = 0; frame < frames; ++frame)
    for (std::size_t n = random.index(3); n > 0; --n)
      take.detections.push_back(body(frame * 2, Vec2(random.uniform(200, 1700), 540), 5, random, random.uniform(0.1, 1)));
  for (int i = 0; i < labels && !take.detections.empty(); ++i) {
    const std::size_t at = random.index(take.detections.size());
    const int p = static_cast<int>(random.index(static_cast<std::size_t>(people)));
    bool taken = false;
    for (const Detection& d : take.detections) taken = taken || (d.frame == take.detections[at].frame && d.person == p);
    if (!taken) take.detections[at].person = p;
  }
  return take;
}

void expect_legal(const Take& take, const std::vector<int>& person) {
  ASSERT_EQ(person.size(), take.detections.size());
  for (std::size_t i = 0; i < person.size(); ++i) {
    EXPECT_LT(person[i], take.people);
    EXPECT_TRUE(take.detections[i].person < 0 || person[i] == take.detections[i].person);
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(person[i] >= 0 && person[i] == person[k] && take.detections[i].frame == take.detections[k].frame);
  }
}

TEST(Identities, AreTheCheapestOfAll) {
  Random random(31);
  for (int round = 0; round < 150; ++round) {
    const Take take = random_take(random, 1 + round % 3, 0);
    const std::vector<int> person = identify(take);
    expect_legal(take, person);
    EXPECT_NEAR(cost(take, person), least_cost(take), 1e-6) << round;
  }
}

TEST(Identities, AreTheCheapestThatKeepTheLabels) {
  Random random(32);
  for (int round = 0; round < 300; ++round) {
    const Take take = random_take(random, 2 + round % 2, 1 + round % 4);
    const std::vector<int> person = identify(take);
    expect_legal(take, person);
    EXPECT_NEAR(cost(take, person), least_cost(take), 1e-6) << round;
  }
}

/// Two people who cross, 60 px a frame each, one a little farther up; `missed` frames around the meeting lack one or both.
Take crossing(Random& random, int missed, bool both) {
  Take take = empty_take(2);
  for (int frame = 0; frame < 40; ++frame) {
    const bool hidden = std::abs(frame - 20) * 2 < missed;
    if (!hidden || !both) take.detections.push_back(body(frame, Vec2(300 + 33 * frame, 560), 8, random));
    if (!hidden) take.detections.push_back(body(frame, Vec2(1600 - 33 * frame, 530), 8, random));
    if (take.detections.size() > 1 && frame % 3 == 0) std::swap(take.detections.back(), take.detections[take.detections.size() - 2]);
  }
  std::stable_sort(take.detections.begin(), take.detections.end(), [](const Detection& a, const Detection& b) { return a.frame < b.frame; });
  return take;
}

int wrong(const Take& take, const std::vector<int>& person) {
  int same = 0, swapped = 0;
  for (std::size_t i = 0; i < person.size(); ++i) {
    const double rightward = 300 + 33 * take.detections[i].frame, x = take.detections[i].pixels.row(0).mean();
    const int truth = std::abs(x - rightward) < std::abs(x - (1600 - 33 * take.detections[i].frame)) ? 0 : 1;
    same += person[i] != truth;
    swapped += person[i] != 1 - truth;
  }
  return std::min(same, swapped);
}

TEST(Identities, OfPeopleWhoCrossStay) {
  Random random(33);
  for (int missed : {0, 3, 7, 13})
    for (const bool both : {false, true})
      for (int round = 0; round < 5; ++round) {
        const Take take = crossing(random, missed, both);
        EXPECT_LE(wrong(take, identify(take)), 2) << missed << both;  // where both are at one place either may be either
      }
}

TEST(Identities, SomebodyMissedForAFrameComesBack) {
  Random random(34);
  Take take = empty_take(2);
  for (int frame = 0; frame < 60; ++frame) {
    take.detections.push_back(body(frame, Vec2(400, 540), 5, random));
    if (frame % 10 != 5) take.detections.push_back(body(frame, Vec2(1200, 540), 5, random));
  }
  const std::vector<int> person = identify(take);
  for (std::size_t i = 0; i < person.size(); ++i) EXPECT_EQ(person[i] == person[0], take.detections[i].pixels.row(0).mean() < 800);
  EXPECT_EQ(std::count(person.begin(), person.end(), -1), 0);
}

TEST(Identities, WhoIsHiddenDoesNotTakeTurnsWithWhoHides) {
  Random random(37);
  Take take = empty_take(2);
  for (int frame = 0; frame < 90; ++frame) {
    take.detections.push_back(body(frame, Vec2(800, 540), 10, random));
    const double at = 250 + 12 * frame;  // walks by behind the other, who stands
    if (frame < 35 || frame >= 60) take.detections.push_back(body(frame, Vec2(at, 540), 10, random, frame < 33 || frame >= 62 ? 0.9 : 0.4));
  }
  const std::vector<int> person = identify(take);
  for (std::size_t i = 0; i < person.size(); ++i) EXPECT_EQ(person[i] == person[0], std::abs(take.detections[i].pixels.row(0).mean() - 800) < 50) << i;
}

TEST(Identities, ADoubtfulThirdFigureIsNobody) {
  Random random(35);
  Take take = empty_take(2);
  for (int frame = 0; frame < 30; ++frame) {
    take.detections.push_back(body(frame, Vec2(400 + 10 * frame, 540), 5, random));
    take.detections.push_back(body(frame, Vec2(random.uniform(0, 1900), random.uniform(0, 1000)), 5, random, 0.2));
    take.detections.push_back(body(frame, Vec2(1200, 540), 5, random));
  }
  const std::vector<int> person = identify(take);
  for (std::size_t i = 0; i < person.size(); ++i) EXPECT_EQ(person[i] < 0, i % 3 == 1) << i;
}

TEST(Identities, WhoIsAloneIsTheOneExpectedHoweverFarHeMovesBetweenFrames) {
  for (const double fps : {0.5, 1.0, 2.0, 10.0}) {
    Random random(6);
    Take take = empty_take(1, fps);
    for (int frame = 0; frame < 30; ++frame) take.detections.push_back(body(frame, Vec2(random.uniform(200, 1700), 540), 5, random));
    EXPECT_EQ(identify(take), std::vector<int>(30, 0)) << fps;
  }
}

TEST(Identities, OfPeopleWhoWalkStayInSlowTakes) {
  for (const double fps : {1.0, 2.0, 5.0, 10.0, 30.0}) {
    Random random(7);
    Take take = empty_take(2, fps);
    std::vector<int> expected;
    for (int frame = 0; frame < 20; ++frame)
      for (const int person : {0, 1}) {
        const double swing = std::sin(frame / fps);  // 250 px / s at most
        take.detections.push_back(body(frame, Vec2(person == 0 ? 400 + 250 * swing : 1500 - 250 * swing, 540), 3, random));
        expected.push_back(person);
      }
    std::vector<int> found = identify(take);
    if (found[0] == 1)
      for (int& person : found) person = 1 - person;  // which of the two is called the first is no matter
    EXPECT_EQ(found, expected) << fps;
  }
}

TEST(Identities, FollowLabelsByPixel) {
  Random random(36);
  Take take = crossing(random, 0, false);
  for (const int swap : {0, 1}) {
    take.labels = {{2, swap, Vec2(300 + 66, 560)}};
    const std::vector<int> person = identify(take);
    for (std::size_t i = 0; i < person.size(); ++i)
      EXPECT_TRUE(take.detections[i].frame > 10 || person[i] == (take.detections[i].pixels.row(0).mean() < 900 ? swap : 1 - swap));
  }
  take.labels = {{2, 0, Vec2(366, 560)}, {37, 1, Vec2(300 + 33 * 37, 560)}};  // against the evidence, but the user says so
  const std::vector<int> person = identify(take);
  for (std::size_t i = 0; i < person.size(); ++i) {
    const bool right = take.detections[i].pixels.row(0).mean() > 960;
    EXPECT_TRUE(take.detections[i].frame != 2 || right || person[i] == 0);
    EXPECT_TRUE(take.detections[i].frame != 37 || !right || person[i] == 1);
  }
}

TEST(Identities, LabelsThatCannotBeAreTheCallersFault) {
  Random random(37);
  Take take = crossing(random, 0, false);
  const auto refused = [&](std::vector<Label> labels) {
    take.labels = std::move(labels);
    try {
      identify(take);
    } catch (const InputError& e) {
      return std::string(e.what()).find("labels[") != std::string::npos;
    }
    return false;
  };
  EXPECT_TRUE(refused({{2, 7, Vec2(366, 560)}}));                                // no such person
  EXPECT_TRUE(refused({{2, 0, Vec2(900, 20)}}));                                 // nobody there
  EXPECT_TRUE(refused({{99, 0, Vec2(366, 560)}}));                               // no such frame
  EXPECT_TRUE(refused({{2, 0, Vec2(366, 560)}, {2, 0, Vec2(1600 - 66, 530)}}));  // one in two places
  EXPECT_TRUE(refused({{2, 0, Vec2(366, 560)}, {2, 1, Vec2(366, 560)}}));        // two in one
  EXPECT_FALSE(refused({{2, 0, Vec2(366, 560)}, {2, 0, Vec2(366, 560)}}));       // twice the same
}

TEST(Identities, OfNothingAreNone) { EXPECT_TRUE(identify(empty_take(2)).empty()); }

TEST(Identities, OfLongTakesAreFoundSoon) {
  Random random(38);
  Take take = empty_take(4, 30);
  for (int frame = 0; frame < 1200; ++frame)
    for (int p = 0; p < 4; ++p)
      if (random.uniform() < 0.9) take.detections.push_back(body(frame, Vec2(960 + 800 * std::sin(0.01 * frame * (1 + 0.2 * p) + p), 500 + 40 * p), 6, random));
  const std::vector<int> person = identify(take);
  EXPECT_LT(std::count(person.begin(), person.end(), -1), 10);
}

}  // namespace
}  // namespace unseen::interactions
