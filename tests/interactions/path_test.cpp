// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/people/path.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "core/linear.h"
#include "interactions/method_samples.h"
#include "interactions/scenelets_sample.h"
#include "unseen/core/random.h"

namespace unseen::interactions {
namespace {

constexpr double kFps = 10;

View level_view() { return view_of({1000, 1000, 960, 540, 1920, 1080}, {1.4, 0, 0, "given"}); }

/// Scenelet 0 stays, scenelet 1 walks along its +x at 1 m/s.
Database two_scenelets() { return {{}, {test::moving_scenelet(simple_pose(1), 0), test::moving_scenelet(simple_pose(0), 1)}}; }

Reading reading_of(int frame, const Vec2& pelvis, int scenelet, double angle = 0) {
  Reading r;
  r.frame = frame;
  r.pelvis = pelvis;
  r.matches = {{scenelet, {{pelvis.x(), pelvis.y(), 0}, angle}, 0.001}};
  r.weights = {1.0};
  return r;
}

TEST(Path, GoesThroughReadingsThatAreRight) {
  const Database database = two_scenelets();
  std::vector<Reading> sits, walks;
  const double heading = 0.5;
  const auto place = [&](int frame) -> Vec2 { return Vec2(-1, 4) + (frame - 3) / kFps * Vec2(std::cos(heading), std::sin(heading)); };
  for (int frame = 3; frame <= 43; frame += 2) {
    sits.push_back(reading_of(frame, {0.5, 4}, 0));
    walks.push_back(reading_of(frame, place(frame), 1, heading));
  }
  for (const bool smooth : {true, false}) {
    const Path still = find_path(sits, database, level_view(), kFps, 3, 43, smooth), way = find_path(walks, database, level_view(), kFps, 3, 43, smooth);
    ASSERT_EQ(still.positions.size(), 41u);
    EXPECT_EQ(way.last(), 43);
    for (int frame = 3; frame <= 43; ++frame) {
      EXPECT_NEAR((still.at(frame) - Vec2(0.5, 4)).norm(), 0, 1e-7);
      EXPECT_NEAR((way.at(frame) - place(frame)).norm(), 0, 1e-7) << frame;
    }
  }
}

TEST(Path, OfSomeoneWhoSitsStaysThoughSomeReadingsAreFarOff) {
  const Database database = two_scenelets();
  Random random(1);
  std::vector<Reading> readings;
  for (int frame = 0; frame <= 100; frame += 2) {
    Vec2 at = Vec2(0.5, 4) + 0.02 * Vec2(random.normal(), random.normal());
    if (frame % 10 == 0) at += Vec2(0.4, 1.5);
    readings.push_back(reading_of(frame, at, 0));
  }
  const Path path = find_path(readings, database, level_view(), kFps, 0, 100, true);
  for (int frame = 0; frame <= 100; ++frame) EXPECT_LT((path.at(frame) - Vec2(0.5, 4)).norm(), 0.10) << frame;
}

TEST(Path, MovesAsTheScenelets) {
  // Nothing but the first reading tells the place; from there on the matched motion leads.
  const Database database = two_scenelets();
  std::vector<Reading> readings = {reading_of(0, {0, 4}, 1)};
  for (int frame = 2; frame <= 20; frame += 2) {
    readings.push_back(reading_of(frame, {0, 4}, 1));
    readings.back().spread = 1e6 * Eigen::Matrix2d::Identity();
  }
  const Path path = find_path(readings, database, level_view(), kFps, 0, 20, true);
  for (int frame = 0; frame <= 20; ++frame) EXPECT_NEAR((path.at(frame) - Vec2(frame / kFps, 4)).norm(), 0, 1e-3);
}

TEST(Path, IsTheDenseSolutionOfItsLeastSquares) {
  const Database database = two_scenelets();
  const View view = level_view();
  Random random(2);
  constexpr int kFirst = 7, kLast = 60;
  std::vector<Reading> readings;
  for (int frame = kFirst; frame <= kLast; frame += 2 + static_cast<int>(random.index(3))) {
    readings.push_back(reading_of(frame, {random.uniform(-1, 1), random.uniform(3, 5)}, static_cast<int>(random.index(2)), random.uniform(-kPi, kPi)));
    const Vec2 wide(random.uniform(0, 0.3), random.uniform(0, 0.3));
    readings.back().spread = wide * wide.transpose();
  }
  for (const bool smooth : {true, false}) {
    const Path path = find_path(readings, database, view, kFps, kFirst, kLast, smooth);
    // Rows of a dense system: readings by whitened offsets, steps by the readings' velocities; Cauchy weights from the round before.
    constexpr int kCount = kLast - kFirst + 1;
    std::vector<double> trust(readings.size(), 1.0);
    Eigen::VectorXd x;
    for (int round = 0; round < 8; ++round) {
      Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2 * static_cast<int>(readings.size()) + 2 * (kCount - 1), 2 * kCount);
      Eigen::VectorXd values = Eigen::VectorXd::Zero(rows.rows());
      std::vector<Eigen::Matrix2d> whiten;
      int row = 0;
      for (std::size_t i = 0; i < readings.size(); ++i, row += 2) {
        const Vec2 along = readings[i].pelvis.normalized(), across(-along.y(), along.x());
        const double depth_sd = 0.09 * readings[i].pelvis.norm();
        const Eigen::Matrix2d covariance =
            5 * (0.06 * 0.06 * across * across.transpose() + depth_sd * depth_sd * along * along.transpose() + readings[i].spread);
        whiten.push_back(covariance.inverse().llt().matrixU());
        rows.block<2, 2>(row, 2 * (readings[i].frame - kFirst)) = std::sqrt(trust[i]) * whiten.back();
        values.segment<2>(row) = std::sqrt(trust[i]) * whiten.back() * readings[i].pelvis;
      }
      const double step = std::sqrt(kFps) / 0.35 * (smooth ? 1.0 : std::sqrt(1e-3));
      for (int k = 0; k + 1 < kCount; ++k, row += 2) {
        const double frame = kFirst + k + 0.5;
        const auto speed = [](const Reading& r) {
          const double angle = r.matches[0].placement.angle;
          return r.matches[0].scenelet == 0 ? Vec2(0, 0) : Vec2(std::cos(angle), std::sin(angle));
        };
        Vec2 velocity = speed(readings.back());
        for (std::size_t i = 0; i + 1 < readings.size(); ++i)
          if (readings[i].frame < frame && frame < readings[i + 1].frame) {
            const double share = (frame - readings[i].frame) / (readings[i + 1].frame - readings[i].frame);
            velocity = (1 - share) * speed(readings[i]) + share * speed(readings[i + 1]);
          }
        rows.block<2, 2>(row, 2 * k) = -step * Eigen::Matrix2d::Identity();
        rows.block<2, 2>(row, 2 * k + 2) = step * Eigen::Matrix2d::Identity();
        values.segment<2>(row) = step * velocity / kFps;
      }
      x = least_squares(rows, values);
      for (std::size_t i = 0; i < readings.size(); ++i) {
        const Vec2 off = whiten[i] * (x.segment<2>(2 * (readings[i].frame - kFirst)) - readings[i].pelvis);
        trust[i] = 1 / (1 + 5 * off.squaredNorm() / 4);
      }
    }
    for (int k = 0; k < kCount; ++k) EXPECT_NEAR((path.at(kFirst + k) - x.segment<2>(2 * k)).norm(), 0, 1e-6) << k;
  }
}

TEST(Path, OfOneFrameIsItsReading) {
  const Path path = find_path({reading_of(5, {1, 3}, 0)}, two_scenelets(), level_view(), kFps, 5, 5, true);
  ASSERT_EQ(path.positions.size(), 1u);
  EXPECT_NEAR((path.at(99) - Vec2(1, 3)).norm(), 0, 1e-9);
}

}  // namespace
}  // namespace unseen::interactions
