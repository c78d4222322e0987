// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "collision/describe.h"
#include "collision/shot_problem.h"
#include "collision/solve_impacts.h"
#include "collision/tracks/tracks.h"
#include "unseen/collision/collision.h"
#include "unseen/collision/synth.h"
#include "unseen/core/error.h"
#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

/// A ball seen from the side that bounces off the floor with restitution `c`, at `fps`, as centroids and radii.
Shot bouncing_ball(double c, int frames = 90, double fps = 60) {
  Shot shot;
  shot.name = "ball.shot.json";
  shot.fps = fps;
  shot.camera.camera = {800, 800, 320, 240, 640, 480};
  Body ball, floor;
  ball.name = "ball";
  ball.radius = 0.03;
  floor.name = "floor";
  floor.shape = Shape::fixed;
  shot.bodies = {ball, floor};
  const double height = 0.8, impact = std::sqrt(2.0 * height / 9.81), z = 3.0;
  for (int f = 0; f < frames; ++f) {
    double t = f / fps, speed = std::sqrt(2.0 * 9.81 * height), y = height - 0.5 * 9.81 * t * t;
    double start = impact;
    if (t > impact) {
      speed *= c;
      while (t > start + 2.0 * speed / 9.81) start += 2.0 * speed / 9.81, speed *= c;
      y = speed * (t - start) - 0.5 * 9.81 * (t - start) * (t - start);
    }
    shot.observations.push_back({f, {320 + 800 * (0.1 * t - 0.1) / z, 240 + 800 * (0.5 - y) / z}, 800 * 0.03 / z, 0});
  }
  return shot;
}

TEST(Reconstruct, ReadsTheRestitutionOfABouncingBall) {
  Context context;
  const Reconstruction r = reconstruct(bouncing_ball(0.7), {}, context);
  ASSERT_TRUE(r.restitution);
  EXPECT_NEAR(r.restitution->value, 0.7, 0.01);
  EXPECT_GE(r.impacts.size(), 1u);
  EXPECT_NEAR(r.impacts[0].time, std::sqrt(2.0 * 0.8 / 9.81), 0.005);
  EXPECT_EQ(r.fixed, "floor");
  EXPECT_TRUE(r.fits);
  EXPECT_FALSE(r.mass_ratio);
}

// A camera that looks down by 12° while the shot says that it is level.
TEST(Reconstruct, DownThatTheFlightsContradictIsSaid) {
  const double pitch = radians(12.0), c = 0.7, fps = 120;
  Shot shot = bouncing_ball(c, 60, fps);
  shot.observations.clear();
  Random random(4);
  const double impact = std::sqrt(2.0 * 0.8 / 9.81);
  for (int f = 0; f < 90; ++f) {
    const double t = f / fps, since = t - impact, v = c * 9.81 * impact;
    const double height = t < impact ? 0.8 - 0.5 * 9.81 * t * t : v * since - 0.5 * 9.81 * since * since;
    const Vec3 level(0.3 * t - 0.1, 0.4 - height, 2.2), p = Eigen::AngleAxisd(pitch, Vec3::UnitX()) * level;
    shot.observations.push_back({f, Vec2(320 + 800 * p.x() / p.z(), 240 + 800 * p.y() / p.z()) + 0.3 * Vec2(random.normal(), random.normal()), 800 * 0.03 / p.z(), 0});
  }
  const Vec3 down = Eigen::AngleAxisd(pitch, Vec3::UnitX()) * Vec3::UnitY();
  for (const bool right : {true, false}) {
    shot.down = right ? down : Vec3::UnitY();
    Context context;
    const Reconstruction r = reconstruct(shot, {}, context);
    const bool said = std::any_of(r.summary.warnings.begin(), r.summary.warnings.end(), [](const std::string& w) { return w.find("away from where it is given") != std::string::npos; });
    EXPECT_EQ(said, !right);
    ASSERT_TRUE(r.restitution);
    EXPECT_LE(r.restitution->low, c);
    EXPECT_GE(r.restitution->high, c);
  }
}

/// Two discs on a table without friction, seen from above by a camera that is `slant` (rad) off the vertical; they meet `aside` (m) of its axis.
Shot discs_on_a_table(double slant, double aside, std::uint64_t seed) {
  Shot shot = bouncing_ball(0.7, 1);
  shot.gravity = 0.0;
  shot.observations.clear();
  shot.bodies[1] = shot.bodies[0];
  shot.bodies[1].name = "other";
  Random random(seed);
  const double fps = 60, c = 0.9, radius = 0.03, time = 0.45;
  const std::array<Vec3, 2> at{Vec3(-radius, 0, 0), Vec3(radius, 0, 0)}, before{Vec3(0.8, 0.5, 0), Vec3(-0.6, 0.2, 0)};
  const double sum = 0.2, apart = c * 1.4;
  const std::array<Vec3, 2> after{Vec3(0.5 * (sum - apart), 0.5, 0), Vec3(0.5 * (sum + apart), 0.2, 0)};
  for (int f = 0; f < 54; ++f)
    for (int o = 0; o < 2; ++o) {
      const double t = f / fps - time;
      const Vec3 p = Eigen::AngleAxisd(slant, Vec3::UnitX()) * (at[o] + t * (t < 0 ? before[o] : after[o])) + Vec3(aside, 0, 1.5);
      shot.observations.push_back({f, Vec2(320 + 800 * p.x() / p.z(), 240 + 800 * p.y() / p.z()) + 0.2 * Vec2(random.normal(), random.normal()), 800 * radius / p.z() * (1 + 0.01 * random.normal()), o});
    }
  return shot;
}

TEST(Reconstruct, APlaneThatSlantsIsSaidWithoutGravity) {
  for (const double slant : {0.0, 0.15})
    for (const double aside : {0.0, 0.4})
      for (const std::uint64_t seed : {1, 2, 3}) {
        Context context;
        const Reconstruction r = reconstruct(discs_on_a_table(slant, aside, seed), {}, context);
        const bool said = std::any_of(r.summary.warnings.begin(), r.summary.warnings.end(), [](const std::string& w) { return w.find("parallel to the image") != std::string::npos; });
        EXPECT_EQ(said, slant > 0.0) << slant << " " << aside << " " << seed;
        ASSERT_FALSE(r.impacts.empty());
      }
}

// Of five sightings no bounce is found; that they are far apart in frames may be why.
TEST(Reconstruct, SightingsFarApartInFramesAreSaid) {
  for (const int apart : {1, 16}) {
    Shot shot = bouncing_ball(0.7, 5);
    *shot.fps *= apart;
    for (Sighting& s : shot.observations) s.frame *= apart;
    Context context;
    const Reconstruction r = reconstruct(shot, {}, context);
    EXPECT_FALSE(r.restitution);
    EXPECT_EQ(std::any_of(r.summary.warnings.begin(), r.summary.warnings.end(), [](const std::string& w) { return w.find("16 frames apart") != std::string::npos; }), apart > 1);
  }
}

TEST(Reconstruct, FlightsBetweenTwoImpactsHaveNoJump) {
  Shot shot = bouncing_ball(0.7, 120);
  Random random(3);
  for (Sighting& s : shot.observations) s.pixel += Vec2(0.5 * random.normal(), 0.5 * random.normal());
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  ASSERT_GE(r.impacts.size(), 3u);
  const double step = 1.0 / *shot.fps;
  int checked = 0;
  for (std::size_t i = 2; i < r.frames.size(); ++i) {
    const FramePose &before = r.frames[i - 2], &middle = r.frames[i - 1], &after = r.frames[i];
    if (!before.bodies[0] || !middle.bodies[0] || !after.bodies[0] || after.frame != before.frame + 2) continue;
    if (std::any_of(r.impacts.begin(), r.impacts.end(), [&](const Impact& hit) { return hit.time >= before.time && hit.time <= after.time; })) continue;
    ++checked;
    const Vec3 bend = before.bodies[0]->p - 2.0 * middle.bodies[0]->p + after.bodies[0]->p;
    EXPECT_LT((bend - step * step * 9.81 * r.gravity_direction).norm(), 0.005) << "frame " << middle.frame;
    EXPECT_LT((after.bodies[0]->p - before.bodies[0]->p - 2.0 * step * middle.bodies[0]->v).norm(), 0.005) << "frame " << middle.frame;
  }
  EXPECT_GT(checked, 80);
}

TEST(Reconstruct, FastSpinsWhoseOrientationsAreBetterThanTold) {
  SynthOptions synth;
  synth.scene = "spin";
  synth.spin = 20.0;
  synth.fps = 60;
  synth.video = false;
  synth.centroid_noise = 0.01;
  synth.orientation_noise = 2.0;
  const SynthShot shot = simulate(synth);
  Options options;
  options.orientation_noise = 2.0;  // more than they have
  Context context;
  const Reconstruction r = reconstruct(shot.shot, options, context);
  ASSERT_TRUE(r.restitution);
  EXPECT_NEAR(r.restitution->value, *shot.truth.restitution, 0.03);  // with one noise only: 0.29 off
}

TEST(Reconstruct, ABounceOfWhichThreeTenthsOfASecondAreUnseen) {
  Shot shot = bouncing_ball(0.7, 55);
  const double impact = std::sqrt(2.0 * 0.8 / 9.81);
  std::erase_if(shot.observations, [&](const Sighting& s) { return std::abs(s.frame / *shot.fps - impact) < 0.15; });
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  ASSERT_EQ(r.impacts.size(), 1u);
  EXPECT_NEAR(r.impacts[0].time, impact, 0.01);
  ASSERT_TRUE(r.restitution);
  EXPECT_NEAR(r.restitution->value, 0.7, 0.02);
}

TEST(Reconstruct, RefusesShotsThatNoFileHolds) {  // made in code
  const std::vector<std::pair<std::string, std::function<void(Shot&)>>> faults = {{"bodies", [](Shot& shot) { shot.bodies.clear(); }},
                                                                                  {"fps", [](Shot& shot) { shot.fps = 0.0; }},
                                                                                  {"fps", [](Shot& shot) { shot.fps = INFINITY; }},
                                                                                  {"gravity", [](Shot& shot) { shot.gravity = NAN; }}};
  for (const auto& [field, spoil] : faults) {
    Shot shot = bouncing_ball(0.7, 55);
    spoil(shot);
    Context context;
    try {
      reconstruct(shot, {}, context);
      ADD_FAILURE() << field;
    } catch (const InputError& e) {
      EXPECT_EQ(e.field, field);
    }
  }
}

TEST(Reconstruct, OneRestitutionForAllImpactsIfAsked) {
  Context context;
  Options options;
  options.shared_restitution = true;
  const Reconstruction r = reconstruct(bouncing_ball(0.7), options, context);
  ASSERT_GE(r.impacts.size(), 2u);
  EXPECT_NEAR(r.impacts[0].restitution.value, r.impacts[1].restitution.value, 0.005);
}

TEST(Reconstruct, AGivenFloorStaysAsGiven) {
  Shot shot = bouncing_ball(0.7);
  const Vec3 normal = Vec3(0.0, -1.0, 0.05).normalized();
  shot.bodies[1].normal = normal;
  shot.floor = Plane{Vec3(0, -1, 0), -0.2};
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  EXPECT_TRUE(std::any_of(r.summary.warnings.begin(), r.summary.warnings.end(), [](const std::string& w) { return w.find("floor: not used") != std::string::npos; }));
  ASSERT_GE(r.impacts.size(), 2u);
  for (const Impact& impact : r.impacts) EXPECT_LT((r.T_world_camera.rotation.transpose() * impact.normal - normal).norm(), 1e-6);
}

TEST(Reconstruct, SaysThatAFlightHasNoCollision) {
  Shot shot = bouncing_ball(0.7, 22);
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  EXPECT_TRUE(r.impacts.empty());
  EXPECT_FALSE(r.restitution);
  EXPECT_EQ(r.summary.status, Status::infeasible);
}

TEST(Reconstruct, SaysWhereBodiesThatDoNotMeetWereSeenToFly) {
  Shot shot = bouncing_ball(0.7, 0);
  shot.bodies[1] = shot.bodies[0];
  shot.bodies[1].name = "other";
  for (int f = 5; f < 60; ++f) {
    const double t = f / 60.0 - 0.4, y = 4.905 * t * t;
    shot.observations.push_back({f, {320 + 267 * 1.2 * t, 140 + 267 * y}, 8.0, 0});
    if (f > 20) shot.observations.push_back({f, {320 - 267 * 0.9 * t, 60 + 267 * y}, 8.0, 1});
  }
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  EXPECT_FALSE(r.restitution);
  const std::string& said = r.summary.warnings.back();
  for (const char* part : {"do not meet", "ball in frames 5 to 59", "other in frames 21 to 59"}) EXPECT_NE(said.find(part), std::string::npos) << said;
}

TEST(Reconstruct, WarnsWhereSizeAndGravityDisagree) {
  Shot shot = bouncing_ball(0.7);
  shot.fps = 48;  // the file's rate is a lie
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  bool warned = false;
  for (const std::string& w : r.summary.warnings) warned |= w.find("frame rate") != std::string::npos;
  EXPECT_TRUE(warned);
}

TEST(Reconstruct, TwoBallsFromTheirCentroids) {
  SynthOptions o;
  o.scene = "balls";
  o.video = false;
  o.fps = 120;
  o.seed = 2;
  const SynthShot synth = simulate(o);
  Context context;
  const Reconstruction r = reconstruct(synth.shot, {}, context);
  ASSERT_EQ(r.impacts.size(), 1u);
  ASSERT_TRUE(r.mass_ratio);
  EXPECT_NEAR(r.mass_ratio->value / *synth.truth.mass_ratio, 1.0, 0.03);
  ASSERT_TRUE(r.restitution);
  EXPECT_NEAR(r.restitution->value, *synth.truth.restitution, 0.05);
}

TEST(Reconstruct, SameSeedSameValuesAtAnyThreadCount) {
  Context one, two;
  one.threads = 1;
  two.threads = 2;
  const Reconstruction a = reconstruct(bouncing_ball(0.6), {}, one), b = reconstruct(bouncing_ball(0.6), {}, two);
  ASSERT_TRUE(a.restitution && b.restitution);
  EXPECT_EQ(a.restitution->value, b.restitution->value);
  EXPECT_EQ(a.restitution->sd, b.restitution->sd);
}

/// The sightings of every n-th frame, from one on.
Shot thinned(Shot shot, int n, int from) {
  std::erase_if(shot.observations, [&](const Sighting& seen) { return seen.frame % n != from; });
  return shot;
}

TEST(Reconstruct, SightingsInEveryNthFrameAreAsGood) {
  SynthOptions synth;
  synth.scene = "balls";
  synth.fps = 960;
  synth.video = false;
  const SynthShot balls = simulate(synth);
  for (const auto& [n, from] : {std::pair{5, 1}, {10, 0}}) {
    Context context;
    const Reconstruction r = reconstruct(thinned(balls.shot, n, from), {}, context);
    ASSERT_TRUE(r.restitution) << n << " " << from;
    EXPECT_NEAR(r.restitution->value, *balls.truth.restitution, 0.05) << n << " " << from;
    EXPECT_TRUE(r.fits) << n << " " << from;
    EXPECT_GT(r.held_out_rms, 0.0) << n << " " << from;
  }
  for (const int n : {5, 8}) {
    Context context;
    const Reconstruction r = reconstruct(thinned(bouncing_ball(0.7, 1000, 960), n, 0), {}, context);
    ASSERT_TRUE(r.restitution) << n;
    EXPECT_NEAR(r.restitution->value, 0.7, 0.01) << n;
  }
}

TEST(Reconstruct, FiveSightingsAfterTheBounceOfManyAreRead) {  // so many that ends are multiples of a step: one lies behind the last
  Shot shot = bouncing_ball(0.7, 1, 240);
  shot.observations.clear();
  shot.camera.camera = {1000, 1000, 639.5, 359.5, 1280, 720};
  shot.bodies[0].radius = 0.05;
  for (int k = -240; k < 5; ++k) {
    const double t = (k + 0.5) / 240.0, y = 0.75 + (t < 0.0 ? 4.0 : -3.0) * t + 0.5 * 9.81 * t * t, x = -0.6 + 0.5 * (t + 1.0);
    shot.observations.push_back({k + 240, {639.5 + 400 * x, 359.5 + 400 * y}, 20.0, 0});
  }
  Context context;
  EXPECT_LE(reconstruct(shot, {}, context).impacts.size(), 1u);
}

TEST(Reconstruct, FewSightingsOfAFlightAreNoMisfit) {
  int fit = 0;
  for (int seed = 1; seed <= 8; ++seed) {
    Shot shot = bouncing_ball(0.6, 20, 20);
    Random random(static_cast<std::uint64_t>(seed));
    for (Sighting& seen : shot.observations) {
      seen.pixel += 0.3 * Vec2(random.normal(), random.normal());
      seen.radius = 0.0;
    }
    Context context;
    const Reconstruction r = reconstruct(shot, {}, context);
    if (r.restitution) {
      EXPECT_NEAR(r.restitution->value, 0.6, 0.05) << seed;
    }
    fit += r.fits;
  }
  EXPECT_EQ(fit, 8);
}

TEST(Reconstruct, TellsTheTimesOfFramesThatComeUnevenly) {
  const Shot shot = bouncing_ball(0.7, 55);
  const ShotCamera camera = complete_camera(shot, 0, 0);
  Context context;
  Tracks tracks = find_tracks(shot, camera, shot.observations, *shot.fps, context);
  for (TrackPoint& p : tracks.points)
    if (p.frame > 10) p.frame += 8;  // eight pictures more between two of them
  const std::array<Solid, 2> solids = {solid_of(shot.bodies[0], shot.name), solid_of(shot.bodies[1], shot.name)};
  Reconstruction r;
  std::vector<SolvedImpact> impacts = solve_positions(shot, {}, camera, solids, tracks, *shot.fps, context);
  ASSERT_GE(impacts.size(), 1u);
  for (SolvedImpact& impact : impacts) {
    impact.check.held_out.assign(impact.solution.problem.points.size(), 0);
    impact.check.outlier = impact.check.held_out;
  }
  describe(shot, tracks, *shot.fps, impacts, r);
  EXPECT_NEAR(r.impacts[0].time, std::sqrt(2.0 * 0.8 / 9.81), 0.005);
  EXPECT_NEAR(r.impacts[0].frame, std::sqrt(2.0 * 0.8 / 9.81) * 60 + 8, 0.3);
  for (const FramePose& f : r.frames)
    if (f.frame <= 10 || f.frame > 18) {
      EXPECT_NEAR(f.time, (f.frame > 10 ? f.frame - 8 : f.frame) / 60.0, 1e-9) << f.frame;
    }
}

TEST(Reconstruct, ACameraOfAnotherSizeThanTheVideoIsRefused) {  // its focal length and principal point are pixels of that size
  Shot shot = bouncing_ball(0.7, 55);
  shot.camera.camera.width = 3840;
  shot.camera.camera.height = 2160;
  EXPECT_NO_THROW(complete_camera(shot, 3840, 2160));
  EXPECT_THROW(complete_camera(shot, 1920, 1080), InputError);
}

TEST(Reconstruct, ADownThatPointsUpIsNoFit) {
  SynthOptions synth;
  synth.scene = "ball-floor";
  synth.video = false;
  synth.seed = 8;
  Shot shot = simulate(synth).shot;
  shot.down = Vec3(0, -1, 0);
  Context context;
  const Reconstruction r = reconstruct(shot, {}, context);
  EXPECT_FALSE(r.fits);  // though one of its impacts seems to
  EXPECT_FALSE(r.restitution);
}

}  // namespace
}  // namespace unseen::collision
