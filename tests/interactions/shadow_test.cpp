// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/matching/shadow.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <optional>

#include "unseen/core/random.h"

namespace unseen::interactions {
namespace {

struct Case {
  OrientedBox box;
  Vec3 camera;
};

Case random_case(Random& random) {
  Case c;
  c.box.center = Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(0, 1));
  c.box.axes = Eigen::AngleAxisd(random.uniform(-kPi, kPi), random.direction()).toRotationMatrix();
  c.box.half_size = Vec3(random.uniform(0.02, 0.6), random.uniform(0.02, 0.6), random.uniform(0.02, 0.6));
  do c.camera = c.box.center + random.uniform(1, 5) * random.direction();
  while (c.box.contains(c.camera));
  return c;
}

/// Ray casting: the shares of the segment from the camera to the point between which it is in the box.
std::optional<std::pair<double, double>> cast(const OrientedBox& box, const Vec3& camera, const Vec3& point) {
  const Vec3 from = box.axes.transpose() * (camera - box.center), along = box.axes.transpose() * (point - camera);
  double in = 0, out = 1;
  for (int i = 0; i < 3; ++i) {
    const double a = (-box.half_size[i] - from[i]) / along[i], b = (box.half_size[i] - from[i]) / along[i];
    in = std::max(in, std::min(a, b));
    out = std::min(out, std::max(a, b));
  }
  if (in >= out) return std::nullopt;
  return std::pair(in, out);
}

bool hidden(const Case& c, const Vec3& point) { return cast(c.box, c.camera, point).has_value(); }

/// Distance to what the box hides, by search over the rays through its surface.
double distance_by_search(const Case& c, const Vec3& point) {
  const auto to_ray = [&](int axis, double sign, double u, double v) {  // beyond a point of a face
    Vec3 local = sign * c.box.half_size[axis] * Vec3::Unit(axis);
    local[(axis + 1) % 3] = u * c.box.half_size[(axis + 1) % 3];
    local[(axis + 2) % 3] = v * c.box.half_size[(axis + 2) % 3];
    const Vec3 start = c.box.axes * local + c.box.center, along = (start - c.camera).normalized();
    return (start + std::max(0.0, along.dot(point - start)) * along - point).norm();
  };
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      double best_u = 0, best_v = 0, best = std::numeric_limits<double>::infinity();
      for (double width = 1; width > 1e-5; width *= 0.5) {  // a finer grid around the best of a coarse one
        const double at_u = best_u, at_v = best_v;
        for (int i = -8; i <= 8; ++i)
          for (int j = -8; j <= 8; ++j) {
            const double u = std::clamp(at_u + i * width / 8, -1.0, 1.0), v = std::clamp(at_v + j * width / 8, -1.0, 1.0);
            if (const double d = to_ray(axis, sign, u, v); d < best) best = d, best_u = u, best_v = v;
          }
      }
      least = std::min(least, best);
    }
  return least;
}

Vec3 random_point(Random& random, const Case& c) {
  // Half of them on rays through the box, so that many are hidden.
  if (random.uniform() < 0.5) return c.box.center + 2.5 * random.uniform() * random.direction();
  return c.camera + random.uniform(0.3, 3) * (c.box.center + 0.6 * random.uniform() * random.direction() - c.camera);
}

TEST(Shadow, HidesWhatRayCastingSaysIsHidden) {
  Random random(1);
  int behind = 0, free = 0;
  for (int i = 0; i < 2000; ++i) {
    const Case c = random_case(random);
    const Shadow shadow(c.box, c.camera);
    for (int k = 0; k < 20; ++k) {
      const Vec3 point = random_point(random, c);
      const double d = shadow.distance(point);
      if (std::abs(d) < 1e-9) continue;
      ASSERT_EQ(d < 0, hidden(c, point)) << "case " << i << ", distance " << d;
      ++(d < 0 ? behind : free);
    }
  }
  EXPECT_GT(behind, 5000);
  EXPECT_GT(free, 5000);
}

TEST(Shadow, DistanceIsThatOfASearchWhereAFaceIsNearest) {
  Random random(2);
  int faces = 0;
  for (int i = 0; i < 400; ++i) {
    const Case c = random_case(random);
    const Shadow shadow(c.box, c.camera);
    const Vec3 point = random_point(random, c);
    Vec3 normal;
    const double d = shadow.distance(point, &normal);
    if (d < 0.01) continue;
    const double searched = distance_by_search(c, point);
    EXPECT_LT(d, searched + 1e-3) << "case " << i;  // planes are never farther than what they bound
    if (shadow.distance(point - d * normal) > 1e-9) continue;  // an edge is nearer than any point of the plane
    EXPECT_NEAR(d, searched, 2e-3) << "case " << i;
    ++faces;
  }
  EXPECT_GT(faces, 40);
}

TEST(Shadow, DepthIsTheWayOutOfHiding) {
  Random random(3);
  int tried = 0;
  for (int i = 0; i < 400; ++i) {
    const Case c = random_case(random);
    const Shadow shadow(c.box, c.camera);
    const Vec3 point = random_point(random, c);
    Vec3 normal;
    const double d = shadow.distance(point, &normal);
    if (d > -1e-3) continue;
    ++tried;
    for (int k = 0; k < 30; ++k) EXPECT_TRUE(hidden(c, point + 0.999 * -d * random.direction()));
    EXPECT_FALSE(hidden(c, point + 1.001 * -d * normal));
  }
  EXPECT_GT(tried, 80);
}

TEST(Shadow, GradientsAreThoseOfFiniteDifferences) {
  Random random(4);
  constexpr double kStep = 1e-6;
  int tried = 0, edges = 0;
  for (int i = 0; i < 1000; ++i) {
    std::vector<Shadow> shadows;
    Case c;
    for (int k = 0; k < 3; ++k) {
      const Vec3 camera = c.camera;
      c = random_case(random);
      if (k > 0) c.camera = camera;
      if (c.box.contains(c.camera)) c.box.center += Vec3(0, 3, 0);
      shadows.emplace_back(c.box, c.camera);
    }
    const Vec3 point = random_point(random, c);
    const double confidence = random.uniform(0, 0.7);
    const auto numeric = [&](const auto& f, bool& edge) {
      Vec3 g;
      const double middle = f(point);
      for (int d = 0; d < 3; ++d) {
        const double up = f(point + kStep * Vec3::Unit(d)), down = f(point - kStep * Vec3::Unit(d));
        g[d] = (up - down) / (2 * kStep);
        edge = edge || std::abs(up + down - 2 * middle) / kStep > 1e-4;
      }
      return g;
    };
    Vec3 of_distance, of_cost;
    shadows[0].distance(point, &of_distance);
    occlusion_cost(point, confidence, shadows, &of_cost);
    bool edge = false;
    const Vec3 distance_numeric = numeric([&](const Vec3& p) { return shadows[0].distance(p); }, edge);
    const Vec3 cost_numeric = numeric([&](const Vec3& p) { return occlusion_cost(p, confidence, shadows); }, edge);
    edges += edge;
    if (edge) continue;
    EXPECT_NEAR((of_distance - distance_numeric).norm(), 0, 1e-8) << i;
    EXPECT_NEAR((of_cost - cost_numeric).norm(), 0, 1e-8) << i;
    tried += of_cost.norm() > 0;
  }
  EXPECT_LT(edges, 10);
  EXPECT_GT(tried, 200);
}

TEST(OcclusionCost, IsOfTheNearestShadowAndAtMostThatOfOneMetre) {
  const Shadow near({{0, 2, 0}, Mat3::Identity(), {1, 0.5, 1}}, Vec3(0, 0, 0)), far({{0, 4, 30}, Mat3::Identity(), {1, 0.5, 1}}, Vec3(0, 0, 0));
  const std::vector<Shadow> both = {far, near};
  EXPECT_EQ(occlusion_cost({0, 3, 0}, 0.1, both), 0);  // behind the box
  EXPECT_NEAR(occlusion_cost({0, 1.2, 0}, 0.1, both), 0.16 * 0.09, 1e-12);  // 0.3 m before it
  EXPECT_EQ(occlusion_cost({0, 1.2, 0}, 0.5, both), 0);
  EXPECT_NEAR(occlusion_cost({0, -20, 0}, 0.1, both), 0.16, 1e-12);
  EXPECT_NEAR(occlusion_cost({0, 1.2, 0}, 0.1, {}), 0.16, 1e-12);
}

TEST(Shadow, OfABoxWithTheCameraInsideHidesEverything) {
  const Shadow shadow({{0, 0, 1}, Mat3::Identity(), {1, 1, 1}}, Vec3(0, 0, 1));
  EXPECT_LT(shadow.distance({5, 5, 5}), 0);
  Vec3 gradient;
  EXPECT_EQ(occlusion_cost({5, 5, 5}, 0, {shadow}, &gradient), 0);
  EXPECT_EQ(gradient.norm(), 0);
}

}  // namespace
}  // namespace unseen::interactions
