// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/orientations/silhouette.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "collision/orientations/symmetry.h"
#include "collision/orientations/views.h"
#include "collision/solve/contact.h"
#include "unseen/core/random.h"

namespace unseen::collision {
namespace {

const Camera kCamera{800, 800, 319.5, 239.5, 640, 480};

Eigen::Matrix3Xd box_corners(const Vec3& edges) {
  Eigen::Matrix3Xd corners(3, 8);
  for (int i = 0; i < 8; ++i) corners.col(i) = 0.5 * Vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).cwiseProduct(edges);
  return corners;
}

std::vector<Vec3> columns(const Eigen::Matrix3Xd& m) {
  std::vector<Vec3> all;
  for (Eigen::Index i = 0; i < m.cols(); ++i) all.push_back(m.col(i));
  return all;
}

Quat random_turn(Random& random) { return Quat(Eigen::AngleAxisd(random.uniform(0, 2 * kPi), random.direction())); }

/// Whether the ray through a pixel meets the box: slabs, in the box's own axes.
bool hits(const Vec3& edges, const Quat& q, const Vec3& center, double u, double v) {
  const Vec3 from = q.conjugate() * Vec3(-center), ray = q.conjugate() * kCamera.unproject(u, v, 1.0);
  double enter = 0, leave = 1e9;
  for (int i = 0; i < 3; ++i) {
    const double a = (-0.5 * edges[i] - from[i]) / ray[i], b = (0.5 * edges[i] - from[i]) / ray[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave;
}

TEST(Silhouette, SupportOfAProjectedBoxIsThatOfItsRayCastMask) {
  Random random(3);
  const Vec3 edges(0.2, 0.12, 0.08);
  for (int trial = 0; trial < 8; ++trial) {
    const Quat q = random_turn(random);
    const Vec3 center(random.uniform(-0.2, 0.2), random.uniform(-0.1, 0.1), 1.2);
    cv::Mat mask(kCamera.height, kCamera.width, CV_8U);
    for (int v = 0; v < mask.rows; ++v)
      for (int u = 0; u < mask.cols; ++u) mask.at<std::uint8_t>(v, u) = hits(edges, q, center, u, v) ? 255 : 0;
    const std::vector<Vec2> outline = mask_outline(mask, 0.0);
    Eigen::Matrix2Xd seen(2, static_cast<Eigen::Index>(outline.size()));
    for (std::size_t i = 0; i < outline.size(); ++i) seen.col(static_cast<Eigen::Index>(i)) = outline[i];
    const Vec2 origin = kCamera.project(center);
    const Support expected = support_of(seen, origin), computed = support_of(projected(box_corners(edges), q, center, kCamera), origin);
    EXPECT_LT((expected - computed).cwiseAbs().maxCoeff(), 1.1) << "trial " << trial;
    EXPECT_NEAR((expected - computed).mean(), 0.0, 0.4);
    EXPECT_NEAR(polygon_area(outline) / cv::countNonZero(mask), 1.0, 0.02);
  }
}

TEST(Silhouette, SpursThinnerThanAskedForAreLeftOut) {
  cv::Mat mask = cv::Mat::zeros(100, 120, CV_8U);
  cv::rectangle(mask, {30, 30}, {69, 59}, cv::Scalar(255), cv::FILLED);
  cv::line(mask, {70, 45}, {110, 45}, cv::Scalar(255), 2);
  double right = 0;
  for (const Vec2& p : mask_outline(mask, 6.0)) right = std::max(right, p.x());
  EXPECT_NEAR(right, 69.5, 1.1);
  EXPECT_TRUE(mask_outline(cv::Mat::zeros(10, 10, CV_8U), 1.0).empty());
}

TEST(Symmetry, OfBoxesIsThatOfTheirEdges) {
  const auto count = [](const Vec3& edges) { return symmetry_of(columns(box_corners(edges))); };
  EXPECT_EQ(count({0.3, 0.2, 0.1}).turns.size(), 4U);
  EXPECT_EQ(count({0.3, 0.2, 0.1}).reflections.size(), 4U);
  EXPECT_EQ(count({0.3, 0.1, 0.1}).turns.size(), 8U);
  EXPECT_EQ(count({0.1, 0.1, 0.1}).turns.size(), 24U);
}

TEST(Symmetry, NearlyAlikeAreTurnsThatExchangeLikeEdges) {
  const auto near = [](const Vec3& edges) {
    const std::vector<Vec3> corners = columns(box_corners(edges));
    return near_turns(corners, symmetry_of(corners));
  };
  EXPECT_TRUE(near({0.3, 0.2, 0.1}).empty());
  EXPECT_TRUE(near({0.1, 0.1, 0.1}).empty());      // alike, not nearly
  EXPECT_EQ(near({0.1, 0.105, 0.11}).size(), 5U);  // 24 of a cube, four a kind, but for the box's own
  const std::vector<Quat> one = near({0.14, 0.105, 0.101});
  ASSERT_EQ(one.size(), 1U);
  EXPECT_LT((one[0] * Vec3::UnitX()).cross(Vec3::UnitX()).norm(), 0.1);  // the long edge keeps its place
  EXPECT_LT((one[0] * Vec3::UnitY()).cross(Vec3::UnitZ()).norm(), 0.1);
}

TEST(Symmetry, SidesThatOutlinesHardlyTellApart) {
  Body box;
  box.shape = Shape::box;
  const auto alike = [&](const Vec3& edges) {
    box.box = edges;
    return nearly_alike_sides(box);
  };
  EXPECT_FALSE(alike({0.3, 0.2, 0.1}));
  EXPECT_FALSE(alike({0.3, 0.1, 0.1}));
  ASSERT_TRUE(alike({0.103, 0.2, 0.1}));
  EXPECT_NEAR(*alike({0.103, 0.2, 0.1}), 0.003 / 0.103, 1e-12);
  EXPECT_NEAR(*alike({0.1, 0.102, 0.105}), 0.002 / 0.102, 1e-12);  // the likest two
  EXPECT_FALSE(nearly_alike_sides(Body()));
}

TEST(Symmetry, TurnsThatOutlinesHardlyTell) {
  const auto prism = [](double stretch) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 6; ++i) {
      const double angle = i * 2.0 * kPi / 3.0;
      corners.emplace_back(0.1 * stretch * std::cos(angle), 0.1 * std::sin(angle), i < 3 ? -0.08 : 0.08);
    }
    return corners;
  };
  ASSERT_TRUE(nearly_alike_turn(prism(1.03)));
  EXPECT_NEAR(degrees(*nearly_alike_turn(prism(1.03))), 120.0, 1.5);
  EXPECT_FALSE(nearly_alike_turn(prism(1.0)));  // alike
  EXPECT_FALSE(nearly_alike_turn(prism(1.2)));  // told
}

TEST(Symmetry, OfALopsidedBodyIsNone) {
  std::vector<Vec3> corners = columns(box_corners({0.3, 0.2, 0.1}));
  corners[0] *= 1.4;
  const Symmetry s = symmetry_of(corners);
  EXPECT_EQ(s.turns.size(), 1U);
  EXPECT_TRUE(s.reflections.empty());
}

TEST(Symmetry, MapsTheSilhouetteOntoItself) {
  Random random(5);
  const Eigen::Matrix3Xd corners = box_corners({0.25, 0.1, 0.1});
  const Quat q = random_turn(random);
  const Vec3 center(0.1, 0, 2);
  const Vec2 origin = kCamera.project(center);
  const Support one = support_of(projected(corners, q, center, kCamera), origin);
  for (const Quat& g : symmetry_of(columns(corners)).turns)
    EXPECT_LT((support_of(projected(corners, q * g, center, kCamera), origin) - one).norm(), 1e-9);
}

TEST(Views, EveryRotationIsNearOneOfTheGrid) {
  Random random(9);
  const std::vector<Quat> grid = rotation_grid(512, 32);
  for (int trial = 0; trial < 50; ++trial) {
    const Quat q = random_turn(random);
    double nearest = kPi;
    for (const Quat& g : grid) nearest = std::min(nearest, q.angularDistance(g));
    EXPECT_LT(degrees(nearest), 12.0);
  }
}

}  // namespace
}  // namespace unseen::collision
