// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <gtest/gtest.h>

#include "cuboids/boxes/picture_registration.h"
#include "perception_scenes.h"

namespace unseen::cuboids::test {
namespace {

TEST(ImageEdges, WinBackWhatTheSensorDropped) {
  Scene scene;
  scene.dropout = 5;
  scene.boxes = {upright(-0.15, 0.75, 0, {0.2, 0.12, 0.15}, 15), upright(0.15, 0.75, 0, {0.1, 0.15, 0.12}, 30)};
  const Perceived p = perceive(render(scene));
  ASSERT_EQ(p.fitted.size(), 2u);
  double before = 0, after = 0;
  for (const OrientedBox& truth : scene.boxes) {
    before = std::max(before, size_error(nearest(p.fitted, truth.center).box, truth));
    after = std::max(after, size_error(nearest(p.cuboids, truth.center).box, truth));
  }
  EXPECT_GT(before, 0.006);
  EXPECT_LT(after, 0.005);
  Options options;
  options.image_edges = false;
  const Perceived off = perceive(render(scene), options);
  EXPECT_EQ(off.cuboids[0].box.half_size, off.fitted[0].box.half_size);
}

/// Squeezed about the middle, as by a camera of another aspect; depth stays as it is.
RgbdFrame squeezed(RgbdFrame frame, double across, double down) {
  const auto color = frame.color;
  const int w = frame.camera.width, h = frame.camera.height;
  for (int v = 0; v < h; ++v)
    for (int u = 0; u < w; ++u) {
      const long x = std::clamp(std::lround(frame.camera.cx + (u - frame.camera.cx) / across), 0L, w - 1L);
      const long y = std::clamp(std::lround(frame.camera.cy + (v - frame.camera.cy) / down), 0L, h - 1L);
      frame.color[static_cast<std::size_t>(v) * w + u] = color[static_cast<std::size_t>(y) * w + x];
    }
  return frame;
}

Scene two_apart() {
  Scene scene;
  scene.boxes = {upright(-0.2, 0.75, 0, {0.2, 0.12, 0.15}, 15), upright(0.2, 0.75, 0, {0.1, 0.15, 0.12}, 30)};
  return scene;
}

TEST(ImageEdges, TellTheScaleOfThePicture) {
  const Scene scene = two_apart();
  const RgbdFrame frame = render(scene);
  const DepthView view(frame, camera_of(scene), depth_noise(frame, {}));
  std::vector<Vec2> creases, all;
  for (const OrientedBox& box : scene.boxes)
    for (const EdgeSample& sample : visible_edge_samples(box, frame, camera_of(scene), view)) {
      all.push_back(frame.camera.project(camera_of(scene).inverse() * (box.center + box.axes * local_point(sample, -box.half_size, box.half_size))));
      if (sample.crease) creases.push_back(all.back());
    }
  for (const auto& [across, down] : {std::pair{1.0, 1.0}, {0.93, 1.0}, {0.95, 0.93}}) {
    const PictureRegistration r = register_picture(ImageEdges(squeezed(frame, across, down)), creases, all, {frame.camera.cx, frame.camera.cy});
    EXPECT_NEAR(r.scale.x(), across, 0.01);
    EXPECT_NEAR(r.scale.y(), down, 0.01);
    EXPECT_LT(r.shift.norm(), 1.5);
    EXPECT_LT((r.to_depth(r.to_picture(all.front())) - all.front()).norm(), 1e-9);
  }
}

/// Pixels along the outline of a rectangle.
std::vector<Vec2> outline_of(const Vec2& low, const Vec2& high) {
  std::vector<Vec2> pixels;
  for (double x = low.x(); x <= high.x(); x += 5.0) pixels.emplace_back(x, low.y()), pixels.emplace_back(x, high.y());
  for (double y = low.y(); y <= high.y(); y += 5.0) pixels.emplace_back(low.x(), y), pixels.emplace_back(high.x(), y);
  return pixels;
}

/// Light things on dark ground, of which the picture shows the first few, and the pixels of the edges of all: farther out than there, as in a picture of that scale.
struct FourThings {
  FourThings(int shown, double scale) {
    frame.camera = {525, 525, 319.5, 239.5, 640, 480};
    frame.color.assign(640 * 480, {60, 60, 60});
    const std::array<Vec2, 4> corners{Vec2(30, 20), Vec2(350, 20), Vec2(30, 260), Vec2(350, 260)};
    for (int i = 0; i < 4; ++i) {
      const Vec2 low = corners[i], high = low + Vec2(260, 200);
      for (int v = static_cast<int>(low.y()); i < shown && v < high.y(); ++v)
        for (int u = static_cast<int>(low.x()); u < high.x(); ++u) frame.color[640 * v + u] = {200, 200, 200};
      for (const Vec2& p : outline_of(low, high)) edges.push_back(center() + (p - center()) / scale);
    }
  }
  Vec2 center() const { return {frame.camera.cx, frame.camera.cy}; }
  Vec2 scale() const { return register_picture(ImageEdges(frame), edges, edges, center()).scale; }
  RgbdFrame frame;
  std::vector<Vec2> edges;
};

TEST(ImageEdges, OfOneThingDoNotScaleThePicture) {  // the others show no edges
  EXPECT_EQ(FourThings(1, 0.95).scale(), Vec2(1.0, 1.0));
  FourThings alone(1, 0.95);
  alone.edges.resize(alone.edges.size() / 4);
  EXPECT_NEAR(alone.scale().x(), 0.95, 0.005);  // where it is all there is
  EXPECT_NEAR(FourThings(4, 0.95).scale().x(), 0.95, 0.005);
}

TEST(ImageEdges, ThatAreAPixelOffDoNotScaleThePicture) { EXPECT_EQ(FourThings(4, 0.995).scale(), Vec2(1.0, 1.0)); }

TEST(ImageEdges, WinBackInAPictureOfAnotherScaleToo) {
  Scene scene = two_apart();
  scene.dropout = 2;
  const Perceived p = perceive(squeezed(render(scene), 0.93, 1.0));
  ASSERT_EQ(p.fitted.size(), 2u);
  for (const OrientedBox& truth : scene.boxes) {
    EXPECT_GT(size_error(nearest(p.fitted, truth.center).box, truth), 0.004);
    EXPECT_LT(size_error(nearest(p.cuboids, truth.center).box, truth), 0.003);
  }
}

/// Depth says that the box is higher than the picture has it; it stays so, but the picture's word on the outline counts.
TEST(ImageEdges, WinBackTheOutlineWhereThePictureDeniesAFace) {
  Scene measured, photographed;
  measured.height = 0.9;
  measured.pitch = radians(70.0);
  photographed = measured;
  measured.boxes = {upright(0, 0.3, 0, {0.175, 0.089, 0.044}, 25)};
  photographed.boxes = {upright(0, 0.3, 0, {0.175, 0.089, 0.038}, 25)};
  RgbdFrame frame = render(measured);
  frame.color = render(photographed).color;
  const Perceived p = perceive(frame);
  const DepthView view(frame, p.seen.T_world_camera, depth_noise(frame, {}));
  std::vector<Cuboid> cuboids = p.fitted;
  ASSERT_EQ(cuboids.size(), 1u);
  const Vec3 moved(-0.004, 0.004, 0.0);  // of the sides that look away
  cuboids[0].box.half_size += moved;
  cuboids[0].box.center += cuboids[0].box.axes * moved;
  Context context;
  align_to_image_edges(frame, p.seen, view, cuboids, {}, context);
  EXPECT_LT(size_error(cuboids[0].box, measured.boxes[0]), 0.003) << 2000.0 * cuboids[0].box.half_size.transpose();
}

/// The picture shows a rim around the box, a shadow say, but depth saw the ground there.
TEST(ImageEdges, DoNotPullABoxIntoFreeSpace) {
  constexpr int kRim = 6;  // pixels
  Scene scene;
  scene.height = 1.2;
  scene.pitch = radians(80.0);
  scene.noise = 0.0006;
  scene.boxes = {upright(0.0, 0.2, 0, {0.2, 0.15, 0.3}, 10)};
  RgbdFrame frame = render(scene);
  const auto color = frame.color;
  for (int v = kRim; v + kRim < scene.image_height; ++v)
    for (int u = kRim; u + kRim < scene.width; ++u)
      for (int dv = -kRim; dv <= kRim; ++dv)
        for (int du = -kRim; du <= kRim; ++du)
          if (const std::size_t i = static_cast<std::size_t>(v) * scene.width + u, j = i + dv * scene.width + du; color[i][0] == 60 && color[j][0] != 60)
            frame.color[i] = color[j];
  const Perceived p = perceive(frame);
  ASSERT_EQ(p.cuboids.size(), 1u);
  for (int k = 0; k < 3; ++k) EXPECT_LT(p.cuboids[0].box.half_size[k], p.fitted[0].box.half_size[k] + 0.002);
}

}  // namespace
}  // namespace unseen::cuboids::test
