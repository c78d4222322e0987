// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/cuboids/photo_edit.h"

#include <gtest/gtest.h>

#include "cuboids/applications/inpaint.h"
#include "cuboids/photo_fixture.h"
#include "unseen/core/error.h"

namespace unseen::cuboids {
namespace {

using namespace photo_fixture;

EditedPhoto edit(const Picture& picture, const Completion& scene, const std::vector<PhotoEdit>& edits, int threads = 0) {
  Context context;
  context.threads = threads;
  return edit_photo(picture.frame, scene, edits, {}, context);
}

PhotoEdit move(int id, const Vec3& by, double turn = 0.0) {
  return {id, false, by, turn};
}
PhotoEdit remove(int id) {
  return {id, true, Vec3::Zero(), 0.0};
}

double overlap(const EditedPhoto& edited, int id, const Picture& truth, int box) {
  double both = 0, any = 0;
  for (std::size_t i = 0; i < truth.box.size(); ++i) {
    const bool shown = edited.shown[i] == id, expected = truth.box[i] == box;
    both += shown && expected;
    any += shown || expected;
  }
  return both / any;
}

TEST(Inpaint, ContinuesARegularPattern) {
  HoledPicture picture;
  picture.width = picture.height = 120;
  std::vector<Color> truth;
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 120; ++x) {
      const auto wave = static_cast<std::uint8_t>(std::lround(128 + 60 * std::sin(0.4 * x) + 40 * std::sin(0.3 * y)));
      truth.push_back({wave, static_cast<std::uint8_t>(255 - wave), 90});
      picture.hole.push_back(std::abs(x - 60) < 20 && std::abs(y - 55) < 16);
    }
  picture.pixels = truth;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (picture.hole[i]) picture.pixels[i] = {255, 0, 255};  // must not matter
  Context context;
  const std::vector<Color> filled = inpaint(picture, 1, context);
  EXPECT_GT(psnr(filled, truth, [&](std::size_t i) { return picture.hole[i] != 0; }), 25.0);
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (!picture.hole[i]) {
      ASSERT_EQ(filled[i], truth[i]);
    }
  EXPECT_EQ(filled, inpaint(picture, 1, context));
}

TEST(Inpaint, TakesPatchesOfTheSurfaceThatTheGuideNames) {
  HoledPicture picture;  // red on the left, blue on the right; the hole shows what is on the left, but lies on the right
  picture.width = picture.height = 80;
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x) {
      picture.pixels.push_back(x < 40 ? Color{150, 100, 100} : Color{100, 100, 150});
      const bool hole = std::abs(x - 60) < 9 && std::abs(y - 40) < 9;
      picture.hole.push_back(hole);
      picture.guide.push_back(x < 40 || hole ? 0 : 1);
    }
  Context context;
  EXPECT_GT(inpaint(picture, 1, context)[picture.at(60, 40)][0], 145);
  picture.guide.clear();
  EXPECT_LT(inpaint(picture, 1, context)[picture.at(60, 40)][0], 105);
}

TEST(Inpaint, FillsSmoothlyWhatHasNoSources) {
  HoledPicture picture;
  picture.width = picture.height = 9;
  picture.pixels.assign(81, {100, 100, 100});
  picture.hole.assign(81, 0);
  picture.hole[picture.at(4, 4)] = 1;
  picture.pixels[picture.at(4, 4)] = {0, 255, 0};
  Context context;
  EXPECT_EQ(inpaint(picture, 1, context)[picture.at(4, 4)], (Color{100, 100, 100}));
}

TEST(PhotoEdit, RemovingShowsTheGroundBehind) {
  const std::vector<OrientedBox> boxes = {box_at({0.05, 0.05, 0}, {0.24, 0.2, 0.3}, 0.4), box_at({-0.55, 0.1, 0}, {0.2, 0.2, 0.2})};
  const Picture picture = render(boxes), background = render({boxes[1]});
  const EditedPhoto edited = edit(picture, scene_of(boxes), {remove(1)});
  std::size_t holes = 0;
  for (std::size_t i = 0; i < picture.box.size(); ++i) {
    holes += edited.hole[i];
    if (picture.box[i] == 0) {
      ASSERT_TRUE(edited.hole[i]);
    }
    if (!edited.hole[i]) {
      ASSERT_EQ(edited.pixels[i], picture.frame.color[i]);
    }
    ASSERT_EQ(edited.shown[i], -1);
    ASSERT_EQ(edited.shadow[i], 0.0f);
  }
  const auto in_hole = [&](std::size_t i) { return edited.hole[i] != 0; };
  EXPECT_GT(psnr(edited.pixels, background.frame.color, in_hole), 22.0);  // one colour for all: 15
  EXPECT_LT(holes, 1.25 * std::count(picture.box.begin(), picture.box.end(), 0));
}

TEST(PhotoEdit, MovingPutsItWhereTheCameraModelSays) {
  const OrientedBox box = box_at({-0.1, 0, 0}, {0.2, 0.16, 0.24}, 0.3);
  for (const PhotoEdit& change : {move(1, {0.3, 0.1, 0}), move(1, {0.15, -0.2, 0.05}, radians(12)), move(1, {0, 0, 0})}) {
    OrientedBox moved = box;
    moved.axes = Eigen::AngleAxisd(change.turn, Vec3::UnitZ()) * box.axes;
    moved.center += change.move;
    const Picture picture = render({box}), truth = render({moved});
    const EditedPhoto edited = edit(picture, scene_of({box}), {change});
    EXPECT_GT(overlap(edited, 1, truth, 0), 0.97);
    // Faces that the photograph showed; their colours, but for the rim, where pixels are mixed.
    const auto inner = [&](std::size_t i) {
      const int x = static_cast<int>(i % kWidth), y = static_cast<int>(i / kWidth);
      if (x < 2 || y < 2 || x >= kWidth - 2 || y >= kHeight - 2) return false;
      for (const int j : {0, -2, 2, -2 * kWidth, 2 * kWidth})
        if (truth.box[i + j] != 0) return false;
      const Vec3 p = pose() * kCamera.unproject(x, y, truth.frame.depth[i]);
      const Vec3 local = moved.axes.transpose() * (p - moved.center);
      int axis = 0;
      (local.cwiseAbs() - moved.half_size).maxCoeff(&axis);
      for (int k = 0; k < 3; ++k)  // not at its edges
        if (k != axis && std::abs(local[k]) > moved.half_size[k] - 0.01) return false;
      const Vec3 normal = box.axes.col(axis) * (local[axis] > 0 ? 1.0 : -1.0);
      return normal.dot(pose().translation - (box.center + box.axes * local)) > 0.05;
    };
    EXPECT_GT(psnr(edited.pixels, truth.frame.color, inner), 24.0);
  }
}

TEST(PhotoEdit, WhatStandsInFrontStaysAsItIs) {
  const std::vector<OrientedBox> boxes = {box_at({-0.4, 0.15, 0}, {0.2, 0.16, 0.2}), box_at({0.2, -0.15, 0}, {0.25, 0.15, 0.3})};
  const Picture picture = render(boxes);
  const Vec3 by(0.6, 0.0, 0.0);
  std::vector<OrientedBox> after = boxes;
  after[0].center += by;
  const Picture truth = render(after);
  const EditedPhoto edited = edit(picture, scene_of(boxes), {move(1, by)});
  EXPECT_GT(overlap(edited, 1, truth, 0), 0.93);
  std::size_t front = 0, shaded = 0;
  for (std::size_t i = 0; i < truth.box.size(); ++i)
    if (truth.box[i] == 1) {
      ++front;
      shaded += edited.pixels[i] != picture.frame.color[i];
      if (edited.shadow[i] == 0.0f && edited.shown[i] < 0) {
        ASSERT_EQ(edited.pixels[i], picture.frame.color[i]);
      }
    }
  EXPECT_LT(shaded, front / 3);
}

TEST(PhotoEdit, FixedCuboidsMoveAsOneBody) {
  const std::vector<OrientedBox> boxes = {box_at({-0.2, 0, 0}, {0.2, 0.2, 0.1}), box_at({-0.2, 0, 0.1}, {0.05, 0.05, 0.2})};
  Completion scene = scene_of(boxes);
  Contact contact;
  contact.a = 1;
  contact.b = 2;
  contact.kind = ContactKind::fixed;
  scene.contacts.push_back(contact);
  const Vec3 by(0.35, 0.05, 0);
  std::vector<OrientedBox> after = boxes;
  for (OrientedBox& box : after) box.center += by;
  const Picture truth = render(after);
  const EditedPhoto edited = edit(render(boxes), scene, {move(1, by)});
  EXPECT_GT(overlap(edited, 1, truth, 0), 0.93);
  EXPECT_GT(overlap(edited, 2, truth, 1), 0.9);
  Context context;
  EXPECT_THROW(edit_photo(render(boxes).frame, scene, {move(1, by), remove(2)}, {}, context), InputError);
}

TEST(PhotoEdit, SaysWhatLosesItsSupport) {
  const std::vector<OrientedBox> boxes = {box_at({0, 0, 0}, {0.2, 0.2, 0.1}), box_at({0, 0, 0.1}, {0.1, 0.1, 0.1})};
  Completion scene = scene_of(boxes);
  Contact contact;
  contact.a = 1;
  contact.b = 2;
  scene.contacts.push_back(contact);
  Context context;
  edit_photo(render(boxes).frame, scene, {remove(1)}, {}, context);
  EXPECT_EQ(context.take_warnings().size(), 1u);
  edit_photo(render(boxes).frame, scene, {remove(2)}, {}, context);
  edit_photo(render(boxes).frame, scene, {remove(1), remove(2)}, {}, context);
  EXPECT_TRUE(context.take_warnings().empty());
}

TEST(PhotoEdit, ShadowIsTheShareOfTheLightThatIsHidden) {
  // A slab of 0.8 m, 0.2 m above the ground: the light, seen under 60°, reaches 0.2·tan 30° = 0.115 m sideways. Under
  // its middle it is dark; under its edge half of the light is hidden; 0.3 m away none is.
  const OrientedBox slab = box_at({0, 1.4, 0.02}, {0.8, 0.8, 0.02});
  const Picture picture = render({slab});
  const EditedPhoto edited = edit(picture, scene_of({slab}), {move(1, {0, -1.2, 0.18})});
  const auto shadow_at = [&](const Vec3& p) {
    const Vec2 place = kCamera.project(pose().inverse() * p);
    return edited.shadow[std::lround(place.y()) * kWidth + std::lround(place.x())];
  };
  EXPECT_NEAR(shadow_at({0.0, -0.2, 0.0}), 0.5, 0.08);
  EXPECT_EQ(shadow_at({0.0, -0.5, 0.0}), 0.0f);
  EXPECT_EQ(shadow_at({0.75, -0.1, 0.0}), 0.0f);
}

TEST(PhotoEdit, IsTheSameAtAnyThreadCount) {
  const OrientedBox box = box_at({-0.1, 0, 0}, {0.2, 0.16, 0.24}, 0.3);
  const Picture picture = render({box});
  const EditedPhoto one = edit(picture, scene_of({box}), {move(1, {0.3, 0, 0}, 0.5)}, 1);
  for (const int threads : {2, 4})
    EXPECT_EQ(edit(picture, scene_of({box}), {move(1, {0.3, 0, 0}, 0.5)}, threads).pixels, one.pixels);
}

TEST(PhotoEdit, RefusesWhatCannotBeEdited) {
  const OrientedBox box = box_at({0, 0, 0}, {0.2, 0.2, 0.2});
  Picture picture = render({box});
  EXPECT_THROW(edit(picture, scene_of({box}), {remove(0)}), InputError);  // a support
  EXPECT_THROW(edit(picture, scene_of({box}), {remove(7)}), InputError);
  EXPECT_THROW(edit(picture, scene_of({box}), {remove(1), move(1, {0, 0, 0})}), InputError);
  EXPECT_THROW(edit(picture, scene_of({box}), {move(1, {std::nan(""), 0, 0})}), InputError);
  picture.frame.color.clear();
  EXPECT_THROW(edit(picture, scene_of({box}), {remove(1)}), InputError);
  picture.frame.camera.width = 0;
  EXPECT_THROW(edit(picture, scene_of({box}), {remove(1)}), InputError);
}

}  // namespace
}  // namespace unseen::cuboids
