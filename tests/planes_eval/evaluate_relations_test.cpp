// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "unseen/core/error.h"
#include "unseen/planes/evaluate.h"

namespace unseen::planes {
namespace {

Vec3 turned(double deg) {
  return {std::cos(radians(deg)), std::sin(radians(deg)), 0};
}

TEST(EvaluateRelations, ThetaHoldsFoldedMultiples) {
  const auto angles = folded_angles({radians(60), radians(90)});
  ASSERT_EQ(angles.size(), 3u);
  EXPECT_EQ(angles[0], 0.0);
  EXPECT_NEAR(angles[1], radians(60), 1e-12);
  EXPECT_NEAR(angles[2], radians(90), 1e-12);
  EXPECT_EQ(folded_angles({}).size(), 1u);
  EXPECT_THROW(folded_angles({0.0}), InputError);
}

TEST(EvaluateRelations, NearMissesAreNeitherExactNorFar) {
  const auto count = [](double deg) {
    return count_near_misses({{turned(0), 0}, {turned(deg), 0}}, {radians(90)});
  };
  EXPECT_EQ(count(0.0), 0u);
  EXPECT_EQ(count(0.005), 0u);
  EXPECT_EQ(count(0.5), 1u);
  EXPECT_EQ(count(90.5), 1u);
  EXPECT_EQ(count(179.5), 1u);
  EXPECT_EQ(count(1.5), 0u);
}

TEST(EvaluateRelations, LargestErrorIsFoundWhereverItIsStated) {
  Arrangement a;
  a.angles = {radians(90)};
  a.directions = {{turned(0), 0}, {turned(90), 0}};
  a.frames = {{{0, 1}, {0, 1, 2}}};
  a.relations = {{0, 1, radians(90)}};
  a.planes.resize(3);
  a.planes[0].plane.normal = turned(0);
  a.planes[1].plane.normal = -turned(0);
  a.planes[2].plane.normal = turned(90);
  a.planes[0].direction = a.planes[1].direction = 0;
  a.planes[2].direction = 1;
  a.plane_relations = 3;
  const RelationScore exact = evaluate_relations(a);
  EXPECT_LT(exact.largest_error, 1e-12);
  EXPECT_EQ(exact.near_misses, 0u);
  EXPECT_EQ(exact.planes, 3u);
  EXPECT_EQ(exact.frames, 1u);
  EXPECT_EQ(exact.relations, 1u);

  Arrangement relation = a;
  relation.directions[1].normal = relation.planes[2].plane.normal = turned(90.2);
  EXPECT_NEAR(evaluate_relations(relation).largest_error, radians(0.2), 1e-12);
  EXPECT_EQ(evaluate_relations(relation).near_misses, 2u);
  Arrangement plane = a;
  plane.planes[1].plane.normal = turned(0.3);
  EXPECT_NEAR(evaluate_relations(plane).largest_error, radians(0.3), 1e-12);
  Arrangement coplanar = a;
  coplanar.coplanar = {{0, 2}};
  EXPECT_NEAR(evaluate_relations(coplanar).largest_error, radians(90), 1e-12);
}

}  // namespace
}  // namespace unseen::planes
