// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/point_sample.h"

namespace unseen::report {
namespace {

/// Keeps every second entry.
template <class T>
void halve(std::vector<T>& values) {
  for (std::size_t i = 0; 2 * i < values.size(); ++i) values[i] = values[2 * i];
  values.resize((values.size() + 1) / 2);
}

}  // namespace

void PointSample::add(std::span<const Vec3> block, std::span<const int> planes) {
  if (limit == 0) return;
  for (std::size_t i = 0; i < block.size(); ++i) {
    if (!block[i].allFinite()) continue;
    if (seen++ % step != 0) continue;
    if (positions.size() == limit) {
      halve(positions);
      halve(plane_of_point);
      step *= 2;
      if ((seen - 1) % step != 0) continue;
    }
    positions.push_back(block[i]);
    plane_of_point.push_back(planes[i]);
  }
}

PointSample thinned(const PointSample& sample, std::size_t limit) {
  PointSample fewer;
  fewer.limit = limit;
  fewer.add(sample.positions, sample.plane_of_point);
  fewer.step *= sample.step;
  fewer.seen = sample.seen;
  return fewer;
}

}  // namespace unseen::report
