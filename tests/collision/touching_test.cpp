// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "collision/evaluate/penetration.h"
#include "collision/solve/rotation.h"
#include "collision/solve/touching.h"
#include "collision/solve/touching_fit.h"
#include "collision/tracks/flight_search.h"
#include "collision/two_balls.h"
#include "unseen/collision/collision.h"
#include "unseen/collision/synth.h"
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

/// Whether a grid of points of one box lies in the other: independent of separating axes.
bool overlap(const Vec3& size_a, const Vec3& p, const Quat& q_a, const Vec3& size_b, const Quat& q_b) {
  constexpr int kSteps = 24;
  for (int i = 0; i <= kSteps; ++i)
    for (int j = 0; j <= kSteps; ++j)
      for (int k = 0; k <= kSteps; ++k) {
        const Vec3 in_a = (Vec3(i, j, k) / kSteps - Vec3::Constant(0.5)).cwiseProduct(size_a);
        const Vec3 in_b = q_b.conjugate() * (p + q_a * in_a);
        if ((in_b.cwiseAbs() - 0.5 * size_b).maxCoeff() < 0.0) return true;
      }
  return false;
}

TEST(Touching, IsWhereOverlapBegins) {
  Random random(3);
  const Vec3 size_a(0.2, 0.1, 0.06), size_b(0.12, 0.15, 0.1);
  const Solid a = solid_of(box(size_a), ""), b = solid_of(box(size_b), "");
  for (int i = 0; i < 12; ++i) {
    const auto any = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
    const Quat q_a = rotation_by<double>(any()), q_b = rotation_by<double>(any());
    const Vec3 u = any().normalized();
    const std::optional<Touching> t = Touchings(a, q_a, b, q_b).along(u);
    ASSERT_TRUE(t);
    EXPECT_LT(t->offset.normalized().cross(u).norm(), 1e-9);
    // the boxes in their own axes
    const Quat box_a = q_a * a.file_to_principal, box_b = q_b * b.file_to_principal;
    EXPECT_FALSE(overlap(size_a, 1.002 * t->offset, box_a, size_b, box_b)) << i;
    EXPECT_TRUE(overlap(size_a, 0.9 * t->offset, box_a, size_b, box_b)) << i;
  }
}

/// Written out: ½ χ² of both flights, of the momenta and of friction, above that of the flights alone. No other flights with these changes fit better.
TEST(TouchingFit, HasTheBestFlightsForTheImpact) {
  Random random(11);
  const auto any = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
  using Flight = Eigen::Matrix<double, LinearFlight::kUnknowns, 1>;
  const auto flight = [&] {
    LinearFlight f{any(), any(), any(), {}, {}};
    const Eigen::MatrixXd rows = Eigen::MatrixXd::NullaryExpr(25, LinearFlight::kUnknowns, [&] { return 20.0 * random.normal(); });
    f.normal = rows.transpose() * rows;
    Flight y;
    y << f.p, f.v_before, f.v_after, 0.0;
    f.right = f.normal * y;
    return f;
  };
  const auto above = [](const LinearFlight& f, const Vec3& p, const Vec3& v, const Vec3& v_after, double delay) {
    Flight off;
    off << p - f.p, v - f.v_before, v_after - f.v_after, delay;
    return 0.5 * off.dot(f.normal * off);
  };
  Problem problem;
  problem.gravity = 0.0;
  for (int i = 0; i < 10; ++i) {
    const LinearFlight a = flight(), b = flight();
    State base;
    base.impulse = any(), base.mass_ratio = random.uniform(0.5, 2.0), base.time = 0.2;
    const Touching touching{any(), 0.1 * any(), 0.1 * any(), any().normalized()};
    const Mat3 sure = 1e3 * Mat3::Identity();
    const Vec3 change_a = 0.1 * any(), change_b = 0.1 * any();
    const auto [cost, s] = TouchingFit(problem, base, a, b)(touching, {change_a, sure}, {change_b, sure});
    EXPECT_LT((s.v_after[0] - s.v[0] - s.impulse).norm() + ((s.v_after[1] - s.v[1]) * s.mass_ratio + s.impulse).norm(), 1e-9);
    EXPECT_LT((s.p[0] - s.p[1] - touching.offset).norm(), 1e-12);
    const auto flown = [&, s = s](const Vec3& p, const Vec3& v_a, const Vec3& v_b, double delay) {
      return above(a, s.p[0] + p, s.v[0] + v_a, s.v_after[0] + v_a, s.time - base.time + delay) +
             above(b, s.p[1] + p, s.v[1] + v_b, s.v_after[1] + v_b, s.time - base.time + delay);
    };
    const Vec3 none = Vec3::Zero(), turn_a = touching.arm_a.cross(s.impulse) - change_a, turn_b = -touching.arm_b.cross(s.impulse) / s.mass_ratio - change_b;
    const double along = touching.normal.dot(s.impulse), size = s.impulse.norm(), slid = std::sqrt(size * size - along * along) / (0.4 * size);
    const double pulled = std::min(0.0, along) / (0.05 * size), expected = flown(none, none, none, 0.0) + 500.0 * (turn_a.squaredNorm() + turn_b.squaredNorm());
    EXPECT_NEAR(cost, expected + 0.5 * (slid * slid + pulled * pulled), 1e-6 * cost) << i;
    const auto total = [&, s = s](double step, const Vec3& p, const Vec3& v_a, const Vec3& v_b, double delay) {
      const double late = (s.time - base.time + step * delay) / 0.1;
      return flown(step * p, step * v_a, step * v_b, step * delay) + 0.5 * late * late;
    };
    const double best = total(0.0, none, none, none, 0.0);
    for (int k = 0; k < 20; ++k) EXPECT_GT(total(1e-3, any(), any(), any(), random.normal()), best);
  }
}

/// A pebble: an octahedron whose faces are cut in four `rounds` times, blown up, stretched and dented a little.
Body pebble(const Vec3& size, int rounds, Random& random) {
  TriangleMesh mesh;
  for (int i = 0; i < 3; ++i)
    for (const double sign : {1.0, -1.0}) mesh.vertices.push_back(sign * Vec3::Unit(i));
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int round = 0; round < rounds; ++round) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> between;
    const auto middle = [&](std::uint32_t i, std::uint32_t j) {
      const auto [at, fresh] = between.try_emplace(std::minmax(i, j), static_cast<std::uint32_t>(mesh.vertices.size()));
      if (fresh) mesh.vertices.push_back((mesh.vertices[i] + mesh.vertices[j]).normalized());
      return at->second;
    };
    std::vector<std::array<std::uint32_t, 3>> finer;
    for (const auto& [i, j, k] : mesh.triangles) {
      const std::uint32_t a = middle(i, j), b = middle(j, k), c = middle(k, i);
      for (const auto& t : {std::array{i, a, c}, {a, j, b}, {c, b, k}, {a, b, c}}) finer.push_back(t);
    }
    mesh.triangles = finer;
  }
  for (Vec3& v : mesh.vertices) v = random.uniform(0.97, 1.0) * 0.5 * v.cwiseProduct(size);
  Body b;
  b.name = "pebble";
  b.shape = Shape::mesh;
  b.mesh = mesh;
  return b;
}

/// Against Bullet's distance of convex bodies (GJK), which knows nothing of faces.
TEST(Touching, OfRoundMeshesIsWhereBulletHasNoGap) {
  Random random(4);
  const Body a = pebble(Vec3(0.2, 0.12, 0.1), 2, random), b = pebble(Vec3(0.1, 0.15, 0.12), 1, random), c = box(Vec3(0.1, 0.05, 0.2));
  const std::array<std::pair<const Body*, const Body*>, 3> pairs = {{{&a, &b}, {&a, &c}, {&c, &b}}};
  for (int i = 0; i < 30; ++i) {
    const auto& [first, second] = pairs[static_cast<std::size_t>(i % 3)];
    const Solid one = solid_of(*first, ""), two = solid_of(*second, "");
    const auto any = [&] { return Vec3(random.normal(), random.normal(), random.normal()); };
    const Quat q_a = rotation_by<double>(any()), q_b = rotation_by<double>(any());
    const std::optional<Touching> t = Touchings(one, q_a, two, q_b).along(any().normalized());
    ASSERT_TRUE(t);
    const auto pose = [](const Solid& solid, const Quat& q, const Vec3& p) {
      return RigidTransform{(q * solid.file_to_principal).toRotationMatrix(), p};
    };
    EXPECT_LT(std::abs(penetration(*first, pose(one, q_a, t->offset), *second, pose(two, q_b, Vec3::Zero()))), 1e-3 * t->offset.norm()) << i;
  }
}

SynthShot tracks_of(const std::string& scene, int seed, double noise) {
  SynthOptions o;
  o.scene = scene;
  o.seed = seed;
  o.video = false;
  o.fps = 60;
  o.centroid_noise = noise;
  return simulate(o);
}

/// Labelled centres that are off by up to a fifth of the bodies' size (thesis Fig. 5.8a).
TEST(FlightSearch, FindsTheImpactInNoise) {
  for (int seed = 1; seed <= 4; ++seed) {
    const SynthShot synth = tracks_of("boxes", seed, 0.2);
    Context context;
    const Tracks tracks = find_tracks(synth.shot, synth.shot.camera, synth.shot.observations, synth.truth.fps, context);
    ASSERT_EQ(tracks.meetings.size(), 1u) << seed;
    EXPECT_NEAR(tracks.meetings[0].time, synth.truth.impacts[0].time, 1.5 / synth.truth.fps) << seed;
  }
}

TEST(FlightSearch, FlightsThatDoNotMeetHaveNoImpact) {
  const SynthShot synth = tracks_of("flight", 1, 0.05);
  Context context;
  EXPECT_TRUE(find_tracks(synth.shot, synth.shot.camera, synth.shot.observations, synth.truth.fps, context).meetings.empty());
}

TEST(Reconstruct, BoxesInNoise) {
  std::vector<double> off;
  for (int seed = 1; seed <= 3; ++seed) {
    const SynthShot synth = tracks_of("boxes", seed, 0.1);
    Options options;
    options.starts = 6;
    options.resamples = 0;
    Context context;
    const Reconstruction r = reconstruct(synth.shot, options, context);
    ASSERT_EQ(r.impacts.size(), 1u) << seed;
    off.push_back(std::abs(r.impacts[0].restitution.value - *synth.truth.restitution));
  }
  std::sort(off.begin(), off.end());
  EXPECT_LT(off[1], 0.05);
}

/// Bounces on one floor from a track in noise: the shared height keeps motion along the view ray out of the restitution.
TEST(Reconstruct, BouncesOnOneFloorAgree) {
  const SynthShot synth = tracks_of("ball-floor", 7, 0.03);
  Context context;
  const Reconstruction r = reconstruct(synth.shot, Options{}, context);
  ASSERT_TRUE(r.restitution);
  ASSERT_GE(r.impacts.size(), 2u);
  EXPECT_NEAR(r.restitution->value, *synth.truth.restitution, 0.03);
}

/// A box that lands on one end of an edge 3° off level, pushed through its centre: from the edge's middle the impulse would turn it.
TEST(Reconstruct, ABoxOnOneEndOfAnEdgeIsNotTurned) {
  const double c = 0.5, fps = 120, impact = 45.4 / fps, tilt = radians(3.0);
  Shot shot;
  shot.name = "edge";
  shot.fps = fps;
  shot.camera.camera = {831, 831, 479.5, 269.5, 960, 540};
  Body floor;
  floor.name = "floor";
  floor.shape = Shape::fixed;
  shot.bodies = {box({0.2, 0.14, 0.08}), floor};
  const Solid solid = solid_of(shot.bodies[0], "edge");
  const Vec3 down = Vec3::UnitY(), side = Vec3(1, 0, 0.5).normalized(), corner(0.1, 0.07, 0.04);
  // The edge along the box's z nearly level, its end `corner` lowest.
  const Vec3 along = std::cos(tilt) * side + std::sin(tilt) * down, across = (corner - 0.04 * Vec3::UnitZ()).normalized();
  Mat3 from, to;
  from << Vec3::UnitZ(), across, Vec3::UnitZ().cross(across);
  const Vec3 below = (down - along * along.dot(down)).normalized();
  to << along, below, along.cross(below);
  const Quat q(Mat3(to * from.transpose()));
  const Vec3 arm = q * corner, p(0, 0.1, 2.3), omega(1.0, -2.0, 1.5), before = 3.8 * down + 1.2 * (arm - down * down.dot(arm)).normalized();
  const double onto = (before + omega.cross(arm)).dot(down);
  const Vec3 after = before - (1 + c) * onto / arm.dot(down) * arm;
  const Quat principal = q * solid.file_to_principal.conjugate();
  const Vec3 h = principal * solid.mass.inertia.cwiseProduct(principal.conjugate() * omega);
  Random random(3);
  for (int frame = 5; frame < 80; ++frame) {
    const double t = frame / fps - impact;
    Sighting s;
    s.body = 0;
    s.frame = frame;
    s.pixel = shot.camera.camera.project(p + t * (t < 0 ? before : after) + 0.5 * 9.81 * t * t * down) + 0.15 * Vec2(random.normal(), random.normal());
    shot.observations.push_back(s);
    if (frame % 4 == 0) shot.orientations.push_back({0, frame / fps, turned(principal, h, solid.mass.inertia, t) * solid.file_to_principal});
  }
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  EXPECT_TRUE(r.fits);
  ASSERT_TRUE(r.restitution);
  EXPECT_NEAR(r.restitution->value, c, 0.04);
}

TEST(Reconstruct, AGivenMassRatioStaysAsGiven) {
  Shot shot = test::two_balls({.late = 0.4, .after = 28, .from = 4, .fps = 84, .noise = 1.0});
  shot.bodies[0].mass = 0.2, shot.bodies[1].mass = 0.2 * test::kMassRatio;
  Options options;
  options.fix_mass_ratio = true;
  Context context;
  const Reconstruction r = reconstruct(shot, options, context);
  ASSERT_TRUE(r.mass_ratio && r.restitution);
  EXPECT_NEAR(r.mass_ratio->value, test::kMassRatio, 1e-9);
  EXPECT_TRUE(r.restitution->low <= test::kRestitution && test::kRestitution <= r.restitution->high);
}

}  // namespace
}  // namespace unseen::collision
