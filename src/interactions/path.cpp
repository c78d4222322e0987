// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "interactions/path.h"

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

/// Velocities for every step between frames, from the readings around.
std::vector<Vec2> velocities(const std::vector<Reading>& readings, const Database& database, int first, std::size_t steps) {
  constexpr double kSeconds = 0.4;
  std::vector<Vec2> all(steps, Vec2::Zero());
  std::size_t after = 0;
  std::vector<Vec2> read;
  for (const Reading& reading : readings) read.push_back(velocity_of(reading, database, kSeconds));
  for (std::size_t i = 0; i < steps; ++i) {
    const double frame = first + static_cast<double>(i) + 0.5;
    while (after < readings.size() && readings[after].frame < frame) ++after;
    if (after == 0 || after == readings.size()) {
      all[i] = read.empty() ? Vec2(Vec2::Zero()) : read[after == 0 ? 0 : after - 1];
      continue;
    }
    const double share = (frame - readings[after - 1].frame) / (readings[after].frame - readings[after - 1].frame);
    all[i] = (1 - share) * read[after - 1] + share * read[after];
  }
  return all;
}

}  // namespace

Path find_path(const std::vector<Reading>& readings, const Database& database, const View& view, double fps, int first, int last, bool smooth) {
  const auto count = static_cast<Eigen::Index>(last - first + 1);
  const std::vector<Vec2> velocity = velocities(readings, database, first, static_cast<std::size_t>(count - 1));
  const double step_weight = fps * fps / (kSpeedSd * kSpeedSd) / fps * (smooth ? 1.0 : 1e-3);
  std::vector<double> trust(readings.size(), 1.0);
  std::vector<Eigen::Matrix2d> information;
  for (const Reading& reading : readings) information.push_back(information_of(reading, view));
  Eigen::VectorXd solution = Eigen::VectorXd::Zero(2 * count);
  for (int round = 0; round < 8; ++round) {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * count);
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const Eigen::Index at = 2 * (readings[i].frame - first);
      const Eigen::Matrix2d weight = trust[i] * information[i];
      for (int r = 0; r < 2; ++r)
        for (int c = 0; c < 2; ++c) entries.emplace_back(at + r, at + c, weight(r, c));
      right.segment<2>(at) += weight * readings[i].pelvis;
    }
    for (Eigen::Index i = 0; i + 1 < count; ++i)
      for (Eigen::Index d = 0; d < 2; ++d) {
        const Eigen::Index a = 2 * i + d, b = a + 2;
        const double moved = velocity[static_cast<std::size_t>(i)][d] / fps;
        entries.emplace_back(a, a, step_weight);
        entries.emplace_back(b, b, step_weight);
        entries.emplace_back(a, b, -step_weight);
        entries.emplace_back(b, a, -step_weight);
        right[a] -= step_weight * moved;
        right[b] += step_weight * moved;
      }
    Eigen::SparseMatrix<double> normal(2 * count, 2 * count);
    normal.setFromTriplets(entries.begin(), entries.end());
    solution = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(normal).solve(right);
    for (std::size_t i = 0; i < readings.size(); ++i) {
      const Vec2 off = readings[i].pelvis - solution.segment<2>(2 * (readings[i].frame - first));
      trust[i] = 1 / (1 + kCorrelated * off.dot(information[i] * off) / (kRough * kRough));
    }
  }
  Path path{first, {}};
  for (Eigen::Index i = 0; i < count; ++i) path.positions.push_back(solution.segment<2>(2 * i));
  return path;
}

}  // namespace unseen::interactions
