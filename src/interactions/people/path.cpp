// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "interactions/people/path.h"

#include <Eigen/SparseCholesky>
#include <cmath>

namespace unseen::interactions {
namespace {

constexpr double kAcross = 0.06, kDepth = 0.09;  // sd of a reading: m across the view, share of the distance along it
constexpr double kSpeedSd = 0.35;                // m/s, of the matched motion's speed
constexpr double kRough = 2.0;                   // sd beyond which a reading counts less and less
constexpr double kCorrelated = 5.0;              // readings share frames: so many of them say what one says

Eigen::Matrix2d information_of(const Reading& reading, const View& view) {
  const Vec2 from = reading.pelvis - view.center().head<2>();
  const Vec2 along = from.normalized(), across(-along.y(), along.x());
  const double depth = kDepth * from.norm();
  const Eigen::Matrix2d covariance =
      kCorrelated * (kAcross * kAcross * across * across.transpose() + depth * depth * along * along.transpose() + reading.spread);
  return covariance.inverse();
}

/// Ground velocity of the pelvis by the matched scenelets, m/s.
Vec2 velocity_of(const Reading& reading, const Database& database, double seconds) {
  Vec2 velocity = Vec2::Zero();
  double weight = 0;
  for (std::size_t i = 0; i < reading.matches.size(); ++i) {
    const Match& match = reading.matches[i];
    const Scenelet& scenelet = database.scenelets[static_cast<std::size_t>(match.scenelet)];
    const auto before = pose_at(scenelet, -seconds / 2), after = pose_at(scenelet, seconds / 2);
    if (!before || !after) continue;
    const Vec3 moved = match.placement * Vec3(after->col(pelvis)) - match.placement * Vec3(before->col(pelvis));
    velocity += reading.weights[i] * moved.head<2>() / seconds;
    weight += reading.weights[i];
  }
  return weight > 0 ? Vec2(velocity / weight) : velocity;
}

/// How far the matched motions have come from frame `first` to each frame, by the readings around. m
std::vector<Vec2> ways(const std::vector<Reading>& readings, const Database& database, double fps, int first, std::size_t frames) {
  constexpr double kSeconds = 0.4;
  std::vector<Vec2> read, covered(frames, Vec2::Zero());
  for (const Reading& reading : readings) read.push_back(velocity_of(reading, database, kSeconds));
  std::size_t after = 0;
  for (std::size_t i = 0; i + 1 < frames; ++i) {
    const double frame = first + static_cast<double>(i) + 0.5;
    while (after < readings.size() && readings[after].frame < frame) ++after;
    Vec2 velocity = read[after == 0 ? 0 : after - 1];
    if (after > 0 && after < readings.size()) {
      const double share = (frame - readings[after - 1].frame) / (readings[after].frame - readings[after - 1].frame);
      velocity = (1 - share) * read[after - 1] + share * read[after];
    }
    covered[i + 1] = covered[i] + velocity / fps;
  }
  return covered;
}

/// Positions in all frames: as the matched motions move, what the solution differs from that spread evenly between readings. Least squares
/// has it so, because all steps weigh the same; so frames without a reading need not be unknowns.
std::vector<Vec2> between_readings(const std::vector<Reading>& readings, const Eigen::VectorXd& solution, const std::vector<Vec2>& covered, int first) {
  std::vector<Vec2> off, positions;
  for (std::size_t i = 0; i < readings.size(); ++i)
    off.push_back(solution.segment<2>(static_cast<Eigen::Index>(2 * i)) - covered[static_cast<std::size_t>(readings[i].frame - first)]);
  std::size_t after = 0;
  for (std::size_t i = 0; i < covered.size(); ++i) {
    const int frame = first + static_cast<int>(i);
    while (after < readings.size() && readings[after].frame < frame) ++after;
    Vec2 here = off[after == readings.size() ? after - 1 : after];
    if (after > 0 && after < readings.size()) {
      const double share = static_cast<double>(frame - readings[after - 1].frame) / (readings[after].frame - readings[after - 1].frame);
      here = (1 - share) * off[after - 1] + share * off[after];
    }
    positions.push_back(covered[i] + here);
  }
  return positions;
}

}  // namespace

Path find_path(const std::vector<Reading>& readings, const Database& database, const View& view, double fps, int first, int last, bool smooth) {
  const auto frames = static_cast<std::size_t>(last - first + 1);
  const std::vector<Vec2> covered = ways(readings, database, fps, first, frames);
  const double step_weight = fps / (kSpeedSd * kSpeedSd) * (smooth ? 1.0 : 1e-3);
  std::vector<double> trust(readings.size(), 1.0);
  std::vector<Eigen::Matrix2d> information;
  for (const Reading& reading : readings) information.push_back(information_of(reading, view));
  const auto way_to = [&](std::size_t i) { return covered[static_cast<std::size_t>(readings[i].frame - first)]; };
  Eigen::VectorXd solution;
  for (int round = 0; round < 8; ++round) {
    std::vector<Eigen::Triplet<double>> entries;
    const auto size = static_cast<Eigen::Index>(2 * readings.size());
    Eigen::VectorXd right = Eigen::VectorXd::Zero(size);
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(2 * i);
      const Eigen::Matrix2d weight = trust[i] * information[i];
      for (int r = 0; r < 2; ++r)
        for (int c = 0; c < 2; ++c) entries.emplace_back(at + r, at + c, weight(r, c));
      right.segment<2>(at) += weight * readings[i].pelvis;
      if (i + 1 == readings.size()) continue;
      const double between = step_weight / (readings[i + 1].frame - readings[i].frame);
      const Vec2 moved = between * (way_to(i + 1) - way_to(i));
      for (Eigen::Index a = at; a < at + 2; ++a) {
        entries.emplace_back(a, a, between);
        entries.emplace_back(a + 2, a + 2, between);
        entries.emplace_back(a, a + 2, -between);
        entries.emplace_back(a + 2, a, -between);
      }
      right.segment<2>(at) -= moved;
      right.segment<2>(at + 2) += moved;
    }
    Eigen::SparseMatrix<double> normal(size, size);
    normal.setFromTriplets(entries.begin(), entries.end());
    solution = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(normal).solve(right);
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const Vec2 off = readings[i].pelvis - solution.segment<2>(static_cast<Eigen::Index>(2 * i));
      trust[i] = 1 / (1 + kCorrelated * off.dot(information[i] * off) / (kRough * kRough));
    }
  }
  return {first, between_readings(readings, solution, covered, first)};
}

}  // namespace unseen::interactions
