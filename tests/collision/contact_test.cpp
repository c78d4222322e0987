// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "collision/solve/contact.h"
#include "collision/solve/contact_law.h"
#include "unseen/core/error.h"
#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

Body box(const Vec3& size) {
  Body b;
  b.name = "box";
  b.shape = Shape::box;
  b.box = size;
  return b;
}

Body mesh_of_box(const Vec3& size, const Vec3& offset) {
  Body b = box(size);
  b.shape = Shape::mesh;
  for (int i = 0; i < 8; ++i) b.mesh.vertices.push_back(offset + 0.5 * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).cwiseProduct(size));
  b.mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return b;
}

Body ball(double radius) {
  Body b;
  b.name = "ball";
  b.radius = radius;
  return b;
}

TEST(MassProperties, OfAMeshEqualTheClosedFormOfTheBox) {
  const Vec3 size(0.1, 0.2, 0.3), offset(5.0, -3.0, 2.0);
  const MassProperties of_mesh = mass_properties(mesh_of_box(size, offset), "test"), of_box = mass_properties(box(size), "test");
  EXPECT_LT((of_mesh.center - offset).norm(), 1e-12);
  EXPECT_NEAR(of_mesh.volume, of_box.volume, 1e-12);
  EXPECT_NEAR(of_mesh.extent, of_box.extent, 1e-12);
  Vec3 sorted = of_box.inertia;
  std::sort(sorted.data(), sorted.data() + 3);
  EXPECT_LT((of_mesh.inertia - sorted).norm(), 1e-12);
}

TEST(MassProperties, RefuseAnOpenMesh) {
  Body open = mesh_of_box(Vec3(1, 1, 1), Vec3::Zero());
  open.mesh.triangles.pop_back();
  EXPECT_THROW(mass_properties(open, "test"), InputError);
}

TEST(Contact, OfSpheresIsTheLineOfCentres) {
  const Solid a = solid_of(ball(0.1), ""), b = solid_of(ball(0.2), "");
  const auto near = nearest(a, Vec3(1, 0, 0), Quat::Identity(), b, Vec3(0, 0, 0), Quat::Identity(), 0.001);
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->gap, 0.7, 1e-12);
  EXPECT_LT((near->normal - Vec3::UnitX()).norm(), 1e-12);
  EXPECT_LT((near->point_b - Vec3(0.2, 0, 0)).norm(), 1e-12);
}

TEST(Contact, OfABallAndABoxAgreesWithTheNearestPointOfTheBox) {
  const Vec3 size(0.2, 0.3, 0.4);
  const Solid a = solid_of(ball(0.05), ""), b = solid_of(box(size), "");
  Random random(7);
  for (int i = 0; i < 200; ++i) {
    const Vec3 center = 0.5 * random.direction();
    const Vec3 on_box = center.cwiseMax(-0.5 * size).cwiseMin(0.5 * size);
    const auto near = nearest(a, center, Quat::Identity(), b, Vec3::Zero(), Quat::Identity(), 1e-6);
    ASSERT_TRUE(near);
    EXPECT_NEAR(near->gap, (center - on_box).norm() - 0.05, 1e-9);
    EXPECT_LT((near->normal - (center - on_box).normalized()).norm(), 1e-6);
  }
}

TEST(Contact, OfACornerOnAFaceIsTheCorner) {
  const Solid a = solid_of(box(Vec3(0.1, 0.1, 0.1)), ""), b = solid_of(box(Vec3(1, 1, 0.2)), "");
  const Quat q = Quat::FromTwoVectors(Vec3(1, 1, 1), Vec3(0, 0, -1));
  const auto near = nearest(a, Vec3(0.1, 0.2, 0.1 + 0.05 * std::sqrt(3.0)), q, b, Vec3::Zero(), Quat::Identity(), 0.002);
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->gap, 0.0, 1e-9);
  EXPECT_LT((near->normal - Vec3::UnitZ()).norm(), 1e-9);
  EXPECT_LT((near->point_a - Vec3(0.1, 0.2, 0.1)).norm(), 1e-9);
  EXPECT_LT(near->features[0].extent.norm(), 1e-12);  // a corner
  EXPECT_GT(near->features[1].extent.maxCoeff(), 0.5);  // a face
}

TEST(Contact, OfTwoFacesMayBeAnywhereOnBoth) {
  const Solid a = solid_of(box(Vec3(0.2, 0.1, 0.1)), ""), b = solid_of(box(Vec3(1, 1, 0.2)), "");
  const auto near = nearest(a, Vec3(0.0, 0.0, 0.15), Quat::Identity(), b, Vec3::Zero(), Quat::Identity(), 0.002);
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->features[0].extent.maxCoeff(), 0.1, 0.005);
  EXPECT_NEAR(near->features[1].extent.maxCoeff(), 0.5, 0.005);
  EXPECT_LT((near->point_a - Vec3(0, 0, 0.1)).norm(), 1e-9);
}

TEST(Contact, WithAPlaneIsTheLowestCorner) {
  const Solid a = solid_of(box(Vec3(0.1, 0.1, 0.1)), "");
  const Quat q = Quat::FromTwoVectors(Vec3(1, 1, 1), Vec3(0, 0, -1));
  const Proximity near = nearest_to_plane(a, Vec3(0, 0, 1), q, Vec3::UnitZ(), 0.002);
  EXPECT_LT((near.point_a - Vec3(0, 0, 1 - 0.05 * std::sqrt(3.0))).norm(), 1e-9);
}

/// The normal, the gap along it and the points on the features follow small motions as a new search finds them.
TEST(Contact, TheLawFollowsTheBodies) {
  Random random(5);
  const Solid boxes[] = {solid_of(box(Vec3(0.2, 0.1, 0.05)), ""), solid_of(box(Vec3(0.1, 0.15, 0.12)), "")};
  Body round;
  round.shape = Shape::sphere;
  round.radius = 0.06;
  const Solid ball = solid_of(round, "");
  const auto any = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
  int edges = 0;
  for (int i = 0; i < 60; ++i) {
    const Solid &a = i % 3 == 1 ? ball : boxes[0], &b = i % 3 == 2 ? ball : boxes[1];
    std::array<Vec3, 2> p = {0.25 * any().normalized(), Vec3::Zero()};
    std::array<Quat, 2> q = {rotation_by<double>(any()), rotation_by<double>(any())};
    const auto near = nearest(a, p[0], q[0], b, p[1], q[1], 1e-6);
    ASSERT_TRUE(near);
    EXPECT_LT((normal_by<double>(near->law, p, q, Vec3::UnitY()) - near->normal).norm(), 1e-9);
    for (int o = 0; o < 2; ++o) p[o] += 1e-5 * any(), q[o] = rotation_by<double>(Vec3(1e-5 * any())) * q[o];
    const auto moved = nearest(a, p[0], q[0], b, p[1], q[1], 1e-6);
    if (moved->law.kind != near->law.kind || moved->law.a != near->law.a || moved->law.b != near->law.b || moved->law.sign != near->law.sign) continue;
    edges += near->law.kind == ContactLaw::Kind::edges;
    EXPECT_LT((normal_by<double>(near->law, p, q, Vec3::UnitY()) - moved->normal).norm(), 1e-9) << i;
  }
  EXPECT_GT(edges, 3);
}

}  // namespace
}  // namespace unseen::collision
