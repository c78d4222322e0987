// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// From boxes to a scene that stands: each step against geometry, the whole against generated scenes.
#include "cuboids/search/complete.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "box_problems.h"
#include "cuboids/search/hypotheses.h"
#include "synth_frame.h"
#include "unseen/cuboids/cuboids.h"
#include "unseen/cuboids/synth.h"

namespace unseen::cuboids {
namespace {

TEST(Reach, IsTheDistanceToTheNearestPointInTheWay) {
  const OrientedBox mover = box({0, 0, 1}, {0.2, 0.2, 0.2});
  EXPECT_NEAR(*reach(mover, 4, Support{0, SupportKind::ground, {Vec3::UnitZ(), 0.0}, {}}), 0.9, 1e-12);
  // A plane that rises along x: the corner at +x meets it first.
  const Vec3 normal = Vec3(-0.6, 0, 0.8);
  EXPECT_NEAR(*reach(mover, 4, Support{0, SupportKind::ground, {normal, 0.0}, {}}), 0.9 - 0.1 * 0.6 / 0.8, 1e-12);
  EXPECT_NEAR(*reach(mover, 4, solid_of(box({0.05, 0, 0.3}, {0.1, 0.1, 0.2})), 0.0), 0.5, 1e-12);
  // Turned by 45°, its edge is nearest to the face that moves along x.
  EXPECT_NEAR(*reach(mover, 1, solid_of(box({1, 0, 1}, {0.2, 0.2, 0.2}, kPi / 4)), 0.0), 0.9 - std::sqrt(0.02), 1e-9);
  EXPECT_FALSE(reach(mover, 5, solid_of(box({0, 0, 0.3}, {0.1, 0.1, 0.2})), 0.0));  // behind
  EXPECT_FALSE(reach(mover, 4, solid_of(box({0.5, 0, 0.3}, {0.1, 0.1, 0.2})), 0.0));  // beside
  EXPECT_FALSE(reach(mover, 5, Support{0, SupportKind::ground, {Vec3::UnitZ(), 0.0}, {}}));
}

TEST(Reach, MeetsAWallOfWhichOnlyTheUpperPartWasSeen) {
  const OrientedBox mover = box({0, 0, 0.3}, {0.4, 0.2, 0.6});
  const auto wall = [](double left, double right, double from) {
    return Support{1, SupportKind::wall, {-Vec3::UnitY(), -1.0}, {{left, 1, from}, {right, 1, from}, {right, 1, 2}, {left, 1, 2}}};
  };
  for (const double from : {0.0, 0.5}) EXPECT_NEAR(*reach(mover, 3, wall(-1, 1, from)), 0.9, 1e-12);
  EXPECT_NEAR(*reach(mover, 3, wall(0.1, 1, 0.2)), 0.9, 1e-12);
  EXPECT_FALSE(reach(mover, 3, wall(-1, 1, 0.7)));    // below it
  EXPECT_FALSE(reach(mover, 3, wall(0.3, 1, 0.0)));   // beside it
  EXPECT_FALSE(reach(mover, 2, wall(-1, 1, 0.0)));
}

TEST(Search, DoesNotDependOnTurnsAndMirrors) {
  const auto cost = [](double turn, double mirror) {
    std::vector<OrientedBox> boxes;
    for (const OrientedBox& b : {box({0, 0, 0.1}, {0.1, 0.2, 0.2}), box({0.09, 0.02, 0.27}, {0.15, 0.2, 0.1}), box({0.4, 0, 0.5}, {0.1, 0.1, 0.1})}) {
      const Vec3 center(b.center.x(), mirror * b.center.y(), b.center.z());
      boxes.push_back(box(Eigen::AngleAxisd(turn, Vec3::UnitZ()) * center, 2.0 * b.half_size, turn));
    }
    Problem problem = problem_of(boxes);
    problem.push = 0.0;
    problem.hypotheses = propose_contacts(problem, Rooms(3, Extension{0.4, 0.4, 0.4, 0.4, 0.6, 0.0}));
    Context context;
    return search_contacts(problem, [](const Arrangement&) { return true; }, {100000, 60.0}, context).cost;
  };
  const Cost first = cost(0.0, 1.0);
  EXPECT_GT(first.volume, 0.0);
  for (const auto& [turn, mirror] : {std::pair{0.7, 1.0}, std::pair{2.9, 1.0}, std::pair{0.0, -1.0}, std::pair{1.3, -1.0}}) {
    EXPECT_EQ(cost(turn, mirror).fixed, first.fixed);
    EXPECT_NEAR(cost(turn, mirror).volume, first.volume, 1e-8);
  }
}

Completion completed(const SynthView& view) {
  Context context;
  return complete_cuboids(frame_of(view), Options{}, context);
}

/// The true cuboid that a box of the result stands for: the nearest.
int true_id(const Truth& truth, const Cuboid& c) {
  const auto nearest = std::min_element(truth.cuboids.begin(), truth.cuboids.end(), [&](const auto& a, const auto& b) {
    return (a.box->center - c.box.center).norm() < (b.box->center - c.box.center).norm();
  });
  return nearest->id;
}

TEST(Completed, SliversDoNotTiltABox) {
  // Of the monitor's foot, or of a book beneath another, a few hundred points are seen, and no desk has anything that leans.
  SynthOptions options;
  options.scene = "desk";
  options.seed = 2;
  Context context;
  for (const SynthView& view : make_scene(options, context).views)
    for (const Cuboid& c : completed(view).cuboids)
      EXPECT_LT(degrees(std::acos(std::min(1.0, c.box.axes.row(2).cwiseAbs().maxCoeff()))), 3.0) << "view " << view.number << ", box " << c.label;
}

class Stacks : public testing::TestWithParam<const char*> {};

TEST_P(Stacks, HaveTheirTrueContactsAndStand) {
  SynthOptions options;
  options.scene = GetParam();
  Context context;
  for (const SynthView& view : make_scene(options, context).views) {
    const Completion result = completed(view);
    ASSERT_EQ(result.cuboids.size(), view.truth.cuboids.size()) << view.number;
    EXPECT_TRUE(result.stability.stable);
    EXPECT_GE(result.stability.margin, 0.09);
    std::set<std::tuple<int, int, int>> found, real;
    const auto id = [&](int of) {
      for (const Cuboid& c : result.cuboids)
        if (c.id == of) return true_id(view.truth, c);
      for (const Support& s : result.supports)
        for (const Support& t : view.truth.supports)
          if (s.id == of && s.kind == t.kind) return t.id;
      return -1;
    };
    for (const Contact& c : result.contacts) found.insert({std::min(id(c.a), id(c.b)), std::max(id(c.a), id(c.b)), static_cast<int>(c.kind)});
    for (const Contact& c : view.truth.contacts) real.insert({std::min(c.a, c.b), std::max(c.a, c.b), static_cast<int>(c.kind)});
    EXPECT_EQ(found, real) << view.number;
    // No box in space that was seen to be empty, by the noise-free depth.
    for (const Cuboid& c : result.cuboids) {
      int free = 0, all = 0;
      for (double x = -0.8; x <= 0.81; x += 0.2)
        for (double y = -0.8; y <= 0.81; y += 0.2)
          for (double z = -0.8; z <= 0.81; z += 0.2) {
            const Vec3 p = result.T_world_camera.inverse() * (c.box.center + c.box.axes * c.box.half_size.cwiseProduct(Vec3(x, y, z)));
            const Vec2 pixel = view.camera.project(p);
            const int u = static_cast<int>(std::lround(pixel.x())), v = static_cast<int>(std::lround(pixel.y()));
            if (u < 0 || v < 0 || u >= view.camera.width || v >= view.camera.height) continue;
            ++all;
            free += view.exact_depth[static_cast<std::size_t>(v) * view.camera.width + u] > p.z() + 0.015;
          }
      EXPECT_LE(free, 0.05 * all) << "box " << c.id << " of view " << view.number;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Families, Stacks, testing::Values("tower", "twisted", "bridge", "cyclic", "shelf"));

TEST(HiddenLegs, AreCompletedBySymmetryWhereTheyAre) {
  const SynthView view = view_of("chair-1", 0);
  const Completion result = completed(view);
  int legs = 0;
  for (const Cuboid& c : result.cuboids) {
    if (!c.by_symmetry) continue;
    ++legs;
    const Truth& truth = view.truth;
    const auto& real = *std::find_if(truth.cuboids.begin(), truth.cuboids.end(), [&](const TrueCuboid& t) { return t.id == true_id(truth, c); });
    EXPECT_LT((real.box->center - c.box.center).head<2>().norm(), 2.0 * real.box->half_size.head<2>().minCoeff());
    for (const double share : real.hidden) EXPECT_GT(share, 0.95);  // truly unseen
  }
  EXPECT_EQ(legs, 1);
}

TEST(Complete, SaysSoIfThereIsNothing) {
  SynthView view = view_of("tower", 0);
  for (std::size_t i = 0; i < view.masks.size(); ++i)
    if (view.masks[i] != 0) view.depth[i] = 0.0f;
  std::fill(view.masks.begin(), view.masks.end(), 0);
  EXPECT_EQ(completed(view).summary.status, Status::infeasible);
}

TEST(Complete, AMaskedWallOfBricksIsNoWall) {
  const Completion result = completed(view_of("running-bond", 2, 56));
  EXPECT_EQ(result.supports.size(), 1u);
  EXPECT_EQ(result.cuboids.size(), 56u);
}

TEST(Complete, StopsWhenAsked) {
  const SynthView view = view_of("desk", 0);
  std::stop_source stop;
  stop.request_stop();
  Context stopped;
  stopped.stop = stop.get_token();
  const Completion result = complete_cuboids(frame_of(view), Options{}, stopped);
  EXPECT_EQ(result.summary.status, Status::cancelled);
  EXPECT_TRUE(result.cuboids.empty());
}

}  // namespace
}  // namespace unseen::cuboids
