// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include <algorithm>

#include "collision/flight_search.h"
#include "collision/rotation.h"
#include "collision/touching.h"
#include "collision/touching_fit.h"
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
    const std::optional<Touching> t = touch_along(a, q_a, b, q_b, u);
    ASSERT_TRUE(t);
    EXPECT_LT(t->offset.normalized().cross(u).norm(), 1e-9);
    // the boxes in their own axes
    const Quat box_a = q_a * a.file_to_principal, box_b = q_b * b.file_to_principal;
    EXPECT_FALSE(overlap(size_a, 1.002 * t->offset, box_a, size_b, box_b)) << i;
    EXPECT_TRUE(overlap(size_a, 0.9 * t->offset, box_a, size_b, box_b)) << i;
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

}  // namespace
}  // namespace unseen::collision
