// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/result/faced.h"

#include <algorithm>
#include <set>
#include <utility>

#include "planes/result/rings.h"

namespace unseen::planes {
namespace {

constexpr double kFaced = 0.3;  // of a plane's area

}  // namespace

void find_distances(const std::vector<int>& planes, const Vec3& u, const Vec3& v, Arrangement& result) {
  const auto count = static_cast<int>(planes.size());
  const auto offset = [&](int i) { return result.planes[planes[i]].plane.offset; };
  std::vector<Rings> rings;
  for (const int p : planes) rings.push_back(rings_of(result.planes[p], u, v));
  std::set<std::pair<int, int>> faced;
  for (int i = 0; i < count; ++i) {
    const std::vector<Vec2> samples = rings[i].samples();
    for (const int direction : {1, -1}) {
      std::vector<Vec2> open = samples;  // nothing was met there
      for (int k = i + direction; k >= 0 && k < count && !open.empty(); k += direction) {
        if (std::abs(offset(k) - offset(i)) < 1e-9 || !rings[i].box.intersects(rings[k].box)) continue;
        const std::size_t seen = std::erase_if(open, [&](const Vec2& s) { return rings[k].contains(s); });
        if (static_cast<double>(seen) >= kFaced * static_cast<double>(samples.size())) faced.insert(std::minmax(i, k));
      }
    }
  }
  for (const auto& [i, k] : faced) result.distances.push_back({std::min(planes[i], planes[k]), std::max(planes[i], planes[k]), offset(k) - offset(i)});
}

}  // namespace unseen::planes
