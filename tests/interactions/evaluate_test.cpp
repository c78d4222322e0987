// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/interactions/evaluate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "interactions/database/footprint.h"
#include "interactions/evaluate/assignment.h"
#include "interactions/evaluate/evaluate_parts.h"
#include "unseen/core/random.h"

namespace unseen::interactions {
namespace {

OrientedBox box(const Vec3& center, const Vec3& size) { return {center, Mat3::Identity(), 0.5 * size}; }

Object object(int id, const std::string& category, double x, double y) {
  const std::string main = superclass_of(category) == Superclass::table ? "top" : superclass_of(category) == Superclass::shelf ? "shelf" : "seat";
  return {id, category, {{main, box({x, y, 0.4}, {0.5, 0.5, 0.1})}, {"leg", box({x + 0.2, y, 0.2}, {0.05, 0.05, 0.4})}}};
}

Pose standing(double x, double y) {
  Pose p;
  for (int j = 0; j < kJoints; ++j) p.col(j) = Vec3(x + 0.05 * j, y - 0.03 * j, 0.1 * j + 0.1);
  return p;
}

/// Two objects used, one not; one person who walks 3 m along x in 31 frames with both knees hidden.
Recording truth() {
  Recording r;
  r.T_world_camera.translation = Vec3(0, 0, 1.4);
  r.objects = {object(3, "chair", 1, 3), object(5, "table", 3, 3), object(8, "chair", -4, 3)};
  r.interacted = {3, 5};
  std::vector<RecordedFrame> frames;
  for (int f = 0; f <= 30; ++f) {
    RecordedFrame frame;
    frame.frame = f;
    frame.pose = standing(0.1 * f, 2);
    frame.occluded[right_knee] = frame.occluded[left_knee] = f < 20;
    frame.action = f < 10 ? Action::walk : Action::sit;
    frame.has_action = true;
    frames.push_back(frame);
  }
  r.people = {frames};
  return r;
}

/// A result that is the truth: its used objects, and every frame.
Reconstruction perfect(const Recording& truth) {
  Reconstruction r;
  r.T_world_camera = truth.T_world_camera;
  r.fps = truth.fps;
  for (const Object& o : truth.objects)
    if (std::count(truth.interacted.begin(), truth.interacted.end(), o.id) > 0) r.objects.push_back({o, 1, {}});
  for (const auto& frames : truth.people) {
    Person person;
    person.id = static_cast<int>(r.people.size());
    for (const RecordedFrame& f : frames) {
      PersonFrame frame;
      frame.frame = f.frame, frame.pose = f.pose, frame.action = f.action;
      person.frames.push_back(frame);
    }
    r.people.push_back(person);
  }
  return r;
}

void move(Object& o, const Vec3& by) {
  for (Part& p : o.parts) p.box.center += by;
}

TEST(Evaluate, TheTruthItselfIsWithoutError) {
  const Recording t = truth();
  const Evaluation e = evaluate(perfect(t), t);
  EXPECT_EQ(e.interacted, 2);
  EXPECT_EQ(e.found, 2);
  EXPECT_EQ(e.false_objects, 0);
  EXPECT_NEAR(*e.mean_distance, 0, 1e-12);
  EXPECT_NEAR(e.all->world, 0, 1e-12);
  EXPECT_EQ(e.all->frames, 31);
  EXPECT_EQ(e.occluded->frames, 20);
  EXPECT_EQ(e.action_accuracy, 1.0);
  EXPECT_FALSE(e.identity);
}

TEST(Evaluate, DistancesAreOnTheGround) {
  const Recording t = truth();
  Reconstruction r = perfect(t);
  move(r.objects[0].object, Vec3(0.3, 0.4, 5.0));
  move(r.objects[1].object, Vec3(0, -0.1, 0));
  const Evaluation e = evaluate(r, t);
  EXPECT_EQ(e.found, 2);
  EXPECT_NEAR(*e.mean_distance, 0.3, 1e-12);
  EXPECT_NEAR(*e.median_distance, 0.3, 1e-12);
  EXPECT_NEAR(*e.sd_distance, 0.4 / std::sqrt(2.0), 1e-12);
}

TEST(Evaluate, TheGateAndTheSuperclassDecide) {
  const Recording t = truth();
  for (const auto& [category, dx, found] : {std::tuple{"couch", 1.49, 2}, {"couch", 1.51, 1}, {"desk", 0.0, 1}, {"shelf", 0.0, 1}}) {
    Reconstruction r = perfect(t);
    r.objects[0].object = object(0, category, 1 - dx, 3);
    const Evaluation e = evaluate(r, t);
    EXPECT_EQ(e.found, found) << category << dx;
    EXPECT_EQ(e.false_objects, 2 - found) << category << dx;
  }
}

TEST(Evaluate, WhatNobodyUsesIsNeitherHitNorFalse) {
  const Recording t = truth();
  Reconstruction r = perfect(t);
  r.objects.push_back({object(20, "chair", -4.5, 3), 1, {}});
  EXPECT_EQ(evaluate(r, t).false_objects, 0);
  EXPECT_EQ(evaluate(r, t).found, 2);
  r.objects.push_back({object(21, "chair", -3.2, 3), 1, {}});
  EXPECT_EQ(evaluate(r, t).false_objects, 1) << "there is one such chair only";
  Recording unknown = t;
  unknown.interacted.clear();
  EXPECT_EQ(evaluate(r, unknown).interacted, 3) << "not known who uses what: all count";
  unknown.uses_known = true;
  EXPECT_EQ(evaluate(r, unknown).interacted, 0) << "nobody uses any";
}

TEST(Evaluate, ManyBoxesOfOneObjectAreOneObject) {
  Recording t = truth();
  t.objects[0] = {3, "couch", {{"seat", box({0, 3, 0.4}, {0.9, 0.8, 0.2})}, {"seat-1", box({2, 3, 0.4}, {0.9, 0.8, 0.2})}, {"back", box({1, 3.4, 0.7}, {2, 0.2, 0.6})}}};
  Reconstruction r = perfect(t);
  const Evaluation whole = evaluate(r, t);
  EXPECT_EQ(whole.interacted, 2) << "a couch whose seats are 2 m apart";
  EXPECT_NEAR(*whole.mean_distance, 0, 1e-12);
  r.objects[0] = {object(0, "couch", 0.8, 3), 1, {}};
  r.objects.push_back({object(1, "couch", 1.2, 3), 1, {}});
  const Evaluation twice = evaluate(r, t);
  EXPECT_EQ(twice.found, 2);
  EXPECT_EQ(twice.false_objects, 0) << "one couch, found twice 0.4 m apart";
  EXPECT_NEAR(*twice.mean_distance, 0, 1e-12);
  r.objects.back() = {object(1, "couch", 1.45, 3), 1, {}};
  EXPECT_EQ(evaluate(r, t).false_objects, 1) << "0.65 m apart are two";
}

TEST(Evaluate, TheResultsWorldDoesNotMatter) {
  const Recording t = truth();
  Reconstruction r = perfect(t);
  move(r.objects[0].object, Vec3(0.3, 0.4, 0));
  r.people[0].frames[5].pose.col(head) += Vec3(0.2, 0.1, 0.3);
  const Evaluation here = evaluate(r, t);
  const RigidTransform S = {Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix(), Vec3(1, -2, 0.5)};
  for (FoundObject& f : r.objects)
    for (Part& p : f.object.parts) p.box = {S * p.box.center, S.rotation * p.box.axes, p.box.half_size};
  for (PersonFrame& f : r.people[0].frames) f.pose = (S.rotation * f.pose).colwise() + S.translation;
  r.T_world_camera = S * r.T_world_camera;
  const Evaluation there = evaluate(r, t);
  EXPECT_NEAR(*there.mean_distance, *here.mean_distance, 1e-9);
  EXPECT_NEAR(there.all->local, here.all->local, 1e-9);
  EXPECT_NEAR(there.all->world, here.all->world, 1e-9);
}

TEST(Evaluate, PoseErrorsAreMeansOfJointsThenFrames) {
  const Recording t = truth();
  Reconstruction r = perfect(t);
  // Joints span 3.75 m by 0.45 m. Ten of the twenty frames with hidden knees: one knee is 0.3 m off, the hidden joints' mean 0.15 m.
  const double diagonal = std::hypot(3.75, 0.45);
  for (std::size_t f = 0; f < 10; ++f) r.people[0].frames[f].pose(2, left_knee) += 0.3;
  for (PersonFrame& f : r.people[0].frames) f.pose.col(neck) += Vec3(9, 9, 9);
  const Evaluation e = evaluate(r, t);
  EXPECT_NEAR(e.occluded->local, 0.075, 1e-12);
  EXPECT_NEAR(e.occluded->world, 0.075 / diagonal, 1e-12);
  EXPECT_NEAR(e.all->local, 10.0 / 31 * 0.3 / 14, 1e-12) << "the neck does not count";
  for (PersonFrame& f : r.people[0].frames) f.pose.colwise() += Vec3(0.3, 0, 0.4);
  EXPECT_NEAR(evaluate(r, t).all->local, e.all->local, 1e-12) << "where the person is does not matter";
  Reconstruction moved = perfect(t);
  for (PersonFrame& f : moved.people[0].frames) f.pose.colwise() += Vec3(0.3, 0, 0.4);
  EXPECT_NEAR(evaluate(moved, t).all->world, 0.5 / diagonal, 1e-12);
}

TEST(Evaluate, FramesThatTheResultLacksAreTakenBetweenTheOthers) {
  const Recording t = truth();
  Reconstruction r = perfect(t);
  std::erase_if(r.people[0].frames, [](const PersonFrame& f) { return f.frame % 3 == 1; });
  const Evaluation e = evaluate(r, t);
  EXPECT_EQ(e.all->frames, 31);
  EXPECT_EQ(e.all->interpolated, 10);
  EXPECT_EQ(e.occluded->interpolated, 7);
  EXPECT_NEAR(e.all->world, 0, 1e-12) << "the motion is uniform";
  std::erase_if(r.people[0].frames, [](const PersonFrame& f) { return f.frame > 0; });
  EXPECT_NEAR(evaluate(r, t).all->world * std::hypot(3.75, 0.45), 1.5, 1e-12) << "held at the ends";
}

TEST(Evaluate, ActionsAreComparedFrameByFrame) {
  const Recording t = truth();
  Reconstruction r = perfect(t);
  for (PersonFrame& f : r.people[0].frames) f.action = f.frame < 4 ? Action::stand : f.frame < 15 ? Action::stand_up : Action::lie;
  const Evaluation e = evaluate(r, t);
  EXPECT_EQ(e.confusion, (std::vector<std::vector<int>>{{16, 5, 0, 0}, {0, 0, 0, 0}, {0, 6, 4, 0}, {0, 0, 0, 0}}));
  EXPECT_NEAR(e.action_accuracy, 20.0 / 31, 1e-12);
}

TEST(Evaluate, PeopleAreMatchedByTheirPaths) {
  Recording t = truth();
  t.people.push_back(t.people[0]);
  for (RecordedFrame& f : t.people[1]) f.pose.colwise() += Vec3(0, 3, 0);
  Reconstruction r = perfect(t);
  std::swap(r.people[0], r.people[1]);
  const Evaluation whole = evaluate(r, t);
  EXPECT_NEAR(whole.all->world, 0, 1e-12) << "the order of people is free";
  EXPECT_EQ(*whole.identity, 1.0);
  for (std::size_t f = 0; f < 8; ++f) std::swap(r.people[0].frames[f], r.people[1].frames[f]);
  EXPECT_NEAR(*evaluate(r, t).identity, 23.0 / 31, 1e-12);
  Reconstruction alone = r;
  alone.people.pop_back();
  EXPECT_NEAR(*evaluate(alone, t).identity, 0.5 * 23.0 / 31, 1e-12) << "who is not there is not right";
  for (RecordedFrame& f : t.people[0])
    if (f.frame < 8) f.occluded.fill(true);
  EXPECT_NEAR(*evaluate(r, t).identity, 46.0 / (62 - 8), 1e-12) << "who is not seen cannot be told apart";
  for (Person& person : r.people)
    for (PersonFrame& f : person.frames) f.pose = ((f.pose.colwise() - t.T_world_camera.translation) * 3).colwise() + t.T_world_camera.translation;
  EXPECT_NEAR(*evaluate(r, t).identity, 46.0 / (62 - 8), 1e-12) << "how far away is another question";
}

TEST(Evaluate, ConsistencyIsMeasuredOnTheResult) {
  Recording t = truth();
  Reconstruction r = perfect(t);
  // The pelvis of frame f is at x = 0.1 f + 0.3, y = 1.82, z = 0.7: 0.06 m deep or more in this box for f = 10 … 14.
  r.objects[0].object.parts[0].box = box({1.5, 1.82, 0.7}, {0.52, 0.4, 0.4});
  const Evaluation e = evaluate(r, t);
  EXPECT_NEAR(e.inside_objects, 5.0 / 31, 1e-12);
  EXPECT_EQ(e.true_inside_objects, 0);
  EXPECT_NEAR(e.foot_skating, 1.0, 1e-9) << "the right ankle is 0.1 m high and moves 0.1 m a frame; the left is too high";
  EXPECT_EQ(e.overlapping, 0);
  r.objects.push_back({{9, "table", {{"top", box({1.7, 1.82, 0.8}, {0.52, 0.2, 0.1})}}}, 1, {}});
  EXPECT_NEAR(evaluate(r, t).overlapping, 0.32 * 0.2, 1e-12);
  move(r.objects.back().object, Vec3(0, 0, 0.6));
  EXPECT_EQ(evaluate(r, t).overlapping, 0) << "one above the other";
}

TEST(Footprints, ShareTheAreaThatSamplesSay) {
  Random random(5);
  for (int i = 0; i < 20; ++i) {
    const auto any = [&] {
      return OrientedBox{Vec3(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0),
                         Eigen::AngleAxisd(random.uniform(0, 6), Vec3::UnitZ()).toRotationMatrix(),
                         Vec3(random.uniform(0.2, 0.5), random.uniform(0.2, 0.5), random.uniform(0.2, 0.5))};
    };
    const auto a = footprint(any()), b = footprint(any());
    const auto holds = [](const std::vector<Vec2>& polygon, const Vec2& p) {
      for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 edge = polygon[(k + 1) % polygon.size()] - polygon[k], to = p - polygon[k];
        if (edge.x() * to.y() - edge.y() * to.x() < 0) return false;
      }
      return true;
    };
    int both = 0;
    constexpr int kSide = 400;
    for (int x = 0; x < kSide; ++x)
      for (int y = 0; y < kSide; ++y) {
        const Vec2 p(-1.5 + 3.0 * (x + 0.5) / kSide, -1.5 + 3.0 * (y + 0.5) / kSide);
        both += holds(a, p) && holds(b, p);
      }
    EXPECT_NEAR(area(intersection(a, b)), both * 9.0 / (kSide * kSide), 0.01);
  }
}

TEST(Assignment, IsTheBestOfAll) {
  Random random(11);
  for (int trial = 0; trial < 300; ++trial) {
    const auto rows = static_cast<Eigen::Index>(random.index(6)), columns = static_cast<Eigen::Index>(random.index(6));
    Eigen::MatrixXd cost(rows, columns);
    for (Eigen::Index r = 0; r < rows; ++r)
      for (Eigen::Index c = 0; c < columns; ++c) cost(r, c) = random.uniform() < 0.2 ? std::numeric_limits<double>::infinity() : random.uniform(0, 3);
    int most = -1;
    double least = std::numeric_limits<double>::infinity();
    const auto consider = [&](auto&& self, Eigen::Index row, unsigned used, int pairs, double sum) -> void {
      if (row == rows) {
        if (pairs > most || (pairs == most && sum < least)) most = pairs, least = sum;
        return;
      }
      self(self, row + 1, used, pairs, sum);
      for (Eigen::Index c = 0; c < columns; ++c)
        if (!(used >> c & 1U) && cost(row, c) <= 1.5) self(self, row + 1, used | 1U << c, pairs + 1, sum + cost(row, c));
    };
    consider(consider, 0, 0, 0, 0);
    int pairs = 0;
    double sum = 0;
    std::vector<int> seen;
    const std::vector<int> found = assign(cost, 1.5);
    ASSERT_EQ(found.size(), static_cast<std::size_t>(rows));
    for (Eigen::Index r = 0; r < rows; ++r) {
      const int c = found[static_cast<std::size_t>(r)];
      if (c < 0) continue;
      EXPECT_EQ(std::count(seen.begin(), seen.end(), c), 0);
      seen.push_back(c);
      ++pairs, sum += cost(r, c);
    }
    EXPECT_EQ(pairs, most);
    EXPECT_NEAR(sum, least, 1e-9);
  }
}

}  // namespace
}  // namespace unseen::interactions
