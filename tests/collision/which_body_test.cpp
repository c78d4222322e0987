// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/which_body.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "collision/orientations/centering.h"
#include "collision/orientations/pose_cost.h"
#include "collision/solve/rotation.h"

namespace unseen::collision::test {
namespace {

constexpr double kFps = 60.0;

Body box(const std::string& name, const Vec3& edges) {
  Body body;
  body.name = name;
  body.shape = Shape::box;
  body.box = edges;
  return body;
}

ShotCamera camera() {
  ShotCamera c;
  c.camera = {1000, 1000, 640, 360, 1280, 720};
  return c;
}

/// A region of a body's silhouette; the pixels whose centres are inside.
Region seen(const SpinBody& body, const Quat& q, const Vec3& center, int frame) {
  const Eigen::Matrix2Xd pixels = projected(body.corners, q, center, camera().camera);
  std::vector<cv::Point2f> points, hull;
  for (const auto& p : pixels.colwise()) points.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  cv::convexHull(points, hull);
  Region region;
  region.frame = frame;
  region.box = cv::boundingRect(points);
  region.mask = cv::Mat::zeros(region.box.size(), CV_8U);
  for (int y = 0; y < region.box.height; ++y)
    for (int x = 0; x < region.box.width; ++x)
      if (cv::pointPolygonTest(hull, cv::Point2f(static_cast<float>(region.box.x + x), static_cast<float>(region.box.y + y)), false) >= 0)
        region.mask.at<unsigned char>(y, x) = 255;
  const cv::Moments m = cv::moments(region.mask, true);
  region.area = m.m00;
  region.centroid = Vec2(m.m10 / m.m00 + region.box.x, m.m01 / m.m00 + region.box.y);
  return region;
}

/// Two boxes (a cube and a slab of the same mean projected area, unless others are asked for) fly towards each other and back, turned by `phase`
/// (rad) at the start; the tracks have the first as `first` says.
struct Scene {
  Shot shot;
  Footage footage;
  Tracks tracks;

  explicit Scene(int first, const Vec3& edges = {0.12, 0.12, 0.12}, const Vec3& other_edges = {0.2, 0.13, 0.026}, double phase = 0.0) {
    shot.name = "shot";
    shot.bodies = {box("one", edges), box("other", other_edges)};
    footage.width = 1280, footage.height = 720, footage.fps = kFps;
    footage.regions.resize(40);
    const std::array<SpinBody, 2> bodies = {spin_body(shot.bodies[0], "shot"), spin_body(shot.bodies[1], "shot")};
    for (const bool after : {false, true})
      for (int body = 0; body < 2; ++body) {
        const int label = body == 0 ? first : 1 - first;
        FlightSpan span{label, tracks.points.size(), 0};
        for (int k = after ? 21 : 0; k < (after ? 40 : 20); ++k) {
          const double side = body == 0 ? -1.0 : 1.0, away = 0.08 + 0.02 * std::abs(k - 20);
          const Quat q = rotation_by<double>(Vec3(0.09 * k + phase, 0.05 * k + body, 0.4 + 0.03 * k * side));
          auto& regions = footage.regions[static_cast<std::size_t>(k)];
          regions.push_back(seen(bodies[static_cast<std::size_t>(body)], q, {side * away, 0.05, 2.0}, k));
          tracks.points.push_back({label, k, k / kFps, regions.back().centroid, 0.0, static_cast<int>(regions.size()) - 1});
        }
        span.end = tracks.points.size();
        tracks.spans.push_back(span);
      }
    tracks.meetings.push_back({20 / kFps, {0, 1}, {2, 3}});
  }
};

TEST(WhichBody, ShapesOfOneSizeAreToldApart) {
  for (const int cube : {0, 1}) {
    Scene scene(cube);
    label_by_shape(scene.shot, camera(), scene.footage, scene.tracks);
    EXPECT_TRUE(scene.tracks.told_apart);
    for (const std::size_t s : {0u, 2u}) EXPECT_EQ(scene.tracks.spans[s].body, 0) << cube;
    for (const std::size_t s : {1u, 3u}) EXPECT_EQ(scene.tracks.spans[s].body, 1) << cube;
    for (const FlightSpan& span : scene.tracks.spans)
      for (std::size_t i = span.begin; i < span.end; ++i) EXPECT_EQ(scene.tracks.points[i].body, span.body);
  }
}

/// Blurred by motion, one of them may look like the other one nearer: but its distance does not change then as that of what flies.
TEST(WhichBody, BoxesThatOftenLookAlikeAreNotTakenForEachOther) {
  constexpr int kBlur = 13;  // px
  int told = 0;
  for (int k = 0; k < 40; ++k) {
    Scene scene(k % 2, {0.232, 0.110, 0.072}, {0.246, 0.094, 0.109}, 0.3 * k);
    for (auto& frame : scene.footage.regions)
      for (Region& region : frame) {
        cv::copyMakeBorder(region.mask, region.mask, 0, 0, kBlur, kBlur, cv::BORDER_CONSTANT, 0);
        cv::dilate(region.mask, region.mask, cv::Mat::ones(1, kBlur, CV_8U));
        region.area = cv::countNonZero(region.mask);
      }
    label_by_shape(scene.shot, camera(), scene.footage, scene.tracks);
    told += scene.tracks.told_apart;
    EXPECT_TRUE(!scene.tracks.told_apart || scene.tracks.spans[0].body == 0) << k;
  }
  EXPECT_GE(told, 36);
}

TEST(WhichBody, TwinsAreNotToldApart) {
  Scene scene(0);
  scene.shot.bodies[1] = scene.shot.bodies[0];
  label_by_shape(scene.shot, camera(), scene.footage, scene.tracks);
  EXPECT_FALSE(scene.tracks.told_apart);
  EXPECT_EQ(scene.tracks.spans[0].body, 0);
}

TEST(Centering, SilhouettesTellTheProjectedCentreAndTheDistance) {
  Scene scene(0);
  Problem problem;
  problem.camera = camera().camera;
  problem.solids = {solid_of(scene.shot.bodies[0], "shot"), solid_of(scene.shot.bodies[1], "shot")};
  const std::array<FigureMaker, 2> makers = {FigureMaker(scene.shot.bodies[0], "shot"), FigureMaker(scene.shot.bodies[1], "shot")};
  const SpinBody slab = spin_body(scene.shot.bodies[1], "shot");
  const Vec3 truth(0.5, 0.2, 1.2);
  const auto turn = [](double time) { return rotation_by<double>(Vec3(1.0 + time, 0.4 * time, 0.3)); };
  std::vector<PointObservation> points;
  double worst = 0.0;
  for (int k = 0; k < 20; ++k) {
    const Region region = seen(slab, turn(k / kFps), truth, k);
    const double diameter = 2.0 * std::sqrt(region.area / kPi);
    points.push_back({1, false, k, k / kFps, region.centroid, problem.camera.fx * problem.solids[1].mass.extent / diameter, 0.12});
    worst = std::max(worst, (region.centroid - problem.camera.project(truth)).norm());
  }
  EXPECT_GT(worst, 1.0);  // the centroid is not the centre
  points[7].depth *= 1.1;  // a region of another size
  const auto pose = [&](const PointObservation& p, Vec3& center, Quat& q) {
    center = 1.05 * truth;  // not well known
    q = turn(p.time);
    return true;
  };
  const std::vector<PointObservation> found = centered(points, problem, makers, pose);
  EXPECT_EQ(found.size(), 19u);
  for (const PointObservation& p : found) {
    EXPECT_LT((p.pixel - problem.camera.project(truth)).norm(), 0.5) << p.frame;
    EXPECT_NEAR(p.depth / truth.z(), 1.0, 0.01) << p.frame;
  }
}

TEST(Centering, ABallsOutlineIsAnEllipseFartherOut) {
  Body ball;
  ball.shape = Shape::sphere;
  ball.radius = 0.2;
  const Vec3 center(0.7, 0.3, 1.3);
  const Camera c = camera().camera;
  double count = 0.0;
  Vec2 sum = Vec2::Zero();
  for (int v = 0; v < 1200; ++v)  // pixels whose rays meet the ball
    for (int u = 0; u < 1800; ++u) {
      const Vec3 ray = c.unproject(u, v, 1.0).normalized();
      if (center.squaredNorm() - std::pow(center.dot(ray), 2) > ball.radius * ball.radius) continue;
      count += 1.0;
      sum += Vec2(u, v);
    }
  const Figure figure = FigureMaker(ball, "shot").at(Quat::Identity(), center, c);
  EXPECT_LT((figure.centroid - sum / count).norm(), 0.05);
  EXPECT_NEAR(figure.area / count, 1.0, 2e-3);
}

}  // namespace
}  // namespace unseen::collision::test
