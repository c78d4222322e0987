// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/synth.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "collision/solve/mass_properties.h"
#include "collision/synth/synth_body.h"
#include "collision/synth/synth_motion.h"
#include "unseen/core/error.h"

namespace unseen::collision {
namespace {

constexpr double kGravity = 9.81;

SynthShot shot_of(const std::string& scene, int seed, double fps = 240) {
  SynthOptions options;
  options.scene = scene;
  options.seed = seed;
  options.fps = fps;
  options.video = false;
  return simulate(options);
}

bool has_floor(const Truth& truth) { return truth.bodies[1].shape == Shape::fixed; }

double mass(const Truth& truth, std::size_t body) { return body == 0 ? 1.0 : *truth.mass_ratio; }

/// Inertia in the world, by the solver's own integrals, which the simulator does not use.
Mat3 inertia(const Truth& truth, std::size_t body, const Quat& q) {
  const MassProperties m = mass_properties(truth.bodies[body], "test");
  const Mat3 R = q.toRotationMatrix() * m.axes;
  return mass(truth, body) * R * m.inertia.asDiagonal() * R.transpose();
}

double energy(const Truth& truth, const FramePose& f, double gravity) {
  double sum = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    if (!f.bodies[i]) continue;
    const BodyState& s = *f.bodies[i];
    sum += mass(truth, i) * (0.5 * s.v.squaredNorm() + gravity * s.p.z()) + 0.5 * s.k.dot(inertia(truth, i, s.q).inverse() * s.k);
  }
  return sum;
}

/// Total momentum, and angular momentum about the common centre of mass.
std::pair<Vec3, Vec3> momenta(const Truth& truth, const FramePose& f) {
  const double m = mass(truth, 1);
  const BodyState &a = *f.bodies[0], &b = *f.bodies[1];
  const Vec3 center = (a.p + m * b.p) / (1 + m), drift = (a.v + m * b.v) / (1 + m);
  return {a.v + m * b.v, a.k + b.k + (a.p - center).cross(a.v - drift) + m * (b.p - center).cross(b.v - drift)};
}

TEST(Synth, MomentaOfTwoBodiesAreConserved) {
  for (const char* scene : {"boxes", "box-ball", "balls", "offcentre", "spin", "mesh", "planar", "flight"})
    for (int seed = 1; seed <= 2; ++seed) {
      const Truth truth = shot_of(scene, seed).truth;
      const double g = std::string(scene) == "planar" ? 0 : kGravity;
      const auto [p, l] = momenta(truth, truth.frames.front());
      for (const FramePose& f : truth.frames) {
        const auto [p_now, l_now] = momenta(truth, f);
        EXPECT_LT((p_now - p + Vec3(0, 0, g * f.time * (1 + mass(truth, 1)))).norm(), 1e-10) << scene << seed << " frame " << f.frame;
        EXPECT_LT((l_now - l).norm(), 1e-8) << scene << seed << " frame " << f.frame;
      }
    }
}

TEST(Synth, EnergyNeverGrowsAndFallsAtImpactsOnly) {
  for (const std::string& scene : synth_scenes()) {
    if (scene == "drag" || scene == "rain") continue;  // lose energy between impacts, too
    const Truth truth = shot_of(scene, 3).truth;
    for (std::size_t i = 1; i < truth.frames.size(); ++i) {
      const double g = scene == "planar" ? 0 : kGravity;
      const double change = energy(truth, truth.frames[i], g) - energy(truth, truth.frames[i - 1], g);
      const bool hit = std::any_of(truth.impacts.begin(), truth.impacts.end(), [&](const Impact& impact) {
        return impact.time > truth.frames[i - 1].time && impact.time <= truth.frames[i].time;
      });
      if (hit) {
        EXPECT_LT(change, -1e-6) << scene << " frame " << i;
      } else {
        EXPECT_NEAR(change, 0, 1e-8) << scene << " frame " << i;
      }
    }
  }
}

/// Velocity of a body's point at an impact, from poses alone: central differences between two frames, carried to the impact.
Vec3 point_velocity(const Truth& truth, std::size_t body, std::size_t first, const Impact& impact, double gravity) {
  const FramePose &f = truth.frames[first], &g = truth.frames[first + 1];
  const BodyState &s = *f.bodies[body], &t = *g.bodies[body];
  const double dt = g.time - f.time, to_impact = impact.time - 0.5 * (f.time + g.time);
  const Vec3 v = (t.p - s.p) / dt - Vec3(0, 0, gravity * to_impact);
  const Eigen::AngleAxisd turn(t.q * s.q.conjugate());
  const double angle = turn.angle() > kPi ? turn.angle() - 2 * kPi : turn.angle();
  const double nearer = impact.time < f.time ? f.time : g.time;
  const Vec3 p = (impact.time < f.time ? s.p : t.p) + v * (impact.time - nearer);
  return v + (angle / dt * turn.axis()).cross(impact.contact_point - p);
}

TEST(Synth, RestitutionIsWhatThePosesSay) {
  for (const std::string& scene : synth_scenes()) {
    if (scene == "drag" || scene == "flight") continue;
    const Truth truth = shot_of(scene, 2, 2000).truth;
    ASSERT_FALSE(truth.impacts.empty());
    const Impact& impact = truth.impacts.front();
    const auto after = static_cast<std::size_t>(std::ceil(impact.frame));
    double before_speed = 0, after_speed = 0;
    for (std::size_t body = 0; body < (has_floor(truth) ? 1u : 2u); ++body) {
      const double sign = body == 0 ? 1 : -1, g = scene == "planar" ? 0 : kGravity;
      before_speed += sign * impact.normal.dot(point_velocity(truth, body, after - 2, impact, g));
      after_speed += sign * impact.normal.dot(point_velocity(truth, body, after, impact, g));
    }
    EXPECT_LT(before_speed, -0.5) << scene;
    EXPECT_NEAR(-after_speed / before_speed, impact.restitution.value, 0.01) << scene;
    EXPECT_EQ(impact.restitution.value, truth.restitution);
  }
}

TEST(Synth, GivenValuesAreTheTruth) {
  SynthOptions options;
  options.restitution = 0.37;
  options.mass_ratio = 1.6;
  options.spin = 5;
  options.frames = 120;
  options.video = false;
  const Truth truth = simulate(options).truth;
  EXPECT_EQ(truth.restitution, 0.37);
  EXPECT_EQ(truth.mass_ratio, 1.6);
  EXPECT_EQ(truth.frames.size(), 120u);
  const FramePose& last = truth.frames[static_cast<std::size_t>(truth.impacts[0].frame)];
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR((inertia(truth, i, last.bodies[i]->q).inverse() * last.bodies[i]->k).norm(), 5, 0.5);
}

/// Corners of a body in the world.
std::vector<Vec3> corners(const Body& body, const BodyState& s) {
  std::vector<Vec3> all;
  const Vec3 center = mass_properties(body, "test").center;
  for (const Vec3& v : body.mesh.vertices) all.push_back(s.p + s.q * (v - center));
  for (int i = 0; body.shape == Shape::box && i < 8; ++i)
    all.push_back(s.p + s.q * (0.5 * body.box.cwiseProduct(Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1))));
  return all;
}

/// Least distance of the convex hulls' Minkowski difference from the origin (Frank and Wolfe's method with exact line search on the
/// nearest point): positive if apart; not below 0.
double hull_distance(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  Vec3 nearest = a[0] - b[0];
  for (int i = 0; i < 20000; ++i) {
    const auto least = [&](const std::vector<Vec3>& all, double sign) {
      return *std::min_element(all.begin(), all.end(), [&](const Vec3& x, const Vec3& y) { return sign * nearest.dot(x) < sign * nearest.dot(y); });
    };
    const Vec3 corner = least(a, 1) - least(b, -1), step = corner - nearest;
    if (-nearest.dot(step) < 1e-9) break;
    nearest += std::clamp(-nearest.dot(step) / step.squaredNorm(), 0.0, 1.0) * step;
  }
  return nearest.norm();
}

TEST(Synth, BodiesTouchAtTheImpactAndOnlyThere) {
  for (const char* scene : {"boxes", "offcentre", "mesh", "balls"})
    for (int seed = 1; seed <= 3; ++seed) {
      const Truth truth = shot_of(scene, seed).truth;
      const Impact& impact = truth.impacts.front();
      for (const FramePose& f : truth.frames) {
        const double off = std::abs(f.frame - impact.frame);
        if (off < 2 || (f.frame % 4 != 0 && off > 8)) continue;
        const BodyState &a = *f.bodies[0], &b = *f.bodies[1];
        if (std::string(scene) == "balls")
          EXPECT_GT((a.p - b.p).norm(), truth.bodies[0].radius + truth.bodies[1].radius);
        else
          EXPECT_GT(hull_distance(corners(truth.bodies[0], a), corners(truth.bodies[1], b)), 2e-4) << scene << seed << " frame " << f.frame;
      }
    }
}

TEST(Synth, TheContactPointIsOnBothSurfaces) {
  const Truth truth = shot_of("boxes", 4, 2000).truth;
  const Impact& impact = truth.impacts.front();
  const FramePose& f = truth.frames[static_cast<std::size_t>(impact.frame)];
  for (std::size_t i = 0; i < 2; ++i) {
    const BodyState& s = *f.bodies[i];
    const Vec3 p = s.p + s.v * (impact.time - f.time), local = s.q.conjugate() * (impact.contact_point - p);
    EXPECT_NEAR((local.cwiseAbs() - 0.5 * truth.bodies[i].box).maxCoeff(), 0, 1e-3);
  }
}

TEST(Synth, ASymmetricTopPrecessesAsInClosedForm) {
  Body body;
  body.shape = Shape::box;
  body.box = {0.1, 0.1, 0.25};
  const SynthMover top{synth_body(body), 1.0, 0.0};
  SynthState s;
  s.w = {6, 0, 11};
  const double I1 = top.body.inertia(0, 0), I3 = top.body.inertia(2, 2), t = 0.73;
  const SynthState moved = fly(top, s, Vec3::Zero(), t);
  const double rate = (I3 - I1) / I1 * s.w.z();  // Goldstein, Classical Mechanics, section 5.6
  EXPECT_LT((moved.w - Vec3(6 * std::cos(rate * t), 6 * std::sin(rate * t), 11)).norm(), 1e-9);
  // the axis goes round the angular momentum at |L| / I1; the body turns about its axis at −rate beside
  const Vec3 L = top.body.inertia * s.w;
  const Quat expected = Quat(Eigen::AngleAxisd(L.norm() / I1 * t, L.normalized())) * Quat(Eigen::AngleAxisd(-rate * t, Vec3::UnitZ()));
  EXPECT_LT(moved.q.angularDistance(expected), 1e-9);
}

TEST(Synth, DragBalancesGravityAtTheTerminalSpeed) {
  Body ball;
  ball.radius = 0.1;
  const SynthMover mover{synth_body(ball), 1.0, 0.2};
  SynthState s;
  const double terminal = std::sqrt(kGravity / 0.2), t = 0.6;
  const SynthState fallen = fly(mover, s, {0, 0, -kGravity}, t);
  EXPECT_NEAR(fallen.v.z(), -terminal * std::tanh(kGravity * t / terminal), 1e-10);
  EXPECT_NEAR(fallen.p.z(), -terminal * terminal / kGravity * std::log(std::cosh(kGravity * t / terminal)), 1e-10);
}

TEST(Synth, FrictionStaysInItsCone) {
  int slid = 0, stuck = 0;
  for (int seed = 1; seed <= 12; ++seed) {
    SynthOptions options;
    options.scene = seed % 2 == 0 ? "boxes" : "box-floor";
    options.friction = 0.15;
    options.seed = seed;
    options.video = false;
    const Truth truth = simulate(options).truth;
    const Impact& impact = truth.impacts.front();
    const double normal = impact.impulse.dot(impact.normal), across = (impact.impulse - normal * impact.normal).norm();
    EXPECT_GT(normal, 0);
    EXPECT_NEAR(*impact.friction, across / normal, 1e-12);
    EXPECT_LE(across, 0.15 * normal * (1 + 1e-12));
    const bool sticks = across < 0.15 * normal * (1 - 1e-9);
    if (sticks) {
      EXPECT_NEAR(impact.tangential_restitution.value_or(0), 0, 1e-9);
    }
    (sticks ? stuck : slid) += 1;
  }
  EXPECT_GT(slid, 0);
  EXPECT_GT(stuck, 0);
}

TEST(Synth, ScenesAreWhatTheirNamesSay) {
  for (int seed = 1; seed <= 3; ++seed) {
    EXPECT_TRUE(shot_of("flight", seed).truth.impacts.empty());
    EXPECT_GE(shot_of("rain", seed).truth.impacts.size(), 2u);
    EXPECT_GE(shot_of("ball-floor", seed).truth.impacts.size(), 3u);
    EXPECT_EQ(shot_of("box-floor", seed).truth.impacts.size(), 1u);
    const Truth hit = shot_of("offcentre", seed).truth;
    double fastest = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      const BodyState& s = *hit.frames.back().bodies[i];
      fastest = std::max(fastest, (inertia(hit, i, s.q).inverse() * s.k).norm());
    }
    EXPECT_GT(fastest, 7);
    EXPECT_LT(fastest, 32);
  }
}

TEST(Synth, EachBodyIsSeenWholeBesideTheCurtain) {
  for (const char* scene : {"boxes", "balls"})
    for (int seed = 1; seed <= 3; ++seed) {
      SynthOptions options;
      options.scene = scene;
      options.seed = seed;
      options.curtain = true;
      const Truth truth = simulate(options).truth;
      const RigidTransform T = truth.T_world_camera.inverse();
      const Vec3 contact = T * truth.impacts[0].contact_point;
      double reach[2] = {};
      for (std::size_t i = 0; i < 2; ++i) reach[i] = synth_body(truth.bodies[i]).reach;
      const double half = 1.2 * truth.camera.fx * std::max(reach[0], reach[1]) / contact.z();
      int beside[2][2] = {};
      for (const FramePose& f : truth.frames)
        for (std::size_t i = 0; i < 2; ++i) {
          const Vec3 p = T * f.bodies[i]->p;
          const double away = std::abs(truth.camera.project(p).x() - truth.camera.project(contact).x());
          beside[i][f.time > truth.impacts[0].time] += away > half + truth.camera.fx * reach[i] / p.z();
        }
      for (const auto& body : beside)
        for (const int frames : body) EXPECT_GE(frames, 19) << scene << " " << seed;  // 0.08 s
    }
}

TEST(Synth, TracksAreProjectionsWithinTheirNoise) {
  SynthOptions options;
  options.video = false;
  options.gap = 11;
  options.orientations = 3;
  const SynthShot exact = simulate(options);
  const Truth& truth = exact.truth;
  const RigidTransform T = truth.T_world_camera.inverse();
  for (const Sighting& s : exact.shot.observations) {
    EXPECT_GT(std::abs(s.frame - truth.impacts[0].frame), 5.5);
    const auto& body = truth.frames[static_cast<std::size_t>(s.frame)].bodies[static_cast<std::size_t>(s.body)];
    EXPECT_LT((s.pixel - truth.camera.project(T * body->p)).norm(), 1e-9);
  }
  EXPECT_EQ(exact.shot.orientations.size(), 12u);
  for (const OrientationHint& o : exact.shot.orientations) {
    const auto frame = static_cast<std::size_t>(std::lround(o.time * truth.fps));
    const Quat q = Quat(truth.T_world_camera.rotation) * o.q;
    EXPECT_LT(q.angularDistance(truth.frames[frame].bodies[static_cast<std::size_t>(o.body)]->q), 1e-7);
  }
  options.centroid_noise = 0.1;
  options.orientation_noise = 5;
  const SynthShot noisy = simulate(options);
  double largest = 0, turned = 0;
  for (std::size_t i = 0; i < noisy.shot.observations.size(); ++i) {
    const double size = 2 * std::max(noisy.shot.observations[i].radius, noisy.shot.observations[i ^ 1].radius);
    largest = std::max(largest, (noisy.shot.observations[i].pixel - exact.shot.observations[i].pixel).cwiseAbs().maxCoeff() / size);
  }
  EXPECT_LE(largest, 0.1 + 1e-12);
  EXPECT_GT(largest, 0.08);
  for (std::size_t i = 0; i < 12; ++i) turned += std::pow(noisy.shot.orientations[i].q.angularDistance(exact.shot.orientations[i].q), 2) / 12;
  EXPECT_NEAR(degrees(std::sqrt(turned)), 5, 3);
}

TEST(Synth, SameSeedSameShotOtherSeedAnother) {
  const SynthShot one = shot_of("mesh", 5), same = shot_of("mesh", 5), other = shot_of("mesh", 6);
  ASSERT_EQ(one.truth.frames.size(), same.truth.frames.size());
  EXPECT_EQ(one.truth.frames.back().bodies[1]->p, same.truth.frames.back().bodies[1]->p);
  EXPECT_EQ(one.shot.orientations.back().q.coeffs(), same.shot.orientations.back().q.coeffs());
  EXPECT_NE(one.truth.restitution, other.truth.restitution);
}

TEST(Synth, BadOptionsAreRefused) {
  const auto refused = [](const auto& change) {
    SynthOptions options;
    change(options);
    EXPECT_THROW(simulate(options), InputError);
  };
  refused([](SynthOptions& o) { o.scene = "cars"; });
  refused([](SynthOptions& o) { o.restitution = 1.2; });
  refused([](SynthOptions& o) { o.fps = 0; });
  refused([](SynthOptions& o) { o.scene = "ball-floor", o.mass_ratio = 1; });
  refused([](SynthOptions& o) { o.scene = "flight", o.restitution = 0.5; });
}

}  // namespace
}  // namespace unseen::collision
