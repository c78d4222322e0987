// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/search/search.h"

#include <gtest/gtest.h>

#include <map>
#include <optional>

#include "cuboids/search/collapse.h"
#include "cuboids/search/hypotheses.h"
#include "unseen/core/random.h"

namespace unseen::cuboids {
namespace {

constexpr double kTolerance = 0.004;

Cuboid cuboid(const Vec3& center, const Vec3& size, double yaw = 0.0) {
  Cuboid c;
  c.initial = {center, Eigen::AngleAxisd(yaw, Vec3::UnitZ()).toRotationMatrix(), 0.5 * size};
  c.box = c.initial;
  return c;
}

/// Boxes over a ground, whose faces may all move by `room`, but upward.
Problem growing_scene(std::vector<Cuboid> cuboids, double room, double push = 0.0) {
  Problem problem;
  problem.supports.push_back({0, SupportKind::ground, {Vec3::UnitZ(), 0.0}, {}});
  problem.cuboids = std::move(cuboids);
  problem.tolerance.assign(problem.cuboids.size(), kTolerance);
  problem.push = push;
  Rooms rooms(problem.cuboids.size());
  for (Extension& e : rooms) e = {room, room, room, room, room, 0.0};
  problem.hypotheses = propose_contacts(problem, rooms);
  return problem;
}

bool always(const Arrangement&) { return true; }

Choice search(const Problem& problem) {
  Context context;
  return search_contacts(problem, always, {1000000, 60.0}, context);
}

/// The cheapest of all assignments of at most one hypothesis to each pair.
struct Exhaustive {
  const Problem& problem;
  std::vector<std::vector<int>> pairs;
  bool found = false;
  Cost best;
  std::size_t tried = 0;

  explicit Exhaustive(const Problem& p) : problem(p) {
    std::map<std::pair<int, int>, std::vector<int>> by_pair;
    for (std::size_t h = 0; h < p.hypotheses.size(); ++h)
      by_pair[{p.hypotheses[h].a, p.hypotheses[h].b}].push_back(static_cast<int>(h));
    for (auto& [pair, list] : by_pair) pairs.push_back(list);
    visit(0, {});
  }
  void visit(std::size_t pair, std::vector<int> chosen) {
    if (pair < pairs.size()) {
      visit(pair + 1, chosen);
      for (const int h : pairs[pair]) {
        chosen.push_back(h);
        visit(pair + 1, chosen);
        chosen.pop_back();
      }
      return;
    }
    ++tried;
    const Arrangement a = arrange(problem, chosen);
    const auto glued = std::count_if(a.fixed.begin(), a.fixed.end(), [](const auto& pair) { return pair[0] == 0; });  // the ground is the only support
    const Cost cost = {static_cast<double>(a.fixed.size()), a.extended_volume, static_cast<double>(glued)};
    if (found && !cheaper(cost, best)) return;
    if (penetrates(problem, a)) return;
    const std::vector<char> held(problem.bodies(), 0);
    const Structure s = structure_of(problem, a, touching_pairs(problem, a), held);
    if (balance(s.bodies, s.contacts).residual >= problem.stable_residual) return;
    found = true;
    best = cost;
  }
};

TEST(Search, LeavesWhatStandsAlone) {
  const Choice choice = search(growing_scene({cuboid({0, 0, 0.1}, {0.2, 0.2, 0.2}), cuboid({0, 0, 0.25}, {0.1, 0.1, 0.1}, 0.5)}, 0.5));
  EXPECT_TRUE(choice.optimal);
  EXPECT_TRUE(choice.chosen.empty());
}

TEST(Search, ExtendsAFloatingBoxToTheGround) {
  const Problem problem = growing_scene({cuboid({0, 0, 0.35}, {0.1, 0.1, 0.1})}, 0.5);
  const Choice choice = search(problem);
  EXPECT_TRUE(choice.optimal);
  EXPECT_EQ(choice.cost.fixed, 0);
  EXPECT_NEAR(choice.cost.volume, 0.01 * 0.3, 1e-9);
  EXPECT_NEAR(arrange(problem, choice.chosen).boxes[0].half_size.z(), 0.2, 1e-9);
}

TEST(Search, LetsACarrierGrowUnderTheCentreOfMass) {
  // The upper box rests on the lower one by a tenth of its length only.
  const Problem problem = growing_scene({cuboid({-0.08, 0, 0.1}, {0.1, 0.2, 0.2}), cuboid({0.01, 0, 0.25}, {0.1, 0.2, 0.1})}, 0.5);
  const Choice choice = search(problem);
  EXPECT_EQ(choice.cost.fixed, 0);
  const Arrangement a = arrange(problem, choice.chosen);
  EXPECT_NEAR(a.boxes[0].center.x() + a.boxes[0].half_size.x(), 0.01, 0.011);  // at the centre of mass of the upper one
}

TEST(Hypotheses, WhatWasSeenToEndDoesNotGrowBesideAnother) {
  // The upper box begins 1 mm beyond the lower one. Sides that were seen may still move by what the fit leaves open.
  for (const double room : {2.4, 3.0}) {
    const Problem problem = growing_scene({cuboid({0, 0, 0.1}, {0.2, 0.2, 0.2}), cuboid({0.201, 0, 0.25}, {0.2, 0.2, 0.1})}, room * kTolerance);
    const auto beside = std::count_if(problem.hypotheses.begin(), problem.hypotheses.end(), [&](const Hypothesis& h) {
      return !problem.is_support(h.a) && h.kind == ContactKind::fixed && h.moves.size() == 1 && h.moves[0].face < 4;
    });
    EXPECT_EQ(beside > 0, room > 2.5) << room;
  }
}

TEST(Search, FixesOnlyWhatNothingElseHolds) {
  // A block beside a pillar, with no room to grow: it can only be part of it.
  const Choice choice = search(growing_scene({cuboid({0, 0, 0.2}, {0.1, 0.1, 0.4}), cuboid({0.1, 0, 0.3}, {0.1, 0.1, 0.05})}, 0.0));
  EXPECT_TRUE(choice.optimal);
  EXPECT_EQ(choice.cost.fixed, 1);
  EXPECT_EQ(choice.cost.volume, 0.0);
}

TEST(Search, RatherFixesATopToItsLegThanTheLegToTheGround) {
  // Two legs as thin as boards under a top: one fixed contact keeps them from falling over when pushed, and any would do.
  const Problem problem =
      growing_scene({cuboid({-0.5, 0, 0.35}, {0.04, 0.7, 0.7}), cuboid({0.5, 0, 0.35}, {0.04, 0.7, 0.7}), cuboid({0, 0, 0.72}, {1.4, 0.8, 0.04})}, 0.0, 0.2);
  const Choice choice = search(problem);
  EXPECT_TRUE(choice.optimal);
  ASSERT_EQ(choice.cost.fixed, 1);
  for (const int h : choice.chosen) EXPECT_FALSE(problem.is_support(problem.hypotheses[h].a));
}

TEST(Search, PiecesOfOneObjectAreFixedOnce) {
  Problem problem = growing_scene({cuboid({0, 0, 0.1}, {0.2, 0.2, 0.2}), cuboid({0, 0, 0.25}, {0.1, 0.1, 0.1})}, 0.0);
  problem.joints = {{1, 2}};
  std::vector<int> all;
  for (std::size_t h = 0; h < problem.hypotheses.size(); ++h)
    if (problem.hypotheses[h].a == 1 && problem.hypotheses[h].b == 2 && problem.hypotheses[h].kind == ContactKind::fixed) all.push_back(static_cast<int>(h));
  ASSERT_FALSE(all.empty());
  Arrangement arrangement = arrange(problem, all);
  arrangement.fix({1, 2});
  EXPECT_EQ(arrangement.fixed.size(), 1u);
}

TEST(Search, CallsUnsupportedWhatNothingCanHold) {
  const Problem problem = growing_scene({cuboid({0, 0, 0.1}, {0.2, 0.2, 0.2}), cuboid({2, 0, 0.9}, {0.1, 0.1, 0.1})}, 0.0);
  const Choice choice = search(problem);
  EXPECT_FALSE(choice.held[1]);
  EXPECT_TRUE(choice.held[2]);
}

/// Whether brute force over all assignments can look at the scene at all.
bool is_small(const Problem& problem) {
  double assignments = 1.0;
  std::map<std::pair<int, int>, int> by_pair;
  for (const Hypothesis& h : problem.hypotheses) ++by_pair[{h.a, h.b}];
  for (const auto& [pair, n] : by_pair) assignments *= n + 1;
  const auto touches = touching_pairs(problem, arrange(problem, {}));
  const bool overlapping = std::any_of(touches.begin(), touches.end(), [](const Touch& t) { return t.interface.gap < -kTolerance; });
  return assignments <= 2e4 && !overlapping;
}

/// The choice, or none where nothing stands.
std::optional<Choice> choice_as_by_brute_force(const Problem& problem) {
  const Exhaustive brute(problem);
  const Choice choice = search(problem);
  const bool nothing_held = std::none_of(choice.held.begin(), choice.held.end(), [](char h) { return h; });
  EXPECT_EQ(brute.found, nothing_held);
  if (!brute.found) return std::nullopt;
  EXPECT_TRUE(choice.optimal);
  EXPECT_EQ(choice.cost.fixed, brute.best.fixed);
  EXPECT_NEAR(choice.cost.volume, brute.best.volume, 1e-8);
  EXPECT_EQ(choice.cost.grounded, brute.best.grounded);
  return choice;
}

TEST(Search, EqualsBruteForce) {
  Random random(7);
  int compared = 0, extended = 0, fixed = 0;
  for (int scene = 0; scene < 400 && compared < 60; ++scene) {
    SCOPED_TRACE(scene);
    std::vector<Cuboid> cuboids;
    const int count = 2 + static_cast<int>(random.index(2));
    for (int i = 0; i < count; ++i) {
      const Vec3 size(random.uniform(0.05, 0.2), random.uniform(0.05, 0.2), random.uniform(0.05, 0.2));
      const double z = random.uniform() < 0.4 ? 0.5 * size.z() : random.uniform(0.1, 0.5);
      cuboids.push_back(cuboid({random.uniform(-0.12, 0.12), random.uniform(-0.12, 0.12), z}, size, random.uniform(-0.2, 0.2)));
    }
    const Problem problem = growing_scene(cuboids, random.uniform(0.0, 0.4));
    if (!is_small(problem)) continue;
    ++compared;
    const std::optional<Choice> choice = choice_as_by_brute_force(problem);
    extended += choice && choice->cost.volume > 0.0;
    fixed += choice && choice->cost.fixed > 0;
  }
  EXPECT_GE(compared, 40);
  EXPECT_GE(extended, 10);
  EXPECT_GE(fixed, 3);
}

TEST(Search, EqualsBruteForceWhereNoCollapseProvesAnything) {
  Random random(8);
  int compared = 0, extended = 0;
  for (int scene = 0; scene < 200; ++scene) {
    SCOPED_TRACE(scene);
    const double beyond = random.uniform(0.01, 0.05), lean = random.uniform(-0.2, 0.2);
    Problem problem = growing_scene({cuboid({0, 0, 0.1}, {0.2, 0.2, 0.2}, lean), cuboid({0.1 + beyond, 0.02, 0.25}, {0.24, 0.1, 0.1}, random.uniform(-0.2, 0.2))},
                                    random.uniform(0.0, 0.3));
    const Arrangement now = arrange(problem, {});
    const std::vector<Touch> touches = touching_pairs(problem, now);
    const std::vector<char> held(problem.bodies(), 0);
    const Structure structure = structure_of(problem, now, touches, held);
    const Balance b = balance(structure.bodies, structure.contacts);
    const double proven = proven_residual(motion_left(b, -Vec3::UnitZ(), structure, problem), problem, now, touches, held);
    if (!is_small(problem) || proven > 0.95 * b.residual) continue;
    problem.stable_residual = 0.5 * (proven + b.residual);
    ++compared;
    const std::optional<Choice> choice = choice_as_by_brute_force(problem);
    ASSERT_TRUE(choice);
    extended += choice->cost.volume > 0.0;
  }
  EXPECT_GE(compared, 40);
  EXPECT_GE(extended, 10);
}

}  // namespace
}  // namespace unseen::cuboids
