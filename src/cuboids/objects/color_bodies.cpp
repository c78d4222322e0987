// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/color_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace unseen::cuboids {
namespace {

constexpr int kFewestLinksOfColor = 20;  // between neighbours, of parts that a region goes on in
const double kSameSide = std::cos(radians(15.0));

}  // namespace

std::vector<std::vector<int>> joined_by_color(const Observation& seen, const std::vector<std::vector<int>>& parts,
                                              const std::vector<std::vector<ColorRegion>>& regions) {
  std::vector<std::pair<int, const ColorRegion*>> region_of_point(seen.points.size(), {-1, nullptr});  // and its part
  for (std::size_t k = 0; k < parts.size(); ++k)
    for (const ColorRegion& region : regions[k])
      for (const int i : region.points) region_of_point[i] = {static_cast<int>(k), &region};
  const auto goes_on = [&](int i, int j) {
    return seen.graph.normals[i].dot(seen.graph.normals[j]) > kSameSide && !are_other_tints(region_of_point[i].second->tint, region_of_point[j].second->tint);
  };
  std::map<std::pair<int, int>, int> links;
  for (int i = 0; i < static_cast<int>(seen.points.size()); ++i)
    for (const int j : seen.graph.neighbours(i))
      if (const int a = region_of_point[i].first, b = region_of_point[j].first; a >= 0 && a < b && goes_on(i, j)) ++links[{a, b}];
  std::vector<int> body(parts.size());
  std::iota(body.begin(), body.end(), 0);
  for (const auto& [pair, count] : links) {
    const auto [to, from] = std::minmax(body[pair.first], body[pair.second]);
    if (count >= kFewestLinksOfColor) std::replace(body.begin(), body.end(), int{from}, int{to});
  }
  std::vector<std::vector<int>> bodies(parts.size());
  for (std::size_t k = 0; k < parts.size(); ++k) bodies[body[k]].insert(bodies[body[k]].end(), parts[k].begin(), parts[k].end());
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (bodies[k].size() == parts[k].size()) bodies[k].clear();  // a part alone
    std::sort(bodies[k].begin(), bodies[k].end());
  }
  std::erase_if(bodies, [](const std::vector<int>& points) { return points.empty(); });
  return bodies;
}

}  // namespace unseen::cuboids
