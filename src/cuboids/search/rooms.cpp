// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "cuboids/search/hypotheses.h"

namespace unseen::cuboids {
namespace {

constexpr double kUprightFace = 0.7;     // cosine
constexpr double kFitOpen = 1.5;     // tolerances
constexpr int kMaxSamples = 14;      // along one side of a face
constexpr int kEdgeSamples = 9;      // along an edge
constexpr int kFewestEdgeSamples = 3;  // that show something: depth is missing along edges
constexpr double kFreeRow = 0.6;       // of a row's samples that show something,
constexpr double kFewestRowSamples = 5;  // of which it has so many
constexpr double kFarthest = 3.0;    // m: no face moves farther than this

/// Places along one side of a box, away from its edges, where flying pixels are.
std::vector<double> places(double half, double inset, double step) {
  const double reach = std::max(half - inset, 0.5 * half);
  const int count = std::clamp(static_cast<int>(std::ceil(2.0 * reach / step)), 2, kMaxSamples);
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(-reach + 2.0 * reach * i / (count - 1));
  return out;
}

/// Whether the view proves a face free that is moved outward by `distance`: many of its samples, or most of a row of them across it, as of what lies under
/// the near edge of a table. The outermost rows are left to the fit.
bool is_free(const DepthView& view, const OrientedBox& box, int face, double distance, double inset) {
  const int axis = face / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
  const Vec3 middle = box.center + face_normal(box, face) * (box.half_size[axis] + distance);
  const double step = std::max(2.0 * view.spacing(middle), inset);
  const std::vector<double> across = places(box.half_size[u], inset, step), along = places(box.half_size[v], inset, step);
  const auto rows = static_cast<Eigen::Index>(across.size()), columns = static_cast<Eigen::Index>(along.size());
  Eigen::ArrayXXd free(rows, columns), known(rows, columns);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j < columns; ++j) {
      const DepthView::Space space = view.at(middle + across[static_cast<std::size_t>(i)] * box.axes.col(u) + along[static_cast<std::size_t>(j)] * box.axes.col(v));
      free(i, j) = space == DepthView::Space::free;
      known(i, j) = space != DepthView::Space::missing && space != DepthView::Space::outside;
    }
  if (free.mean() > kFreeShare) return true;
  const auto clearly = [](double some, double all) { return all >= kFewestRowSamples && some > kFreeRow * all; };
  for (Eigen::Index i = 1; i + 1 < rows; ++i)
    if (clearly(free.row(i).sum(), known.row(i).sum())) return true;
  for (Eigen::Index j = 1; j + 1 < columns; ++j)
    if (clearly(free.col(j).sum(), known.col(j).sum())) return true;
  return false;
}

}  // namespace

bool is_covered(const DepthView& view, const OrientedBox& box, int face, double distance, double tolerance) {
  const int axis = face / 2;
  const int up = std::abs(box.axes(2, (axis + 1) % 3)) > std::abs(box.axes(2, (axis + 2) % 3)) ? (axis + 1) % 3 : (axis + 2) % 3;
  const int along = 3 - axis - up;
  const Vec3 upward = (box.axes(2, up) < 0.0 ? -1.0 : 1.0) * box.axes.col(up);
  const Vec3 middle = box.center + (box.half_size[axis] + distance) * face_normal(box, face) +
                      std::max(0.0, box.half_size[up] - 0.5 * tolerance) * upward;
  int covered = 0, known = 0;
  for (int i = 0; i < kEdgeSamples; ++i) {
    const double t = 0.8 * (2.0 * i / (kEdgeSamples - 1) - 1.0) * box.half_size[along];
    const DepthView::Space space = view.at(middle + t * box.axes.col(along));
    known += space != DepthView::Space::missing;
    covered += space != DepthView::Space::free && space != DepthView::Space::missing;
  }
  return 8 * covered >= 7 * known && known >= kFewestEdgeSamples;
}

static Extension room_of(const DepthView& view, const Cuboid& cuboid, double tolerance) {
  const OrientedBox& box = cuboid.initial;
  Extension room{};
  for (int face = 0; face < 6; ++face) {
    const bool sideways = std::abs(face_normal(box, face).z()) < kUprightFace;
    if (sideways && cuboid.by_symmetry) continue;
    const auto is_open = [&](double at) {
      return !is_free(view, box, face, at, tolerance) && (!sideways || is_covered(view, box, face, at, tolerance));
    };
    // A face that is seen stops at the first step: it may still move by what the fit leaves open.
    double at = tolerance;
    while (at < kFarthest && is_open(at + 0.5 * tolerance)) at += tolerance;
    room[face] = at > 1.5 * tolerance ? at : kFitOpen * tolerance;
    // Sideways a box grows no longer than its longest side that was seen: else a pole would become a wall.
    if (sideways)
      room[face] = std::min(room[face], std::max(2.0 * box.half_size.maxCoeff() - box.half_size[face / 2], kFitOpen * tolerance));
  }
  return room;
}

Rooms find_rooms(const DepthView& view, const std::vector<Cuboid>& cuboids, const std::vector<double>& tolerance) {
  Rooms rooms;
  for (std::size_t i = 0; i < cuboids.size(); ++i) rooms.push_back(room_of(view, cuboids[i], tolerance[i]));
  return rooms;
}

/// m: how far outside of a box a place is, along the axis where it is farthest; inside below 0.
static double outside_of(const OrientedBox& box, const Vec3& p) {
  return ((box.axes.transpose() * (p - box.center)).cwiseAbs() - box.half_size).maxCoeff();
}

/// Places on a grid in a box that are in none of the known ones.
static std::vector<Vec3> places_added(std::span<const OrientedBox> known, const OrientedBox& box, double margin) {
  std::array<std::vector<double>, 3> grid;
  for (int k = 0; k < 3; ++k) grid[k] = places(box.half_size[k], margin, std::max(margin, box.half_size[k] / 5.0));
  std::vector<Vec3> out;
  for (const double x : grid[0])
    for (const double y : grid[1])
      for (const double z : grid[2]) {
        const Vec3 p = box.center + box.axes * Vec3(x, y, z);
        if (std::none_of(known.begin(), known.end(), [&](const OrientedBox& k) { return outside_of(k, p) <= margin; })) out.push_back(p);
      }
  return out;
}

bool in_hidden_space(const DepthView& view, std::span<const OrientedBox> known, const OrientedBox& box, double margin, double share) {
  const std::vector<Vec3> added = places_added(known, box, margin);
  const auto free = std::count_if(added.begin(), added.end(), [&](const Vec3& p) { return view.at(p) == DepthView::Space::free; });
  return static_cast<double>(free) <= share * static_cast<double>(added.size());
}

double share_inside(std::span<const OrientedBox> known, const OrientedBox& box, const OrientedBox& other, double margin) {
  const std::vector<Vec3> added = places_added(known, box, margin);
  const auto inside = std::count_if(added.begin(), added.end(), [&](const Vec3& p) { return outside_of(other, p) < -margin; });
  return added.empty() ? 0.0 : static_cast<double>(inside) / static_cast<double>(added.size());
}

}  // namespace unseen::cuboids
