// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "collision/orientations/orientations.h"
#include "collision/orientations/symmetry.h"
#include "collision/solve/contact.h"
#include "unseen/collision/synth.h"
#include "unseen/core/error.h"
#include "unseen/io/write_video.h"

namespace unseen::collision {
namespace {

constexpr double kRight = 8.0;  // deg

/// A filmed collision with its true tracks, cut into regions by the video part.
struct Filmed {
  SynthShot scene;
  ShotCamera camera;
  Footage footage;
  Tracks tracks;
  std::vector<Vec3> centers;

  Quat truth(int body, double time) const {
    const auto k = static_cast<std::size_t>(std::lround(time * scene.truth.fps));
    return Quat(scene.truth.T_world_camera.rotation.transpose()) * scene.truth.frames[k].bodies[static_cast<std::size_t>(body)]->q;
  }
};

/// The region whose centroid is nearest to a pixel, if it is near at all.
int region_at(const std::vector<Region>& regions, const Vec2& pixel) {
  int best = -1;
  double nearest = 8.0;
  for (std::size_t i = 0; i < regions.size(); ++i)
    if (const double d = (regions[i].centroid - pixel).norm(); d < nearest) nearest = d, best = static_cast<int>(i);
  return best;
}

void add_span(Filmed& f, int body, bool after) {
  const Truth& truth = f.scene.truth;
  const RigidTransform T = truth.T_world_camera.inverse();
  FlightSpan span;
  span.body = body;
  span.begin = f.tracks.points.size();
  for (const FramePose& pose : truth.frames) {
    if ((pose.time > truth.impacts.front().time) != after) continue;
    TrackPoint p;
    const Vec3 center = T * pose.bodies[static_cast<std::size_t>(body)]->p;
    p.body = body;
    p.frame = pose.frame;
    p.time = pose.time;
    p.pixel = truth.camera.project(center);
    p.region = region_at(f.footage.regions[static_cast<std::size_t>(pose.frame)], p.pixel);
    if (p.region < 0) continue;
    f.tracks.points.push_back(p);
    f.centers.push_back(center);
  }
  span.end = f.tracks.points.size();
  auto& meeting = f.tracks.meetings.front();
  (after ? meeting.after : meeting.before).push_back(static_cast<int>(f.tracks.spans.size()));
  f.tracks.spans.push_back(span);
}

Filmed film(const SynthOptions& options, const std::string& name) {
  Filmed f;
  f.scene = simulate(options);
  const std::string path = testing::TempDir() + std::to_string(::getpid()) + name;  // tests run side by side
  Context context;
  io::VideoFile video(path, options.width, options.height, options.fps);
  render(f.scene, options, context, [&](int, const std::vector<std::uint8_t>& bgr) { video.add(bgr); });
  video.close();
  f.scene.shot.video = path;
  f.camera = f.scene.shot.camera;
  f.footage = find_regions(f.scene.shot, context);
  f.tracks.meetings.resize(1);
  f.tracks.meetings.front().time = f.scene.truth.impacts.front().time;
  for (const bool after : {false, true})
    for (int body = 0; body < 2; ++body) add_span(f, body, after);
  return f;
}

SynthOptions small(const std::string& scene, int seed) {
  SynthOptions options;
  options.scene = scene;
  options.seed = seed;
  options.width = 640;
  options.height = 360;
  options.fps = 60;
  options.frames = 36;
  return options;
}

class Spins : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    filmed_ = new Filmed(film(small("boxes", 3), "spins_test.mp4"));
    Context context;
    spins_ = new std::vector<std::vector<Spin>>(find(filmed_->scene.shot, filmed_->tracks, context));
  }
  static void TearDownTestSuite() {
    std::filesystem::remove(filmed_->scene.shot.video);
    delete filmed_;
    delete spins_;
  }
  static std::vector<std::vector<Spin>> find(const Shot& shot, const Tracks& tracks, Context& context) {
    return find_spins(shot, filmed_->camera, filmed_->footage, tracks, filmed_->centers, 6, context);
  }
  static std::vector<Quat> turns(int body) {
    const Solid solid = solid_of(filmed_->scene.truth.bodies[static_cast<std::size_t>(body)], "test");
    std::vector<Quat> all;
    for (const Quat& g : symmetry_of(solid.hull.vertices).turns)
      all.push_back(solid.file_to_principal.conjugate() * g * solid.file_to_principal);
    return all;
  }
  static double error(const Spin& spin, int body) {
    double most = 0;
    for (const Orientation& o : spin.orientations) most = std::max(most, angle_between(o.q, filmed_->truth(body, o.time), turns(body)));
    return degrees(most);
  }
  static Filmed* filmed_;
  static std::vector<std::vector<Spin>>* spins_;
};
Filmed* Spins::filmed_ = nullptr;
std::vector<std::vector<Spin>>* Spins::spins_ = nullptr;

TEST_F(Spins, EachFlightOfABoxIsFound) {
  ASSERT_EQ(spins_->size(), 4U);
  for (std::size_t s = 0; s < 4; ++s) {
    ASSERT_FALSE((*spins_)[s].empty()) << "span " << s;
    EXPECT_LT(error((*spins_)[s].front(), filmed_->tracks.spans[s].body), kRight) << "span " << s;
  }
}

TEST_F(Spins, TheAngularVelocityIsThatOfTheTruth) {
  for (std::size_t s = 0; s < 4; ++s) {
    ASSERT_FALSE((*spins_)[s].empty());
    const Spin& spin = (*spins_)[s].front();
    const int body = filmed_->tracks.spans[s].body;
    const auto k = static_cast<std::size_t>(std::lround(spin.time * filmed_->scene.truth.fps));
    const BodyState& state = *filmed_->scene.truth.frames[k].bodies[static_cast<std::size_t>(body)];
    const double mass = body == 0 ? 1.0 : *filmed_->scene.truth.mass_ratio;
    const Vec3 e = filmed_->scene.truth.bodies[static_cast<std::size_t>(body)].box.cwiseAbs2();
    const Vec3 inertia = mass / 12.0 * Vec3(e.y() + e.z(), e.x() + e.z(), e.x() + e.y());  // a box's, file's axes
    const Vec3 inner = (state.q.conjugate() * state.k).cwiseQuotient(inertia);
    const Vec3 omega = filmed_->scene.truth.T_world_camera.rotation.transpose() * (state.q * inner);
    EXPECT_LT((spin.omega - omega).norm(), 0.1 * omega.norm() + 0.2) << "span " << s;
  }
}

TEST_F(Spins, TheFlightAfterTheImpactGoesOnFromTheOneBefore) {
  for (std::size_t s = 0; s < 2; ++s) {
    const auto &before = (*spins_)[s], &after = (*spins_)[s + 2];
    ASSERT_FALSE(before.empty() || after.empty());
    const double a = before.front().q.angularDistance(filmed_->truth(static_cast<int>(s), before.front().time));
    const double b = after.front().q.angularDistance(filmed_->truth(static_cast<int>(s), after.front().time));
    EXPECT_NEAR(degrees(a), degrees(b), 2 * kRight) << "the same symmetry of the box on both sides, body " << s;
  }
}

TEST_F(Spins, CandidatesAreSortedDistinctAndAsManyAsAsked) {
  for (const auto& list : *spins_) {
    EXPECT_LE(list.size(), 6U);
    for (std::size_t i = 1; i < list.size(); ++i) EXPECT_LE(list[i - 1].cost, list[i].cost);
    for (const Spin& spin : list)
      for (const Orientation& o : spin.orientations) EXPECT_GT(o.sigma, 0.0);
  }
}

TEST_F(Spins, SameResultAtAnyNumberOfThreads) {
  Context context;
  context.threads = 1;
  const auto again = find(filmed_->scene.shot, filmed_->tracks, context);
  ASSERT_EQ(again.size(), spins_->size());
  for (std::size_t s = 0; s < again.size(); ++s) {
    ASSERT_EQ(again[s].size(), (*spins_)[s].size());
    for (std::size_t i = 0; i < again[s].size(); ++i) EXPECT_EQ(again[s][i].q.coeffs(), (*spins_)[s][i].q.coeffs());
  }
}

TEST_F(Spins, SpheresAndFlightsWithoutRegionsHaveNone) {
  Shot shot = filmed_->scene.shot;
  for (Body& b : shot.bodies) b.shape = Shape::sphere, b.radius = 0.1;
  Context context;
  for (const auto& list : find(shot, filmed_->tracks, context)) EXPECT_TRUE(list.empty());
  Tracks blind = filmed_->tracks;
  for (TrackPoint& p : blind.points) p.region = -1;
  for (const auto& list : find(filmed_->scene.shot, blind, context)) EXPECT_TRUE(list.empty());
}

}  // namespace
}  // namespace unseen::collision
