// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/matching/matching.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "interactions/method_samples.h"
#include "interactions/scenelets_sample.h"
#include "unseen/core/random.h"

namespace unseen::interactions {
namespace {

const Database& database() {
  static const Database shared = test::small_database(2001, 6);
  return shared;
}

/// A generated take and glances at it, seen from where its camera really is.
struct Scene {
  explicit Scene(int seed) : synth(simulate(test::synth_options(seed, 12))), view(test::true_view(synth)) {
    sights = sights_of(test::with_persons(synth.take), 0, view);
    for (int frame = 5; frame < 115; frame += 11) glances.push_back(glance_at(sights, frame, synth.take.fps, 1.0, 0.3));
  }
  SynthTake synth;
  View view;
  std::vector<Sight> sights;
  std::vector<Glance> glances;
};

/// Mean robust squared distance in the picture, at the glance's depth: what `refine` promises to lessen.
double robust_error(const Glance& glance, const Scenelet& scenelet, const View& view, const Placement& placement) {
  constexpr double kSigma2 = 0.12 * 0.12;
  double sum = 0, weight = 0;
  for (std::size_t i = 0; i < glance.sights.size(); ++i) {
    const auto pose = pose_at(scenelet, glance.offsets[i]);
    if (!pose) continue;
    for (int k = 0; k < kJoints; ++k) {
      const double c = glance.sights[i]->confidence[k];
      if (c < kSeen) continue;
      const Vec3 q = view.T_world_camera.inverse() * (placement * Vec3(pose->col(k)));
      const Vec2 off = view.camera.project(q) - glance.sights[i]->pixels.col(k);
      const double metres2 = std::pow(glance.depth * off.x() / view.camera.fx, 2) + std::pow(glance.depth * off.y() / view.camera.fy, 2);
      sum += c * kSigma2 * std::log1p(q.z() < 0.2 ? 100.0 : metres2 / kSigma2);
      weight += c;
    }
  }
  return sum / weight;
}

TEST(Sights, AreRaysThroughWhatIsSeen) {
  const Scene scene(2101);
  EXPECT_NEAR(scene.view.center().head<2>().norm(), 0, 1e-9);
  Random random(1);
  for (const Sight& sight : scene.sights)
    for (int k = 0; k < kJoints; ++k) {
      const Vec3 p = scene.view.center() + random.uniform(1, 5) * random.direction();
      const double cost = (p - scene.view.center()).dot(sight.information[static_cast<std::size_t>(k)] * (p - scene.view.center()));
      if (sight.confidence[k] < kSeen) {
        EXPECT_EQ(cost, 0);
        continue;
      }
      const Vec3 ray = sight.rays[static_cast<std::size_t>(k)];
      EXPECT_NEAR((scene.view.project(scene.view.center() + 3 * ray) - sight.pixels.col(k)).norm(), 0, 1e-6);
      EXPECT_NEAR(cost, sight.confidence[k] * (p - scene.view.center()).cross(ray).squaredNorm(), 1e-9);
    }
}

/// A standing person's joints in the picture, `depth` m away and `right` of its middle; all are seen.
Detection upright(const Camera& camera, double right, double depth, int person) {
  Detection d;
  d.person = person;
  d.confidence.setConstant(0.9);
  const Pose pose = simple_pose(0);
  for (int k = 0; k < kJoints; ++k) d.pixels.col(k) = camera.project(Vec3(right + pose(0, k), 1.0 - pose(2, k), depth));
  return d;
}

TEST(Sights, KnowWhatSomebodyInFrontHides) {
  const View view = view_of({1000, 1000, 960, 540, 1920, 1080}, {});
  const auto behind = [&](double right, double depth, double confidence, bool hips = true) {
    Take take;
    take.camera = view.camera;
    take.detections = {upright(view.camera, 0, 5, 0), upright(view.camera, right, depth, 1)};
    take.detections[0].confidence[left_wrist] = confidence;
    if (!hips) take.detections[1].confidence[right_hip] = 0;
    return sights_of(take, 0, view).front().behind_others;
  };
  const auto count = [](const auto& which) { return std::count(which.begin(), which.end(), true); };
  EXPECT_TRUE(behind(0, 3, 0.2)[left_wrist]);
  EXPECT_EQ(count(behind(0, 3, 0.2)), 1) << "the others are seen";
  EXPECT_EQ(count(behind(0, 3, 0.9)), 0) << "seen";
  EXPECT_EQ(count(behind(0, 3, 0)), 0) << "nobody knows where it is";
  EXPECT_EQ(count(behind(0, 7, 0.2)), 0) << "the other is farther away";
  EXPECT_EQ(count(behind(1.2, 3, 0.2)), 0) << "the other stands beside";
  EXPECT_EQ(count(behind(0, 3, 0.2, false)), 0) << "nobody knows how far away the other is";
}

/// Whose joints in the picture are nearest.
int who(const SynthTake& synth, const Detection& d) {
  const View view = test::true_view(synth);
  int nearest = -1;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t p = 0; p < synth.truth.people.size(); ++p) {
    const Pose& pose = synth.truth.people[p][static_cast<std::size_t>(d.frame)].pose;
    double off = 0;
    for (int k = 0; k < kJoints; ++k)
      if (d.confidence[k] > 0) off += (view.project(pose.col(k)) - d.pixels.col(k)).norm();
    if (off >= least) continue;
    least = off;
    nearest = static_cast<int>(p);
  }
  return nearest;
}

TEST(Sights, BlameOthersForWhatIsHidden) {
  int blamed = 0, hidden = 0;
  for (const int seed : {2111, 2112, 2113}) {
    const SynthTake synth = simulate(test::synth_options(seed, 20, 4));
    Take take = synth.take;
    for (Detection& d : take.detections) d.person = who(synth, d);
    for (std::size_t person = 0; person < synth.truth.people.size(); ++person)
      for (const Sight& sight : sights_of(take, static_cast<int>(person), test::true_view(synth)))
        for (std::size_t k = 0; k < kJoints; ++k) {
          blamed += sight.behind_others[k];
          hidden += sight.behind_others[k] && synth.truth.people[person][static_cast<std::size_t>(sight.frame)].occluded[k];
        }
  }
  EXPECT_GT(blamed, 100);
  EXPECT_GT(hidden, 0.95 * blamed);
}

TEST(ViewOfGround, TiltsTheCameraAsAnglesSay) {
  Ground ground;
  ground.camera_height = 1.4;
  ground.pitch = 0.2;
  ground.roll = 0.1;
  const View view = view_of({1000, 1000, 960, 540, 1920, 1080}, ground);
  EXPECT_TRUE(view.T_world_camera.is_rigid(1e-9));
  EXPECT_NEAR((view.center() - Vec3(0, 0, 1.4)).norm(), 0, 1e-12);
  const Vec3 forward = view.ray({960, 540});
  EXPECT_NEAR((forward - Vec3(0, std::cos(0.2), -std::sin(0.2))).norm(), 0, 1e-9) << "it looks down along +y";
  EXPECT_NEAR(std::abs(view.T_world_camera.rotation(2, 0)), std::sin(0.1) * std::cos(0.2), 1e-9) << "and is rolled about that";
}

TEST(Glances, HaveTheFramesAroundTheirCentre) {
  std::vector<Sight> sights;
  for (const int frame : {3, 4, 7, 10, 12, 13, 16, 19, 20, 25, 40}) {
    sights.emplace_back();
    sights.back().frame = frame;
    sights.back().depth = frame == 13 ? 2 : frame == 40 ? 100 : 0;
  }
  const Glance glance = glance_at(sights, 13, 10, 1.0, 0.3);
  std::vector<int> frames;
  for (const Sight* s : glance.sights) frames.push_back(s->frame);
  EXPECT_EQ(frames, (std::vector<int>{4, 7, 10, 13, 16, 19}));
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_NEAR(glance.offsets[i], (frames[i] - 13) / 10.0, 1e-12);
  EXPECT_EQ(glance.depth, 2);
}

TEST(Glances, ReachAsFarWhereOnlySomeFramesHaveADetection) {
  for (const int every : {1, 2, 3, 4, 5, 6, 7}) {
    std::vector<Sight> sights;
    for (int frame = 0; frame < 300; frame += every) {
      sights.emplace_back();
      sights.back().frame = frame;
    }
    const Glance glance = glance_at(sights, 30 * every, 30, 1.0, 0.3);
    EXPECT_GE(glance.sights.size(), 6u) << every;
    EXPECT_LE(glance.sights.size(), 7u) << every;
    EXPECT_LE(glance.offsets.front(), -0.75) << every;
    EXPECT_GE(glance.offsets.back(), 0.75) << every;
    for (std::size_t i = 0; i + 1 < glance.sights.size(); ++i) EXPECT_LT(glance.sights[i]->frame, glance.sights[i + 1]->frame);
  }
}

TEST(PosesOfAScenelet, LieBetweenThoseRecorded) {
  const Scenelet s = test::moving_scenelet(simple_pose(0), 1.0);
  for (const double offset : {-0.5, -0.37, 0.0, 0.02, 0.499, 0.5}) {
    ASSERT_TRUE(pose_at(s, offset)) << offset;
    EXPECT_NEAR((*pose_at(s, offset))(0, pelvis), offset, 1e-9);
  }
  EXPECT_FALSE(pose_at(s, 0.51));
  EXPECT_FALSE(pose_at(s, -0.51));
}

TEST(MatchAll, AgreesWithTheClosedFormInDoubleForEveryScenelet) {
  const Scene scene(2101);
  const Vec3 camera = scene.view.center();
  Context context;
  const auto all = match_all(scene.glances, database(), camera, database().scenelets.size(), context);
  ASSERT_EQ(all.size(), scene.glances.size());
  for (std::size_t g = 0; g < all.size(); ++g) {
    const Glance& glance = scene.glances[g];
    double total = 0;
    Vec3 ahead = Vec3::Zero();
    for (const Sight* sight : glance.sights) {
      total += (sight->confidence >= kSeen).select(sight->confidence, 0.0).sum();
      for (int k = 0; k < kJoints; ++k)
        if (sight->confidence[k] >= kSeen) ahead += sight->confidence[k] * sight->rays[k];
    }
    std::map<int, Match> matches;
    for (std::size_t i = 0; i < all[g].size(); ++i) {
      EXPECT_TRUE(i == 0 || all[g][i - 1].error <= all[g][i].error);
      EXPECT_TRUE(matches.emplace(all[g][i].scenelet, all[g][i]).second) << "twice the same";
    }
    EXPECT_GT(matches.size(), database().scenelets.size() / 3);
    for (int s = 0; s < static_cast<int>(database().scenelets.size()); ++s) {
      double weight = 0;
      const PlacementCost cost = cost_of(glance, database().scenelets[static_cast<std::size_t>(s)], camera, weight);
      PlacementFit fit;
      const bool told = weight > 0 && fit_placement(cost, fit);
      constexpr double kHips = 0.8;  // m; a body behind the camera is on no ray
      const bool in_front = told && ahead.dot(Vec3(fit.position.x(), fit.position.y(), kHips - camera.z())) > 1e-3;
      const bool good = in_front && weight > 0.501 * total && fit.position.norm() > 0.31, bad = weight < 0.499 * total || (told && fit.position.norm() < 0.29);
      const auto match = matches.find(s);
      EXPECT_TRUE(!good || match != matches.end()) << s;
      EXPECT_TRUE(!bad || match == matches.end()) << s;
      if (match == matches.end() || !good) continue;
      const Placement& placement = match->second.placement;
      const double error = fit.cost / weight * glance.depth * glance.depth / fit.position.squaredNorm();
      EXPECT_NEAR(match->second.error, error, 1e-4 + 1e-3 * error) << s;
      // Where two angles are nearly as good, floats may take the other; its cost then is nearly the least.
      EXPECT_LT(cost.at(placement.angle, placement.position.head<2>()), fit.cost * 1.001 + 1e-3 * weight) << s;
    }
  }
}

TEST(MatchAll, KeepsTheBest) {
  const Scene scene(2102);
  Context context;
  const auto all = match_all(scene.glances, database(), scene.view.center(), 100000, context);
  const auto few = match_all(scene.glances, database(), scene.view.center(), 7, context);
  for (std::size_t g = 0; g < all.size(); ++g) {
    ASSERT_EQ(few[g].size(), 7u);
    for (std::size_t i = 0; i < 7; ++i) {
      EXPECT_EQ(few[g][i].scenelet, all[g][i].scenelet);
      EXPECT_EQ(few[g][i].error, all[g][i].error);
    }
  }
}

TEST(MatchAll, FindsTheMotionItself) {
  // The take's own scenelets are in the database: some of them explain it best, and where it happened.
  const Scene scene(2001);
  Context context;
  const Database own = build_database({simulate(test::synth_options(2001, 12)).truth, simulate(test::synth_options(2002, 12)).truth}, {}, context);
  const auto best = match_all(scene.glances, own, scene.view.center(), 1, context);
  int right = 0, tried = 0;
  for (std::size_t g = 0; g < best.size(); ++g) {
    if (best[g].empty()) continue;
    ++tried;
    const Scenelet& scenelet = own.scenelets[static_cast<std::size_t>(best[g][0].scenelet)];
    right += scenelet.recording == 0 && (best[g][0].placement.position - scenelet.origin.position).head<2>().norm() < 0.5;
  }
  EXPECT_GE(tried, 8);
  EXPECT_GE(right, tried * 2 / 3);
}

TEST(MatchAll, OfNothingIsNothing) {
  const Scene scene(2101);
  Context context;
  for (const auto& matches : match_all(scene.glances, {}, scene.view.center(), 5, context)) EXPECT_TRUE(matches.empty());
  EXPECT_TRUE(match_all({}, database(), scene.view.center(), 5, context).empty());
  std::vector<Sight> unseen = {scene.sights[0]};
  unseen[0].confidence.setZero();
  unseen[0].information.fill(Mat3::Zero());
  EXPECT_TRUE(match_all({glance_at(unseen, unseen[0].frame, 10, 1, 0.3)}, database(), scene.view.center(), 5, context)[0].empty());
}

TEST(Refine, EndsWhereTheRobustCostIsLeast) {
  const Scene scene(2103);
  Context context;
  const auto matches = match_all(scene.glances, database(), scene.view.center(), 8, context);
  Random random(1);
  for (std::size_t g = 0; g < matches.size(); ++g)
    for (const Match& start : matches[g]) {
      const Scenelet& scenelet = database().scenelets[static_cast<std::size_t>(start.scenelet)];
      const auto error = [&](const Placement& p) { return robust_error(scene.glances[g], scenelet, scene.view, p); };
      Match match = start;
      refine(match, scene.glances[g], scenelet, scene.view);
      EXPECT_NEAR(match.error, error(match.placement), 1e-9);
      EXPECT_LE(match.error, error(start.placement) + 1e-12);
      EXPECT_EQ(match.placement.position.z(), start.placement.position.z());
      Match again = match;
      for (int i = 0; i < 20; ++i) refine(again, scene.glances[g], scenelet, scene.view);
      EXPECT_LT(match.error - again.error, 2e-4) << "six rounds are nearly enough";
      constexpr double kStep = 1e-5;
      for (int d = 0; d < 3; ++d) {  // numeric gradient by angle, x and y
        const auto moved = [&](double by) {
          Placement p = again.placement;
          if (d == 0) p.angle += by;
          else p.position[d - 1] += by;
          return error(p);
        };
        EXPECT_NEAR((moved(kStep) - moved(-kStep)) / (2 * kStep), 0, 1e-5);
      }
      for (int i = 0; i < 20; ++i) {
        const Placement near{again.placement.position + random.uniform(0, 0.02) * Vec3(random.normal(), random.normal(), 0),
                             again.placement.angle + 0.02 * random.normal()};
        EXPECT_GE(error(near), again.error - 1e-9);
      }
    }
}

TEST(Refine, StandsWhatIsBehindTheCamera) {
  const Scene scene(2103);
  const Scenelet& scenelet = database().scenelets[0];
  Match match{0, {{0, -5, 0}, 0}, 0};
  refine(match, scene.glances[2], scenelet, scene.view);
  EXPECT_TRUE(std::isfinite(match.error));
  EXPECT_TRUE(match.placement.position.allFinite());
}

}  // namespace
}  // namespace unseen::interactions
