// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/engines.h"

#include <algorithm>
#include <map>

namespace unseen::test {

std::vector<int> rigid_bodies(const RigidScene& scene) {
  std::map<int, bool> static_group;
  for (const RigidBox& b : scene.boxes)
    if (b.group >= 0) static_group[b.group] |= b.is_static;
  std::map<int, int> number;
  std::vector<int> bodies;
  int next = 0;
  for (const RigidBox& b : scene.boxes) {
    if (b.is_static || (b.group >= 0 && static_group[b.group])) {
      bodies.push_back(-1);
    } else if (b.group < 0) {
      bodies.push_back(next++);
    } else {
      const auto [at, is_new] = number.emplace(b.group, next);
      if (is_new) ++next;
      bodies.push_back(at->second);
    }
  }
  return bodies;
}

Settled settled_from(const RigidScene& scene, std::vector<RigidTransform> poses) {
  Settled settled{std::move(poses), {}, 0.0};
  for (std::size_t i = 0; i < scene.boxes.size(); ++i) {
    const OrientedBox& box = scene.boxes[i].box;
    double farthest = 0.0;
    for (int k = 0; k < 8; ++k) {
      const Vec3 sign((k & 1) ? 1 : -1, (k & 2) ? 1 : -1, (k & 4) ? 1 : -1);
      const Vec3 corner = box.center + box.axes * box.half_size.cwiseProduct(sign);
      farthest = std::max(farthest, (settled.poses[i] * corner - corner).norm());
    }
    settled.moves.push_back(farthest / (2.0 * box.half_size.norm()));
    settled.largest_move = std::max(settled.largest_move, settled.moves.back());
  }
  return settled;
}

}  // namespace unseen::test
