// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Hollow surfaces, which no box has.
#include <gtest/gtest.h>

#include "perception_scenes.h"

namespace unseen::cuboids::test {
namespace {

/// A sphere without thickness, as high as it goes: half of it is a bowl.
struct Sphere {
  Vec3 center;
  double radius, top;
};

/// Distance along a ray to a sphere, inside or outside; infinite = missed.
double hit(const Sphere& sphere, const Vec3& from, const Vec3& ray) {
  const Vec3 o = from - sphere.center;
  const double a = ray.squaredNorm(), b = o.dot(ray), c = o.squaredNorm() - sphere.radius * sphere.radius, root = b * b - a * c;
  if (root < 0.0) return std::numeric_limits<double>::infinity();
  for (const double t : {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a})
    if (t > 0.0 && (from + t * ray).z() < sphere.top) return t;
  return std::numeric_limits<double>::infinity();
}

void add(const Scene& scene, const Sphere& sphere, RgbdFrame& frame, std::uint64_t seed) {
  const RigidTransform T = camera_of(scene);
  Random random(seed);
  for (int v = 0; v < scene.image_height; ++v)
    for (int u = 0; u < scene.width; ++u) {
      const double t = hit(sphere, T.translation, T.rotation * frame.camera.unproject(u, v, 1.0));
      float& depth = frame.depth[static_cast<std::size_t>(v) * scene.width + u];
      if (std::isfinite(t)) depth = static_cast<float>(t + scene.noise * t * t * random.normal());
    }
}

std::size_t objects_in(const RgbdFrame& frame) {
  Context context;
  return find_objects(frame, observe(frame, {}, context), {}, context).size();
}

TEST(RoundThings, TheInsideOfABowlIsOnePiece) {
  for (const double radius : {0.07, 0.12}) {
    Scene scene;
    scene.pitch = radians(50.0);
    scene.height = 0.8;
    RgbdFrame frame = render(scene);
    add(scene, {{0, 0.67, radius}, radius, radius}, frame, 7);
    EXPECT_EQ(objects_in(frame), 2u) << radius;  // the inside, and the outside in front of it
  }
}

TEST(RoundThings, ABallIsPartedFromTheShelfThatCarriesIt) {  // which alone is a box, and most of what was seen
  Scene scene;
  scene.height = 1.2;
  scene.pitch = radians(20.0);
  scene.boxes = {upright(0, 2.0, 0, {0.9, 0.35, 0.3}, 5)};
  RgbdFrame frame = render(scene);
  add(scene, {{-0.2, 2.0, 0.56}, 0.26, 1.0}, frame, 7);
  Context context;
  const Observation seen = observe(frame, {}, context);
  ObjectPart both;
  for (const ObjectPart& part : find_objects(frame, seen, {}, context)) both.points.insert(both.points.end(), part.points.begin(), part.points.end());
  std::sort(both.points.begin(), both.points.end());
  const DepthView view(frame, seen.T_world_camera, depth_noise(frame, {}));
  const std::vector<ObjectPart> parts = cut_parts(seen, view, {both}, context);
  const std::vector<Cuboid> cuboids = fit_cuboids(frame, seen, parts, view, {}, context);
  EXPECT_LT(size_error(nearest(cuboids, scene.boxes[0].center).box, scene.boxes[0]), 0.03) << parts.size();
}

TEST(RoundThings, ABluntCreaseBetweenBoxesDividesThem) {
  for (const double angle : {35.0, 45.0, 55.0}) {  // between the normals of a block's side and of the board before it
    Scene scene;
    const double lean = radians(angle);
    OrientedBox board = upright(0, 0, 0, {0.2, 0.15, 0.02}, 0);
    board.axes = Eigen::AngleAxisd(kPi / 2 - lean, Vec3::UnitX()).toRotationMatrix() * board.axes;
    // Its upper edge touches the block's side.
    board.center = Vec3(0, 0.8, 0.12) - board.axes * Vec3(0, 0.075, 0.01);
    scene.boxes = {upright(0.0, 0.85, 0, {0.24, 0.1, 0.24}, 0), board};
    EXPECT_EQ(objects_in(render(scene)), 2u) << angle;
  }
}

}  // namespace
}  // namespace unseen::cuboids::test
