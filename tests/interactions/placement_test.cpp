// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/matching/placement_fit.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/linear.h"
#include "unseen/core/random.h"
#include "unseen/interactions/skeleton.h"

namespace unseen::interactions {
namespace {

struct Joints {
  Vec3 camera;
  std::vector<Vec3> points, rays;
  std::vector<double> weights;
};

/// Points of something that was placed, and rays to where they were then seen, off by `noise` (rad).
Joints random_joints(Random& random, int count, const Placement& placement, double noise) {
  Joints j;
  j.camera = Vec3(0, 0, random.uniform(0.5, 2));
  for (int i = 0; i < count; ++i) {
    j.points.emplace_back(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), random.uniform(0, 1.7));
    j.rays.push_back(((placement * j.points.back() - j.camera).normalized() + noise * random.direction()).normalized());
    j.weights.push_back(random.uniform(0.3, 1));
  }
  return j;
}

/// Sum of squared distances of the placed points to their rays.
double cost_of(const Joints& j, const Placement& placement) {
  double sum = 0;
  for (std::size_t i = 0; i < j.points.size(); ++i) sum += j.weights[i] * (placement * j.points[i] - j.camera).cross(j.rays[i]).squaredNorm();
  return sum;
}

PlacementCost quadratic_of(const Joints& j) {
  PlacementCost cost;
  for (std::size_t i = 0; i < j.points.size(); ++i)
    cost.add(j.points[i], j.camera, j.weights[i] * (Mat3::Identity() - j.rays[i] * j.rays[i].transpose()));
  return cost;
}

Placement random_placement(Random& random) { return {{random.uniform(-2, 2), random.uniform(2, 6), 0}, random.uniform(-kPi, kPi)}; }

/// Least cost of a grid over everything within 8 m, then of finer grids around its best places.
double least_by_search(const Joints& j) {
  double least = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < 24; ++turn) {
    Placement best;
    double of_turn = std::numeric_limits<double>::infinity();
    const auto scan = [&](const Placement& center, double reach, double turning, int turns) {
      for (int a = -turns; a <= turns; ++a)
        for (int x = -8; x <= 8; ++x)
          for (int y = -8; y <= 8; ++y) {
            const Placement p{center.position + reach / 8 * Vec3(x, y, 0), center.angle + turning * a};
            if (const double c = cost_of(j, p); c < of_turn) of_turn = c, best = p;
          }
    };
    scan({Vec3::Zero(), 2 * kPi * turn / 24}, 8, 0, 0);
    for (double reach = 1.0; reach > 1e-4; reach *= 0.4) scan(best, reach, 0.12 * reach, 2);
    least = std::min(least, of_turn);
  }
  return least;
}

TEST(PlacementCost, IsTheSquaredDistanceToRays) {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Joints j = random_joints(random, 10, random_placement(random), 0.2);
    const Placement p = random_placement(random);
    EXPECT_NEAR(quadratic_of(j).at(p.angle, p.position.head<2>()), cost_of(j, p), 1e-9);
  }
}

TEST(PlacementFit, IsAsGoodAsASearchOverAngleAndPosition) {
  Random random(2);
  for (int i = 0; i < 6; ++i) {
    const Joints j = random_joints(random, 3 + 3 * i, random_placement(random), 0.03 + 0.04 * i);
    PlacementFit fit;
    ASSERT_TRUE(fit_placement(quadratic_of(j), fit));
    EXPECT_NEAR(fit.cost, cost_of(j, {{fit.position.x(), fit.position.y(), 0}, fit.angle}), 1e-9);
    const double searched = least_by_search(j);
    EXPECT_LT(fit.cost, searched + 1e-9) << "case " << i;
    EXPECT_NEAR(fit.cost, searched, 1e-3 * searched + 1e-6) << "case " << i;
  }
}

TEST(PlacementFit, FindsAPlacementWithoutNoise) {
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    const Placement truth = random_placement(random);
    PlacementFit fit;
    ASSERT_TRUE(fit_placement(quadratic_of(random_joints(random, 12, truth, 0)), fit));
    EXPECT_NEAR((fit.position - truth.position.head<2>()).norm(), 0, 1e-6) << i;
    EXPECT_NEAR(std::remainder(fit.angle - truth.angle, 2 * kPi), 0, 1e-6) << i;
  }
}

/// Whatever the cost of the angle is, no angle does noticeably better.
TEST(PlacementFit, NoAngleIsBetter) {
  Random random(4);
  for (int i = 0; i < 3000; ++i) {
    PlacementCost cost;
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector4d v(random.normal(), random.normal(), random.normal(), random.normal());
      const double target = 2 * random.normal();
      cost.quadratic += v * v.transpose();
      cost.linear += target * v;
      cost.constant += target * target;
    }
    PlacementFit fit;
    if (!fit_placement(cost, fit)) continue;
    const Eigen::Matrix2d position = cost.quadratic.bottomRightCorner<2, 2>();
    double least = fit.cost, most = fit.cost;
    for (int a = 0; a < 720; ++a) {
      const double angle = kPi * a / 360;
      const Vec2 turn(std::cos(angle), std::sin(angle));
      const Vec2 best = -solve_symmetric<2>(position, cost.quadratic.bottomLeftCorner<2, 2>() * turn + cost.linear.tail<2>());
      least = std::min(least, cost.at(angle, best));
      most = std::max(most, cost.at(angle, best));
    }
    EXPECT_LT(fit.cost - least, 1e-3 * (most - least)) << i;
  }
}

TEST(PlacementFit, RefusesWhatDoesNotTellThePosition) {
  PlacementFit fit;
  EXPECT_FALSE(fit_placement({}, fit));
  // All rays level and parallel: the distance along them is open.
  PlacementCost parallel;
  for (int i = 0; i < 5; ++i) parallel.add({0.1 * i, 0, 0.2 * i}, Vec3(0, 0, 1), Mat3::Identity() - Vec3::UnitY() * Vec3::UnitY().transpose());
  EXPECT_FALSE(fit_placement(parallel, fit));
  PlacementCost unknown;
  unknown.add({0, 0, 1}, Vec3(0, 0, 1), Mat3::Constant(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(fit_placement(unknown, fit));
}

}  // namespace
}  // namespace unseen::interactions
