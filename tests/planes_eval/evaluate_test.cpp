// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/planes/evaluate.h"

#include <gtest/gtest.h>

#include "planes/evaluate/triangle_tree.h"
#include "unseen/core/error.h"
#include "unseen/core/random.h"

namespace unseen::planes {
namespace {

/// Floor z = 0 and wall x = 0, two triangles each, and one triangle without area.
TriangleMesh corner() {
  TriangleMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {0, 1, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {0, 5, 4}, {1, 1, 2}};
  return mesh;
}

struct Sample {
  std::vector<Vec3> points;
  std::vector<int> plane_of_point;
  std::vector<Plane> planes = {{Vec3::UnitZ(), 0.0}, {Vec3::UnitX(), 0.0}};
};

Sample sample_corner(int count) {
  Sample s;
  Random random(7);
  for (int i = 0; i < count; ++i) {
    const double u = random.uniform(0.1, 0.9), v = random.uniform(0.1, 0.9);
    s.points.push_back(i % 2 == 0 ? Vec3(u, v, 0) : Vec3(0, u, v));
    s.plane_of_point.push_back(i % 2);
  }
  return s;
}

TEST(EvaluateMesh, PerfectResultHasNoError) {
  Context context;
  Sample s = sample_corner(1000);
  s.planes[1].normal = -s.planes[1].normal;  // signs do not matter
  const MeshScore score =
      evaluate_against_mesh(s.points, s.plane_of_point, s.planes, corner(), {0.05, 20000, 1}, context);
  EXPECT_EQ(score.points, 1000u);
  EXPECT_EQ(score.ambiguous + score.uncovered, 0u);
  EXPECT_EQ(score.as_assigned.angles.pairs, 20000u);
  EXPECT_LT(score.as_assigned.angles.mean, 1e-12);
  EXPECT_EQ(score.as_assigned.angles.below_tenth, 1.0);
  EXPECT_EQ(score.as_assigned.recall, 1.0);
}

TEST(EvaluateMesh, TurnedPlaneCostsItsAngleOnMixedPairsOnly) {
  Context context;
  Sample s = sample_corner(1000);
  const double turn = radians(0.5);
  s.planes[1].normal = Vec3(std::cos(turn), 0, std::sin(turn));
  const AngleScore a =
      evaluate_against_mesh(s.points, s.plane_of_point, s.planes, corner(), {0.05, 200000, 1}, context)
          .as_assigned.angles;
  EXPECT_NEAR(a.mean, turn / 2, 0.02 * turn);  // half the pairs are mixed
  EXPECT_NEAR(a.deviation, turn / 2, 0.02 * turn);
  EXPECT_NEAR(a.below_tenth, 0.5, 0.01);
  EXPECT_EQ(a.below_one, 1.0);
}

TEST(EvaluateMesh, FoldsEachAngleBeforeTheDifference) {
  Context context;
  const std::vector<Vec3> points = {{0.5, 0.5, 0}, {0, 0.5, 0.5}};
  // True angle 90°; assigned 95°, which folds to 85°.
  const std::vector<Plane> planes = {{Vec3::UnitZ(), 0},
                                     {Vec3(std::cos(radians(5)), 0, -std::sin(radians(5))), 0}};
  const auto a =
      evaluate_against_mesh(points, {0, 1}, planes, corner(), {0.1, 10, 1}, context).as_assigned.angles;
  EXPECT_NEAR(a.mean, radians(5), 1e-12);
}

TEST(EvaluateMesh, PointsByAnEdgeAreLeftOutAndFarOnesHaveNoTruth) {
  Context context;
  const std::vector<Vec3> points = {
      {0.5, 0.5, 0}, {0.01, 0.5, 0.01}, {0.5, 0.5, 0.8}, {0.4, 0.4, 0}, {std::nan(""), 0, 0}};
  const auto score = evaluate_against_mesh(points, {0, 1, 0, 0, 0}, {{Vec3::UnitZ(), 0}, {Vec3::UnitX(), 0}},
                                           corner(), {0.05, 100, 1}, context);
  EXPECT_EQ(score.points, 4u);
  EXPECT_EQ(score.ambiguous, 1u);
  EXPECT_EQ(score.uncovered, 1u);
  EXPECT_EQ(score.as_assigned.used, 2u);
}

TEST(EvaluateMesh, UnassignedPointsAreMissedThenGivenTheNearestPlane) {
  Context context;
  Sample s = sample_corner(1000);
  for (int i = 0; i < 1000; i += 4) s.plane_of_point[i] = -1;  // half of the floor
  const auto score =
      evaluate_against_mesh(s.points, s.plane_of_point, s.planes, corner(), {0.05, 1000, 1}, context);
  EXPECT_EQ(score.assigned, 750u);
  EXPECT_EQ(score.as_assigned.recall, 0.75);
  EXPECT_EQ(score.nearest.recall, 1.0);
  EXPECT_EQ(score.nearest.used, 1000u);
}

TEST(EvaluateMesh, WrongPlaneCostsRecallAndOnlyTheAnglesOfAllAssigned) {
  Context context;
  Sample s = sample_corner(1000);
  s.points[0] = {0.5, 0.5, 0};
  s.plane_of_point[0] = 1;  // a floor point on the wall, 0.5 m away
  const auto score =
      evaluate_against_mesh(s.points, s.plane_of_point, s.planes, corner(), {0.05, 100000, 1}, context);
  EXPECT_EQ(score.as_assigned.recalled, 999u);
  EXPECT_NEAR(score.as_assigned.angles.mean, 2.0 / 1000 * radians(90), 0.1 * 2.0 / 1000 * radians(90));
  EXPECT_LT(score.as_assigned.angles_recalled.mean, 1e-12);
}

TEST(EvaluateMesh, SameSeedSameScoreAtAnyThreadCount) {
  Sample s = sample_corner(20000);
  s.planes[1].normal = Vec3(1, 0.01, 0.002).normalized();
  std::vector<double> means;
  for (const int threads : {1, 2, 4}) {
    Context context;
    context.threads = threads;
    means.push_back(
        evaluate_against_mesh(s.points, s.plane_of_point, s.planes, corner(), {0.05, 5000, 3}, context)
            .as_assigned.angles.mean);
  }
  EXPECT_EQ(means[0], means[1]);
  EXPECT_EQ(means[0], means[2]);
}

TEST(EvaluateMesh, BadInputIsNamed) {
  Context context;
  const Sample s = sample_corner(10);
  TriangleMesh flat;
  flat.vertices = {Vec3::Zero(), Vec3::UnitX()};
  flat.triangles = {{0, 1, 1}};
  const auto field = [&](auto&& call) {
    try {
      call();
    } catch (const InputError& e) {
      return e.field;
    }
    return std::string("none");
  };
  EXPECT_EQ(field([&] { evaluate_against_mesh(s.points, {0}, s.planes, corner(), {0.05}, context); }),
            "plane_of_point");
  EXPECT_EQ(field([&] { evaluate_against_mesh({Vec3::Zero()}, {2}, s.planes, corner(), {0.05}, context); }),
            "plane_of_point");
  EXPECT_EQ(
      field([&] { evaluate_against_mesh(s.points, s.plane_of_point, s.planes, corner(), {0}, context); }),
      "scale");
  EXPECT_EQ(
      field([&] { evaluate_against_mesh(s.points, s.plane_of_point, s.planes, flat, {0.05}, context); }),
      "truth");
}

TEST(EvaluateResult, AgreesWithItselfAndMeasuresATurn) {
  Context context;
  const Sample s = sample_corner(1000);
  const auto same = evaluate_against_result(s.points, s.plane_of_point, s.planes, s.plane_of_point, s.planes,
                                            {0.05, 10000, 1}, context);
  EXPECT_EQ(same.as_assigned.angles.mean, 0.0);
  EXPECT_EQ(same.as_assigned.recall, 1.0);
  Sample turned = s;
  turned.planes[0].normal = Vec3(std::sin(radians(2)), 0, std::cos(radians(2)));
  const auto off = evaluate_against_result(s.points, turned.plane_of_point, turned.planes, s.plane_of_point,
                                           s.planes, {0.05, 100000, 1}, context);
  EXPECT_NEAR(off.as_assigned.angles.mean, radians(1), 0.03 * radians(1));
}

TEST(TriangleTree, NearestMatchesEveryTriangle) {
  Random random(3);
  TriangleMesh mesh;
  for (int i = 0; i < 300; ++i) {
    const Vec3 at = 2.0 * random.direction();
    for (int k = 0; k < 3; ++k) mesh.vertices.push_back(at + 0.3 * random.direction());
    const auto first = static_cast<std::uint32_t>(3 * i);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const TriangleTree tree(mesh);
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = random.uniform(0.0, 4.0) * random.direction();
    double best = 1e9;
    for (const auto& t : mesh.triangles)
      best = std::min(
          best,
          (p - nearest_on_triangle(p, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]])).norm());
    EXPECT_NEAR(tree.nearest(p).distance, best, 1e-12);
  }
}

}  // namespace
}  // namespace unseen::planes
