// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/groove.h"

#include <algorithm>
#include <cmath>

namespace unseen::cuboids {
namespace {

constexpr int kSamples = 32, kFewestKnown = 8;
constexpr double kOpen = 0.7, kClosed = 0.3;  // shares that were seen through: in a groove, and beside it
constexpr int kMostPlaces = 400;
constexpr double kLeastSide = 0.1;            // of the length: what is beside a groove
constexpr double kWidest = 0.2;               // of the length: more is no groove
constexpr int kNarrowest = 2;                 // places

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
      known += space != DepthView::Space::missing && space != DepthView::Space::outside;
      free += space == DepthView::Space::free;
    }
    if (known >= kFewestKnown) shares.push_back(static_cast<double>(free) / known);
  }
  return shares;
}

std::vector<double> grooves(const DepthView& view, const OrientedBox& box, int axis) {
  const double half = box.half_size[axis];
  const int count = std::clamp(static_cast<int>(2.0 * half / view.spacing(box.center)), 1, kMostPlaces);
  const auto place = [&](int i) { return half * ((2.0 * i + 1.0) / count - 1.0); };
  std::vector<double> most(count, 0.0), least(count, 1.0);  // of the sides
  for (int i = 0; i < count; ++i)
    for (const double share : seen_through(view, box, axis, place(i))) most[i] = std::max(most[i], share), least[i] = std::min(least[i], share);
  std::vector<double> found;
  int closed = 0;
  for (int i = 0; i < count;) {
    const auto is_open = [&](int k) { return most[k] > 0.0 && least[k] > kOpen; };
    if (!is_open(i)) {
      closed += most[i] < kClosed;
      ++i;
      continue;
    }
    int end = i;
    while (end < count && is_open(end)) ++end;
    const auto after = std::count_if(most.begin() + end, most.end(), [](double share) { return share < kClosed; });
    if (end - i >= kNarrowest && end - i <= kWidest * count && closed >= kLeastSide * count && static_cast<double>(after) >= kLeastSide * count)
      found.push_back(0.5 * (place(i) + place(end - 1)));
    i = end;
  }
  return found;
}

}  // namespace unseen::cuboids
