// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/groove.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace unseen::cuboids {
namespace {

constexpr int kSamples = 32, kFewestKnown = 8;
constexpr double kOpen = 0.7, kClosed = 0.3;  // shares that were seen through: in a groove, and beside it
constexpr double kMostPlaces = 400;
constexpr double kLeastSide = 0.1;            // of the length: what is beside a groove
constexpr double kWidest = 0.2;               // of the length: more is no groove
constexpr int kNarrowest = 2;                 // places
constexpr double kAsDeep = 1.5;               // widths of a groove of which one side alone tells, that it must be deep: gaps of doors are not

}  // namespace

std::vector<double> seen_through(const DepthView& view, const OrientedBox& box, int axis, double place) {
  std::vector<double> shares;
  for (const int k : {(axis + 1) % 3, (axis + 2) % 3}) {
    const int along = 3 - axis - k;
    const double side = box.axes.col(k).dot(view.viewpoint() - box.center) < 0.0 ? -1.0 : 1.0;
    const Vec3 middle = box.center + side * box.half_size[k] * box.axes.col(k) + place * box.axes.col(axis);
    if (side * box.axes.col(k).dot(view.viewpoint() - middle) <= 0.0) continue;
    int free = 0, known = 0;
    for (int i = 0; i < kSamples; ++i) {
      const double t = 0.9 * (2.0 * i / (kSamples - 1) - 1.0) * box.half_size[along];
      const DepthView::Space space = view.at(middle + t * box.axes.col(along));
      known += space == DepthView::Space::free || space == DepthView::Space::surface;  // what something else hides tells nothing
      free += space == DepthView::Space::free;
    }
    if (known >= kFewestKnown) shares.push_back(static_cast<double>(free) / known);
  }
  return shares;
}

namespace {

/// Whether a groove is open, as far as is known, so deep in the sides as well.
bool is_open_within(const DepthView& view, OrientedBox box, int axis, double place, double depth) {
  for (const int k : {(axis + 1) % 3, (axis + 2) % 3}) box.half_size[k] -= depth;
  if (box.half_size.minCoeff() <= 0.0) return false;
  const std::vector<double> shares = seen_through(view, box, axis, place);
  return !shares.empty() && std::all_of(shares.begin(), shares.end(), [](double share) { return share > kOpen; });
}

}  // namespace

std::vector<double> grooves(const DepthView& view, const OrientedBox& box, int axis) {
  const double half = box.half_size[axis];
  const int count = static_cast<int>(std::clamp(2.0 * half / view.spacing(box.center), 1.0, kMostPlaces));
  const auto place = [&](int i) { return half * ((2.0 * i + 1.0) / count - 1.0); };
  enum class Place { unknown, open, half_open, closed, mixed };  // half open: as far as one side tells
  std::vector<Place> places;
  for (int i = 0; i < count; ++i) {
    const std::vector<double> shares = seen_through(view, box, axis, place(i));
    const auto all = [&](auto test) { return std::all_of(shares.begin(), shares.end(), test); };
    if (shares.empty()) places.push_back(Place::unknown);
    else if (all([](double share) { return share < kClosed; })) places.push_back(Place::closed);
    else if (all([](double share) { return share > kOpen; })) places.push_back(shares.size() > 1 ? Place::open : Place::half_open);
    else places.push_back(Place::mixed);
  }
  const auto begin = places.begin();
  const auto is_closed = [&](int from, int to) { return static_cast<double>(std::count(begin + from, begin + to, Place::closed)) >= kLeastSide * count; };
  std::vector<double> found;
  for (const bool of_two_sides : {true, false}) {
    const auto is_open = [&](int i) { return i < count && (places[i] == Place::open || (!of_two_sides && places[i] == Place::half_open)); };
    for (int i = 0; i < count; ++i) {
      if (!is_open(i)) continue;
      const int first = i;
      while (is_open(i)) ++i;
      if (i - first < kNarrowest || i - first > kWidest * count || !is_closed(0, first) || !is_closed(i, count)) continue;
      const double from = place(first), to = place(i - 1), middle = 0.5 * (from + to);
      if (std::any_of(found.begin(), found.end(), [&](double known) { return from <= known && known <= to; })) continue;
      if (of_two_sides || is_open_within(view, box, axis, middle, kAsDeep * 2.0 * half * (i - first) / count)) found.push_back(middle);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::vector<int>> cut_at_grooves(const Observation& seen, const DepthView& view, const std::vector<int>& points, const OrientedBox& box, double fewest) {
  std::vector<std::vector<int>> pieces{points};
  for (const int axis : {0, 1})
    for (const double place : grooves(view, box, axis)) {
      const Plane plane{box.axes.col(axis), box.axes.col(axis).dot(box.center) + place};
      std::vector<std::vector<int>> parted;
      for (std::vector<int>& piece : pieces) {
        std::array<std::vector<int>, 2> sides;
        for (const int i : piece) sides[plane.signed_distance(seen.points[i]) > 0.0].push_back(i);
        if (static_cast<double>(std::min(sides[0].size(), sides[1].size())) > fewest) parted.insert(parted.end(), std::make_move_iterator(sides.begin()), std::make_move_iterator(sides.end()));
        else parted.push_back(std::move(piece));
      }
      pieces = std::move(parted);
    }
  return pieces;
}

}  // namespace unseen::cuboids
