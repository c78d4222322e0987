// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/hollow.h"

#include <algorithm>
#include <array>
#include <map>

namespace unseen::cuboids {
namespace {

constexpr int kMostFreeCells = 24;  // an axis
constexpr double kFreeCellSigmas = 3.0;
constexpr double kClumpsAcross = 64.0;
constexpr double kDeepSigmas = 4.0;  // before a surface, beyond the sensor's noise: its warps

bool is_clearly_free(const DepthView& view, const Vec3& place, double margin) {
  const Vec3 ray = (place - view.viewpoint()).normalized(), u = any_orthogonal(ray), v = ray.cross(u), behind = place + margin * ray;
  const double aside = 0.5 * view.spacing(place);
  for (const Vec3& offset : {Vec3(0, 0, 0), Vec3(aside * u), Vec3(-aside * u), Vec3(aside * v), Vec3(-aside * v)})
    if (view.at(behind + offset) != DepthView::Space::free) return false;
  return true;
}

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
        interior.cells.push_back(cell);
        interior.is_free.push_back(is_clearly_free(view, axes * cell, kDeepSigmas * sigma));
      }
  return interior;
}

Hollow hollow_of(const Interior& interior, const Hull& hull) {
  Hollow hollow;
  for (std::size_t k = 0; k < interior.cells.size(); ++k)
    if (hull.contains(interior.cells[k])) hollow.within += 1.0, hollow.free += interior.is_free[k];
  return hollow;
}

Piece piece_of(const Observation& seen, const Interior& interior, std::vector<int> points) {
  Hull hull;
  for (const int i : points)
    if (interior.face_of_point[i] >= 0) hull.add(interior.axes.transpose() * seen.points[i]);
  return {std::move(points), hollow_of(interior, hull)};
}

Clumps clumps_of(const Observation& seen, const Interior& interior, std::span<const int> points) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const int i : points) low = low.cwiseMin(seen.points[i]), high = high.cwiseMax(seen.points[i]);
  const double size = std::max((high - low).maxCoeff() / kClumpsAcross, 1e-9);
  Clumps clumps;
  std::map<std::array<int, 4>, int> numbers;
  std::vector<int> clump_of(seen.points.size(), -1);
  for (const int i : points) {
    const Vec3 cell = (seen.points[i] - low) / size;
    const std::array<int, 4> key = {static_cast<int>(cell.x()), static_cast<int>(cell.y()), static_cast<int>(cell.z()), interior.face_of_point[i]};
    const int k = clump_of[i] = numbers.try_emplace(key, static_cast<int>(numbers.size())).first->second;
    if (k == static_cast<int>(clumps.centers.size())) clumps.centers.push_back(Vec3::Zero()), clumps.hulls.emplace_back(), clumps.counts.push_back(0);
    clumps.centers[k] += seen.points[i];
    ++clumps.counts[k];
    if (interior.face_of_point[i] >= 0) clumps.hulls[k].add(interior.axes.transpose() * seen.points[i]);
  }
  clumps.neighbours.resize(clumps.centers.size());
  for (std::size_t k = 0; k < clumps.centers.size(); ++k) clumps.centers[k] /= clumps.counts[k];
  for (const int i : points)
    for (const int j : seen.graph.neighbours(i)) {
      const int a = clump_of[i], b = clump_of[j];
      if (b < 0 || a == b || std::find(clumps.neighbours[a].begin(), clumps.neighbours[a].end(), b) != clumps.neighbours[a].end()) continue;
      clumps.neighbours[a].push_back(b);
      clumps.neighbours[b].push_back(a);
    }
  return clumps;
}

}  // namespace unseen::cuboids
