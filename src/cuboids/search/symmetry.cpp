// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "cuboids/search/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kLevel = 0.99;          // cosine
constexpr double kSlender = 2.0;         // a leg is that many times taller than wide
constexpr double kLegShare = 0.35;       // of the plate's width, at most
constexpr double kHiddenShare = 0.9;     // of a leg's samples
constexpr std::size_t kEnoughLegs = 2;   // seen ones, before others are believed

bool is_level(const OrientedBox& box) { return box.axes.row(2).cwiseAbs().maxCoeff() > kLevel; }

int vertical_axis(const OrientedBox& box) {
  int axis = 0;
  box.axes.row(2).cwiseAbs().maxCoeff(&axis);
  return axis;
}

/// True if `leg` stands under `plate`, slender and within its outline.
bool is_leg_of(const OrientedBox& leg, const OrientedBox& plate, double tolerance) {
  if (!is_level(leg) || !is_level(plate)) return false;
  const int up = vertical_axis(leg), plate_up = vertical_axis(plate);
  double width = 0.0;
  for (int k = 0; k < 3; ++k)
    if (k != up) width = std::max(width, leg.half_size[k]);
  if (leg.half_size[up] < kSlender * width) return false;
  const double gap = plate.center.z() - plate.half_size[plate_up] - (leg.center.z() + leg.half_size[up]);
  // Its upper part may be hidden by the plate.
  if (gap < -3.0 * tolerance || gap > std::max(3.0 * tolerance, leg.half_size[up])) return false;
  const Vec3 offset = plate.axes.transpose() * (leg.center - plate.center);
  for (int k = 0; k < 3; ++k)
    if (k != plate_up && (width > kLegShare * plate.half_size[k] || std::abs(offset[k]) > plate.half_size[k])) return false;
  return true;
}

/// Mirrored at the vertical planes through the middle of the plate, along the axes that are asked for.
OrientedBox mirrored(const OrientedBox& leg, const OrientedBox& plate, const std::array<bool, 3>& along) {
  OrientedBox out = leg;
  Vec3 offset = plate.axes.transpose() * (leg.center - plate.center);
  Mat3 axes = plate.axes.transpose() * leg.axes;
  for (int k = 0; k < 3; ++k)
    if (along[k]) {
      offset[k] = -offset[k];
      axes.row(k) = -axes.row(k);
    }
  if (axes.determinant() < 0.0) axes.col(0) = -axes.col(0);  // boxes are their own mirror images
  out.center = plate.center + plate.axes * offset;
  out.axes = plate.axes * axes;
  return out;
}

/// Whether two legs in line along an axis of the plate stand unequally far from its middle: then an end of it is hidden.
bool is_lopsided(const std::vector<Cuboid>& cuboids, const std::vector<std::size_t>& legs, const OrientedBox& plate, int axis, int other) {
  for (const std::size_t i : legs)
    for (const std::size_t j : legs) {
      const Vec3 first = plate.axes.transpose() * (cuboids[i].initial.center - plate.center);
      const Vec3 second = plate.axes.transpose() * (cuboids[j].initial.center - plate.center);
      const double width = 2.0 * cuboids[i].initial.half_size.minCoeff();
      if (std::abs(first[other] - second[other]) < width && std::abs(first[axis] - second[axis]) > width &&
          std::abs(first[axis] + second[axis]) > width)
        return true;
    }
  return false;
}

/// True if nothing of it could have been seen.
bool is_hidden(const DepthView& view, const OrientedBox& box) {
  constexpr int kSamples = 6;
  int hidden = 0, all = 0;
  for (int x = 0; x < kSamples; ++x)
    for (int y = 0; y < kSamples; ++y)
      for (int z = 0; z < 2 * kSamples; ++z) {
        const Vec3 unit((x + 0.5) / kSamples, (y + 0.5) / kSamples, (z + 0.5) / (2 * kSamples));
        const DepthView::Space space = view.at(box.center + box.axes * box.half_size.cwiseProduct(2.0 * unit - Vec3::Ones()));
        if (space == DepthView::Space::free) return false;
        hidden += space == DepthView::Space::hidden;
        ++all;
      }
  return hidden >= kHiddenShare * all;
}

/// Plates with the legs that stand under them, where there are enough to believe in legs.
struct Table {
  std::size_t plate = 0;
  std::vector<std::size_t> legs;
};
std::vector<Table> tables_of(const std::vector<Cuboid>& cuboids, const std::vector<double>& tolerance) {
  std::vector<Table> out;
  for (std::size_t plate = 0; plate < cuboids.size(); ++plate) {
    Table table{plate, {}};
    for (std::size_t i = 0; i < cuboids.size(); ++i)
      if (i != plate && is_leg_of(cuboids[i].initial, cuboids[plate].initial, std::max(tolerance[i], tolerance[plate]))) table.legs.push_back(i);
    if (table.legs.size() >= kEnoughLegs) out.push_back(std::move(table));
  }
  return out;
}

}  // namespace

std::size_t add_hidden_legs(const DepthView& view, std::vector<Cuboid>& cuboids, std::vector<double>& tolerance) {
  const std::size_t seen = cuboids.size();
  for (const auto& [plate, legs] : tables_of(cuboids, tolerance)) {
    const int up = vertical_axis(cuboids[plate].initial);
    const OrientedBox& board = cuboids[plate].initial;
    const bool even[2] = {!is_lopsided(cuboids, legs, board, (up + 1) % 3, (up + 2) % 3),
                          !is_lopsided(cuboids, legs, board, (up + 2) % 3, (up + 1) % 3)};
    for (const std::size_t leg : legs)
      for (const auto& [first, second] : {std::pair{true, false}, std::pair{false, true}, std::pair{true, true}}) {
        if ((first && !even[0]) || (second && !even[1])) continue;
        std::array<bool, 3> along{};
        along[(up + 1) % 3] = first;
        along[(up + 2) % 3] = second;
        Cuboid hidden = cuboids[leg];
        hidden.initial = hidden.box = mirrored(cuboids[leg].initial, cuboids[plate].initial, along);
        const bool taken = std::any_of(cuboids.begin(), cuboids.end(), [&](const Cuboid& other) {
          if (&other == &cuboids[plate]) return false;
          return interface_of(solid_of(hidden.initial), solid_of(other.initial), 2.0 * tolerance[leg]).has_value();
        });
        if (taken || !is_hidden(view, hidden.initial)) continue;
        hidden.by_symmetry = true;
        hidden.object = -1;
        hidden.visible_points = 0;
        cuboids.push_back(std::move(hidden));
        tolerance.push_back(tolerance[leg]);
      }
  }
  return cuboids.size() - seen;
}

std::vector<FaceMove> legs_to_their_plates(const Problem& problem, const Rooms& rooms, const Arrangement& arrangement) {
  std::vector<Cuboid> now = problem.cuboids;
  for (std::size_t i = 0; i < now.size(); ++i) now[i].initial = arrangement.boxes[i];
  std::vector<FaceMove> out;
  for (const auto& [plate, legs] : tables_of(now, problem.tolerance))
    for (const std::size_t leg : legs) {
      const OrientedBox& box = arrangement.boxes[leg];
      const int axis = vertical_axis(box), top = box.axes(2, axis) > 0.0 ? 2 * axis + 1 : 2 * axis;
      const auto gap = reach(box, top, arrangement.solids[plate], problem.tolerance[leg]);
      const double room = rooms[leg][top] - arrangement.extension[leg][top];
      if (gap && *gap > 0.0 && *gap <= room) out.push_back({problem.supports_count() + static_cast<int>(leg), top, *gap});
    }
  return out;
}

}  // namespace unseen::cuboids
