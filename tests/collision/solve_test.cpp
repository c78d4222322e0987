// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <algorithm>

#include "collision/doubts/model_check.h"
#include "collision/doubts/restitution.h"
#include "collision/doubts/uncertainty.h"
#include "collision/solve/best_fit.h"
#include "collision/solve/estimates.h"
#include "collision/solve/rotation.h"
#include "collision/solve/spin_starts.h"
#include "collision/solve/unknowns.h"
#include "unseen/collision/synth.h"
#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

/// The solver's problem from a simulated shot's tracks; the truth tells only which side of the impact a sighting is on.
Problem problem_of(const SynthShot& synth) {
  Problem p;
  p.camera = synth.truth.camera;
  p.gravity = synth.shot.gravity;
  p.down_sigma = 0.2;
  p.pixel_sigma = 0.3;
  for (int b = 0; b < 2; ++b) p.solids[b] = solid_of(synth.shot.bodies[b], "test");
  const double impact = synth.truth.impacts[0].time;
  for (const Sighting& s : synth.shot.observations) {
    const double time = s.frame / synth.truth.fps;
    p.points.push_back({s.body, time > impact, s.frame, time, s.pixel, 0.0, 0.0});
  }
  for (const OrientationHint& h : synth.shot.orientations)
    p.orientations.push_back({h.body, h.time > impact, h.time, (h.q * p.solids[h.body].file_to_principal.conjugate()).normalized()});
  return p;
}

SynthShot shot_of(const std::string& scene, int seed, double friction = 0.0) {
  SynthOptions o;
  o.scene = scene;
  o.seed = seed;
  o.video = false;
  o.fps = 60;
  o.friction = friction;
  return simulate(o);
}

double restitution_of(const Solution& s) { return restitution<double>(s.problem, s.fit.state, values_of(s.problem, s.fit.state)); }

Solution solved(const SynthShot& synth, const Problem& problem) {
  Context context;
  Solution solution = best_fit(problem, synth.truth.impacts[0].time + 0.5 / synth.truth.fps, 6, context);
  add_covariance(problem, solution.fit);
  return solution;
}

TEST(Solve, RecoversRestitutionAndMassRatioOfExactTracks) {
  for (int seed = 1; seed <= 6; ++seed) {
    const SynthShot synth = shot_of("boxes", seed);
    const Solution s = solved(synth, problem_of(synth));
    ASSERT_TRUE(s.fit.usable);
    EXPECT_NEAR(restitution_of(s), *synth.truth.restitution, 0.005) << "seed " << seed;
    EXPECT_NEAR(s.fit.state.mass_ratio / *synth.truth.mass_ratio, 1.0, 0.005) << "seed " << seed;
  }
}

/// Orientations of the wrong body leave no way for the two to touch.
TEST(Check, RefusesOrientationsThatDoNotBelong) {
  const SynthShot synth = shot_of("boxes", 1);
  Problem problem = problem_of(synth);
  const Solution right = solved(synth, problem);
  EXPECT_TRUE(check_model(right, 5, 0.3).fits);
  Random random(2);
  for (OrientationObservation& o : problem.orientations) o.q = rotation_by<double>(Vec3(random.normal(), random.normal(), random.normal())) * o.q;
  problem.scattered = false;  // said to be right within 5°
  const Solution wrong = solved(synth, problem);
  ASSERT_TRUE(wrong.fit.usable);
  EXPECT_FALSE(check_model(wrong, 5, 0.3).fits);
}

TEST(Solve, IsNotBiasedByFriction) {
  const SynthShot synth = shot_of("boxes", 2, 0.4);
  const Solution s = solved(synth, problem_of(synth));
  EXPECT_NEAR(restitution_of(s), *synth.truth.restitution, 0.05);
}

/// A point mass that meets a surface at 45°: c = 0.6 and μ = 0.3 read as 0.34 if the impulse is taken for the normal (Fig. 5.10).
TEST(Solve, WithoutFrictionReadsThePointMassOfTheClosedForm) {
  Problem problem;
  problem.fixed = true;
  problem.solids[0].mass.inertia = Vec3::Constant(1e-3);
  const double c = 0.6, mu = 0.3, speed = 1.0;
  State state;
  state.v[0] = Vec3(speed, 0, speed);  // z is into the surface
  const double normal = -(1.0 + c) * speed;
  state.impulse = Vec3(mu * normal, 0, normal);
  const Vec3 n = state.impulse.normalized();
  const double expected = -(state.v[0] + state.impulse).dot(n) / state.v[0].dot(n);
  EXPECT_NEAR(expected, 0.34, 0.005);
  EXPECT_NEAR(restitution<double>(problem, state, values_of(problem, state)), expected, 1e-9);
  state.law.emplace();
  state.law->a = -Vec3::UnitZ();
  EXPECT_NEAR(restitution<double>(problem, state, values_of(problem, state)), c, 1e-9);
}

TEST(Solve, ConservesMomentumToRounding) {
  const SynthShot synth = shot_of("boxes", 3);
  const Solution s = solved(synth, problem_of(synth));
  const StateT<double> v = values_of(s.problem, s.fit.state);
  const double m = v.mass_ratio;
  EXPECT_LT((v.v_after[0] - v.v[0] + m * (v.v_after[1] - v.v[1])).norm(), 1e-12);
  const Vec3 spin = v.p[0].cross(v.v_after[0] - v.v[0]) + v.h_after[0] - v.h[0] + m * (v.p[1].cross(v.v_after[1] - v.v[1]) + v.h_after[1] - v.h[1]);
  EXPECT_LT(spin.norm(), 1e-12);
}

TEST(Solve, TheImpulseCouplesTheFlightsOfTheSoftForm) {
  const SynthShot synth = shot_of("boxes", 4);
  Problem problem = problem_of(synth);
  problem.terms.soft = true;
  EXPECT_NEAR(solved(synth, problem).fit.state.mass_ratio / *synth.truth.mass_ratio, 1.0, 0.03);
  problem.terms.impulse = problem.terms.momentum = false;
  EXPECT_GT(std::abs(solved(synth, problem).fit.state.mass_ratio / *synth.truth.mass_ratio - 1.0), 1e-6);
}

TEST(Uncertainty, IntervalsHoldTheTruthOfNoisyTracks) {
  SynthOptions o;
  o.scene = "balls";
  o.video = false;
  o.fps = 60;
  o.centroid_noise = 0.05;
  int held = 0, runs = 0;
  for (o.seed = 1; o.seed <= 10; ++o.seed) {
    const SynthShot synth = simulate(o);
    Solution s = solved(synth, problem_of(synth));
    if (!s.fit.usable) continue;
    Context context;
    const Uncertain u = uncertainty(s, 20, 1, context);
    held += u.mass_ratio.low <= *synth.truth.mass_ratio && *synth.truth.mass_ratio <= u.mass_ratio.high;
    ++runs;
  }
  EXPECT_GE(runs, 9);
  EXPECT_GE(held, runs - 2);
}

/// Two solutions of which the second is half as likely as the first: both are among what 95 % of chances lead to.
TEST(Uncertainty, IntervalsReachAnotherSolutionThatIsNotUnlikely) {
  const SynthShot synth = shot_of("balls", 1);
  Solution s = solved(synth, problem_of(synth));
  ASSERT_TRUE(s.fit.usable);
  const double c = restitution_of(s), m = s.fit.state.mass_ratio, other = c > 0.5 ? c - 0.2 : c + 0.2;
  s.others = {{"another", other, 1.5 * m, 1.76}};
  Context context;
  const Uncertain u = uncertainty(s, 0, 1, context);
  EXPECT_LE(u.restitution.low, std::min(c, other));
  EXPECT_GE(u.restitution.high, std::max(c, other));
  EXPECT_GE(u.mass_ratio.high, 1.5 * m);
  s.others.front().excess = 20.0;  // no longer
  const Uncertain sure = uncertainty(s, 0, 1, context);
  EXPECT_TRUE(other < sure.restitution.low || other > sure.restitution.high);
}

TEST(Restitution, PoolsByPrecisionAndBelievesDisagreement) {
  const Estimate p = pooled({{0.6, 0.01, 0, 0}, {0.7, 0.1, 0, 0}});
  EXPECT_NEAR(p.value, (0.6 * 100 + 0.7) / 101.0, 1e-12);
  EXPECT_GT(pooled({{0.5, 0.01, 0, 0}, {0.7, 0.01, 0, 0}}).sd, 0.09);
}

/// A free symmetric top precesses about its momentum at h/I₁ while it turns about its own axis (Landau & Lifshitz, Mechanics, §33).
TEST(Rotation, FollowsTheSymmetricTop) {
  const Vec3 inertia(0.02, 0.02, 0.01);
  const Quat q0(Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()));
  const Vec3 h(0.1, -0.05, 0.2);
  const double t = 1.3;
  const Vec3 axis = q0 * Vec3::UnitZ();
  const double own = h.dot(axis) * (1.0 / inertia.z() - 1.0 / inertia.x());
  const Quat expected = Quat(Eigen::AngleAxisd(h.norm() / inertia.x() * t, h.normalized())) * q0 * Quat(Eigen::AngleAxisd(own * t, Vec3::UnitZ()));
  EXPECT_LT(turned(q0, h, inertia, t).angularDistance(expected), 2e-3);
  EXPECT_LT(turned(turned(q0, h, inertia, t), h, inertia, -t).angularDistance(q0), 1e-3);
}

/// A box that tumbles, followed in steps of its own: Euler's equations of the body's angular velocity, and the rotation matrix with it.
Quat tumbled(const Quat& q0, Vec3 omega, const Vec3& inertia, double time) {
  constexpr int kSteps = 20000;
  Mat3 r = q0.toRotationMatrix();
  const double dt = time / kSteps;
  const auto rate = [&](const Vec3& w) { return Vec3(-w.cross(inertia.cwiseProduct(w)).cwiseQuotient(inertia)); };
  for (int i = 0; i < kSteps; ++i) {
    const Vec3 middle = omega + 0.5 * dt * rate(omega);
    r = r * Eigen::AngleAxisd(middle.norm() * dt, middle.normalized()).toRotationMatrix();
    omega += dt * rate(middle);
  }
  return Quat(r).normalized();
}

/// Two orientations of a body that turned once to twice and more between them: what is left of its turns does not tell their axis.
TEST(SpinStarts, HoldTheMomentumOfABodyThatTumbles) {
  constexpr double kTime = 0.36;  // s
  Random random(5);
  for (int i = 0; i < 12; ++i) {
    const Vec3 size(random.uniform(0.08, 0.3), random.uniform(0.08, 0.3), random.uniform(0.08, 0.3));
    const Vec3 squares = size.cwiseAbs2(), inertia = (Vec3::Constant(squares.sum()) - squares) / 12.0;
    const Quat q0 = Quat(Eigen::Vector4d(random.normal(), random.normal(), random.normal(), random.normal())).normalized();
    const Vec3 omega = random.uniform(15.0, 30.0) * Vec3(random.normal(), random.normal(), random.normal()).normalized();
    Problem problem;
    problem.solids[0].mass.inertia = inertia;
    problem.orientations = {{0, false, 0.0, q0}, {0, false, kTime, tumbled(q0, omega, inertia, kTime)}};
    const Vec3 h = q0 * inertia.cwiseProduct(omega);
    const std::vector<SpinGuess> guesses = spin_guesses(problem, 0, false, kTime);
    EXPECT_TRUE(std::any_of(guesses.begin(), guesses.end(), [&](const SpinGuess& g) { return (g.h - h).norm() < 0.02 * h.norm(); })) << i;
  }
}

TEST(Rotation, DerivativeAlongTheMomentumAgreesWithDifferences) {
  const Vec3 inertia(0.004, 0.005, 0.007), h(0.02, 0.01, -0.03);
  const Quat q = Quat::Identity();
  const std::vector<double> times = {0.1, 0.25, 0.4};
  const std::vector<TurnedEnd> ends = turned_through(q, h, inertia, times, true);
  const Vec3 step(1e-5, -2e-5, 1.5e-5);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_LT(ends[i].q.angularDistance(turned(q, h, inertia, times[i])), 1e-4);
    const Vec3 moved = rotation_vector<double>(turned(q, h + step, inertia, times[i]) * turned(q, h, inertia, times[i]).conjugate());
    EXPECT_LT((moved - ends[i].along_h * step).norm(), 1e-3 * moved.norm() + 1e-9);
  }
}

}  // namespace
}  // namespace unseen::collision
