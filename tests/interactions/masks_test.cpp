// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/layout/masks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace unseen::interactions {
namespace {

/// Level, 1 m above the floor.
View small_level_view() { return view_of({100, 100, 50, 50, 100, 100}, {1.0, 0, 0, "given"}); }

/// A box of 1 x 1 m towards the camera and 2 mm thick, 4 m ahead: its front is 25 px wide and high about the picture's middle.
FoundObject board(double confidence) {
  Object board{0, "chair", {{"seat", {{0, 4.001, 1}, Mat3::Identity(), {0.5, 0.001, 0.5}}}}};
  return {board, confidence, {}};
}

Mask half_plane(const std::string& category, int first_column) {
  Mask mask{category, 100, 100, std::vector<std::uint8_t>(10'000, 0)};
  for (std::size_t y = 0; y < 100; ++y)
    for (std::size_t x = static_cast<std::size_t>(first_column); x < 100; ++x) mask.inside[y * 100 + x] = 255;
  return mask;
}

double after(double confidence, const std::vector<Mask>& masks, const View& view = small_level_view()) {
  std::vector<FoundObject> objects = {board(confidence)};
  heed_masks(objects, masks, view);
  return objects[0].confidence;
}

TEST(Masks, ShareIsThatOfTheOutlineInThePicture) {
  const FoundObject found = board(0.5);
  // Its columns are those from 37.5 to 62.5: 38 to 62, 25 of them.
  for (const auto& [first, columns] : {std::pair{0, 25}, {38, 25}, {43, 20}, {50, 13}, {62, 1}, {63, 0}})
    EXPECT_DOUBLE_EQ(share_in_masks(found.object, std::vector{half_plane("chair", first)}, small_level_view()).value(), columns / 25.0) << first;
}

TEST(Masks, OfOneSuperclassAddUp) {
  std::vector<Mask> masks = {half_plane("couch", 56), half_plane("stool", 50)};
  for (std::size_t i = 0; i < masks[0].inside.size(); ++i) masks[0].inside[i] = masks[0].inside[i] ? 0 : 1;  // columns up to 55
  EXPECT_DOUBLE_EQ(share_in_masks(board(0.5).object, masks, small_level_view()).value(), 1.0);
}

TEST(Masks, MultiplyTheOdds) {
  EXPECT_NEAR(after(0.5, {half_plane("chair", 0)}), 1 / (1 + std::exp(-4 * 0.7)), 1e-12);
  EXPECT_NEAR(after(0.5, {half_plane("chair", 80)}), 1 / (1 + std::exp(4 * 0.3)), 1e-12);
  EXPECT_LT(after(1.0, {half_plane("chair", 80)}), 0.95);  // even of what seems certain
}

TEST(Masks, OfOtherSuperclassesSayNothing) {
  EXPECT_EQ(after(0.5, {}), 0.5);
  EXPECT_EQ(after(0.5, {half_plane("table", 0), half_plane("cat", 0)}), 0.5);
}

TEST(Masks, SayNothingOfWhatTheCameraDoesNotSee) {
  View away = small_level_view();
  away.T_world_camera.rotation = Eigen::AngleAxisd(kPi, Vec3::UnitZ()) * away.T_world_camera.rotation;
  EXPECT_EQ(after(0.5, {half_plane("chair", 0)}, away), 0.5);
  away.T_world_camera.rotation = Eigen::AngleAxisd(kPi / 3, Vec3::UnitZ()) * small_level_view().T_world_camera.rotation;  // in front, beside the picture
  EXPECT_EQ(after(0.5, {half_plane("chair", 0)}, away), 0.5);
}

}  // namespace
}  // namespace unseen::interactions
