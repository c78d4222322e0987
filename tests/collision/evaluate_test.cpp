// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/evaluate.h"

#include <gtest/gtest.h>

#include "collision/evaluate/penetration.h"
#include "collision/orientations/symmetry.h"
#include "collision/sample.h"
#include "unseen/collision/body_mesh.h"
#include "unseen/core/error.h"

namespace unseen::collision {
namespace {

Truth truth_of(const Sample& s) {
  Truth t;
  t.T_world_camera = s.result.T_world_camera;
  t.camera = s.result.camera;
  t.fps = s.result.fps;
  t.bodies = s.shot.bodies;
  t.impacts = s.result.impacts;
  if (s.result.restitution) t.restitution = s.result.restitution->value;
  if (s.result.mass_ratio) t.mass_ratio = s.result.mass_ratio->value;
  t.frames = s.result.frames;
  return t;
}

Body box(double x, double y, double z) {
  Body b;
  b.name = "box";
  b.shape = Shape::box;
  b.box = {x, y, z};
  return b;
}

Body ball(double radius) {
  Body b;
  b.name = "ball";
  b.radius = radius;
  return b;
}

std::size_t turns(const std::vector<Vec3>& points) {
  return symmetry_of(points).turns.size();
}

/// Corners of a regular prism about the z axis.
std::vector<Vec3> prism(int n, double height) {
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
    for (const double z : {-0.5 * height, 0.5 * height}) points.emplace_back(std::cos(2 * kPi * i / n), std::sin(2 * kPi * i / n), z);
  return points;
}

TEST(Symmetry, HasTheOrderOfTheRotationGroup) {
  EXPECT_EQ(turns(body_mesh(box(0.1, 0.2, 0.3), "").vertices), 4u);
  EXPECT_EQ(turns(body_mesh(box(0.1, 0.1, 0.3), "").vertices), 8u);
  EXPECT_EQ(turns(body_mesh(box(0.2, 0.2, 0.2), "").vertices), 24u);
  EXPECT_EQ(turns({{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}), 12u);  // tetrahedron
  EXPECT_EQ(turns(prism(3, 1.1)), 6u);
  EXPECT_EQ(turns(prism(6, 1.1)), 12u);
  EXPECT_EQ(turns({{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {-1, -1, -1}}), 1u);
}

TEST(Symmetry, DoesNotDependOnTheAxes) {
  const Mat3 R = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  std::vector<Vec3> points = body_mesh(box(0.1, 0.1, 0.3), "").vertices;
  for (Vec3& p : points) p = R * p;
  EXPECT_EQ(turns(points), 8u);
}

TEST(Penetration, OfBoxesIsTheLeastWayApart) {
  const Body a = box(0.2, 0.2, 0.2), b = box(0.4, 0.1, 0.1);
  const auto at = [](double x, double y) { return RigidTransform{Mat3::Identity(), Vec3(x, y, 0)}; };
  EXPECT_NEAR(penetration(a, at(0, 0), b, at(0.29, 0)), 0.01, 1e-6);
  EXPECT_NEAR(penetration(a, at(0, 0), b, at(0.31, 0)), -0.01, 1e-6);
  EXPECT_NEAR(penetration(a, at(0, 0), b, at(0, 0.12)), 0.03, 1e-6);
}

TEST(Penetration, OfBallsAndBoxes) {
  const RigidTransform here;
  const auto at = [](const Vec3& p) { return RigidTransform{Mat3::Identity(), p}; };
  EXPECT_NEAR(penetration(ball(0.1), here, ball(0.2), at({0, 0.25, 0})), 0.05, 1e-9);
  EXPECT_NEAR(penetration(ball(0.1), here, ball(0.2), at({0, 0.35, 0})), -0.05, 1e-9);
  EXPECT_NEAR(penetration(box(0.2, 0.2, 0.2), here, ball(0.1), at({0, 0, 0.19})), 0.01, 1e-6);
  const double corner = std::sqrt(3.0) * 0.1 + 0.1;  // from corner to centre of a ball on the diagonal
  EXPECT_NEAR(penetration(box(0.2, 0.2, 0.2), here, ball(0.1), at(Vec3::Ones().normalized() * (corner - 0.02))), 0.02, 1e-6);
  EXPECT_NEAR(penetration(box(0.2, 0.2, 0.2), here, ball(0.1), at({0, 0, 0.05})), 0.15, 1e-6);  // the centre inside
  const Mat3 edge = Eigen::AngleAxisd(kPi / 4, Vec3::UnitX()).toRotationMatrix();
  EXPECT_NEAR(penetration(box(0.2, 0.2, 0.2), {edge, Vec3(0, 0, 0.1)}, Plane{Vec3::UnitZ(), 0.0}), 0.1 * std::sqrt(2.0) - 0.1, 1e-12);
  EXPECT_NEAR(penetration(ball(0.1), at({0, 0, 0.3}), Plane{Vec3::UnitZ(), 0.05}), -0.15, 1e-12);
}

TEST(Evaluate, TheTruthIsPerfect) {
  for (const Sample& s : {sample_two_bodies(), sample_bounces()}) {
    const Evaluation e = evaluate(s.result, truth_of(s));
    EXPECT_EQ(e.restitution->error, 0);
    EXPECT_TRUE(e.restitution->covered);
    EXPECT_EQ(e.found, e.true_impacts);
    EXPECT_EQ(*e.time, 0);
    EXPECT_NEAR(*e.penetration, 0, 1e-9);
    EXPECT_EQ(e.gravity, 0);
    for (const MotionScore& m : e.motions) {
      EXPECT_EQ(m.trajectory, 0);
      EXPECT_LT(m.rotation.value_or(0), 1e-7);
    }
  }
}

TEST(Evaluate, MeasuresWhatIsWrong) {
  Sample s = sample_two_bodies();
  const Truth truth = truth_of(s);
  Reconstruction& r = s.result;
  r.restitution->value = 0.65;
  r.restitution->high = 0.66;
  r.mass_ratio->value = 1.0;
  r.mass_ratio->low = 0.9;
  r.mass_ratio->high = 1.1;
  r.impacts[0].time += 0.5 / 120;
  const Mat3& R = r.T_world_camera.rotation;
  for (FramePose& f : r.frames) {
    f.bodies[0]->p += 0.02 * R.col(2);  // along the view
    f.bodies[0]->q = f.bodies[0]->q * Quat(Eigen::AngleAxisd(radians(4), Vec3::UnitY()));
    if (f.bodies[1]) f.bodies[1]->p += 0.01 * R.col(0);
  }
  r.bodies[0].before.p.x() += 0.01;  // box and ball touched
  const Evaluation e = evaluate(r, truth);
  EXPECT_NEAR(e.restitution->error, 0.05, 1e-12);
  EXPECT_TRUE(e.restitution->covered);
  EXPECT_NEAR(e.mass_ratio->error, 0.2, 1e-12);
  EXPECT_FALSE(e.mass_ratio->covered);
  EXPECT_NEAR(*e.time, 0.5, 1e-9);
  ASSERT_EQ(e.motions.size(), 2u);
  EXPECT_NEAR(e.motions[0].trajectory, 0.02 / 0.2, 1e-9);
  EXPECT_NEAR(e.motions[0].depth, 0.02 / 0.2, 1e-9);
  EXPECT_NEAR(e.motions[0].across, 0, 1e-9);
  EXPECT_NEAR(degrees(*e.motions[0].rotation), 4, 1e-6);
  EXPECT_EQ(e.motions[1].frames, 58);
  EXPECT_NEAR(e.motions[1].across, 0.01 / 0.1, 1e-9);
  EXPECT_FALSE(e.motions[1].rotation.has_value());
  EXPECT_NEAR(*e.penetration, 0.01, 1e-6);
}

TEST(Evaluate, ATurnOfTheBoxOntoItselfIsNoError) {
  Sample s = sample_two_bodies();
  Truth truth = truth_of(s);
  const Quat half(Eigen::AngleAxisd(kPi, Vec3::UnitX())), quarter(Eigen::AngleAxisd(kPi / 2, Vec3::UnitX()));
  for (FramePose& f : s.result.frames) f.bodies[0]->q = f.bodies[0]->q * half;
  EXPECT_LT(*evaluate(s.result, truth).motions[0].rotation, 1e-6);
  for (FramePose& f : s.result.frames) f.bodies[0]->q = f.bodies[0]->q * quarter;
  EXPECT_NEAR(*evaluate(s.result, truth).motions[0].rotation, kPi / 2, 1e-6);
  truth.bodies[0].box = {0.2, 0.1, 0.1};  // a square section bears it
  EXPECT_LT(*evaluate(s.result, truth).motions[0].rotation, 1e-6);
}

TEST(Evaluate, AnotherWorldIsNoError) {
  Sample s = sample_two_bodies();
  const Truth truth = truth_of(s);
  const Mat3 turn = Eigen::AngleAxisd(0.02, Vec3::UnitX()).toRotationMatrix();
  Reconstruction& r = s.result;
  r.T_world_camera.rotation = turn * r.T_world_camera.rotation;
  for (FramePose& f : r.frames)
    for (auto& body : f.bodies)
      if (body) body->p = turn * body->p, body->q = Quat(turn) * body->q;
  const Evaluation e = evaluate(r, truth);
  EXPECT_LT(e.motions[0].trajectory, 1e-9);
  EXPECT_LT(*e.motions[0].rotation, 1e-6);
  EXPECT_NEAR(e.gravity, 0.02, 1e-9);
}

TEST(Evaluate, ImpactsAreMatchedByTime) {
  Sample s = sample_bounces();
  const Truth truth = truth_of(s);
  s.result.impacts.erase(s.result.impacts.begin());
  s.result.impacts[0].time += 2.0 / 120;
  const Evaluation e = evaluate(s.result, truth);
  EXPECT_EQ(e.impacts, 1);
  EXPECT_EQ(e.found, 1);
  EXPECT_NEAR(*e.time, 2, 1e-9);
}

TEST(Evaluate, WithoutAnyResultThereIsNoScore) {
  Sample s = sample_two_bodies();
  Reconstruction none;
  none.summary.status = Status::infeasible;
  const Evaluation e = evaluate(none, truth_of(s));
  EXPECT_FALSE(e.restitution.has_value());
  EXPECT_FALSE(e.time.has_value());
  EXPECT_EQ(e.found, 0);
  EXPECT_EQ(e.motions[0].frames, 0);
}

TEST(Evaluate, RefusesAnotherShotsTruth) {
  Sample s = sample_two_bodies();
  Truth truth = truth_of(s);
  std::swap(truth.bodies[0], truth.bodies[1]);
  EXPECT_THROW(evaluate(s.result, truth), InputError);
}

}  // namespace
}  // namespace unseen::collision
