// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/hollow.h"

#include <algorithm>
#include <array>

namespace unseen::cuboids {
namespace {

constexpr int kMostFreeCells = 24;  // an axis
constexpr double kFreeCellSigmas = 3.0;
constexpr double kDeepSigmas = 4.0;  // before a surface, beyond the sensor's noise: its warps

}  // namespace

Interior look_into(const Observation& seen, const DepthView& view, std::span<const int> points, std::span<const int> face_of_point, const Mat3& axes) {
  Interior interior{axes, face_of_point, {}, {}};
  Hull hull;
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  double sigma = 0;
  for (const int i : points) {
    const Vec3 p = axes.transpose() * seen.points[i];
    if (face_of_point[i] >= 0) hull.add(p);
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
    sigma += seen.graph.sigma[i] / static_cast<double>(points.size());
  }
  std::array<int, 3> count;
  for (int k = 0; k < 3; ++k) count[k] = std::clamp(static_cast<int>((high[k] - low[k]) / (kFreeCellSigmas * sigma)), 1, kMostFreeCells);
  for (int z = 0; z < count[2]; ++z)
    for (int y = 0; y < count[1]; ++y)
      for (int x = 0; x < count[0]; ++x) {
        const Vec3 share((x + 0.5) / count[0], (y + 0.5) / count[1], (z + 0.5) / count[2]);
        const Vec3 cell = low + share.cwiseProduct(high - low);
        if (!hull.contains(cell)) continue;
        const Vec3 world = axes * cell, behind = world + kDeepSigmas * sigma * (world - view.viewpoint()).normalized();
        interior.cells.push_back(cell);
        interior.is_free.push_back(view.at(behind) == DepthView::Space::free);
      }
  return interior;
}

Piece piece_of(const Observation& seen, const Interior& interior, std::vector<int> points) {
  Piece piece;
  for (const int i : points)
    if (interior.face_of_point[i] >= 0) piece.hull.add(interior.axes.transpose() * seen.points[i]);
  for (std::size_t k = 0; k < interior.cells.size(); ++k)
    if (piece.hull.contains(interior.cells[k])) piece.within += 1.0, piece.free += interior.is_free[k];
  piece.points = std::move(points);
  return piece;
}

}  // namespace unseen::cuboids
