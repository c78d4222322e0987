// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/assign.h"

#include <algorithm>
#include <cmath>

namespace unseen::planes {
namespace {

constexpr int kReach = 3;  // voxels of edge ρ/2
const double kCosNormal = std::cos(kPi / 4);

}  // namespace

Reach find_reach(const Model& model, const VoxelGrid& grid, const Cells& cells, bool use_point_normals,
                 const Context& context) {
  Reach reach;
  reach.use_point_normals = use_point_normals;
  reach.tolerance = cells.tolerance;
  std::vector<int> plane_of_cell(grid.size(), -1);
  for (std::size_t p = 0; p < model.planes.size(); ++p) {
    reach.planes.push_back({model.normal(model.planes[p]), model.planes[p].offset});
    for (const int i : model.planes[p].support.cells) plane_of_cell[i] = static_cast<int>(p);
  }
  std::vector<std::vector<ReachedPlane>> lists(grid.size());
  parallel_blocks(context, grid.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      std::vector<ReachedPlane>& list = lists[i];
      const Vec3 center = grid.center_of(grid.keys[i]);
      const double farthest = reach.tolerance[i] + 0.87 * grid.edge;
      grid.for_neighbours(grid.keys[i], kReach, [&](int k) {
        const int p = plane_of_cell[k];
        if (p < 0 || std::any_of(list.begin(), list.end(), [&](const ReachedPlane& r) { return r.plane == p; })) return;
        const Plane& plane = reach.planes[p];
        if (std::abs(plane.signed_distance(center)) > farthest) return;
        const Vec3& n = cells.normal[i];
        list.push_back({p, n.isZero()                                  ? ReachedPlane::unknown
                           : std::abs(n.dot(plane.normal)) < kCosNormal ? ReachedPlane::contradicts
                                                                        : ReachedPlane::agrees});
      });
      std::sort(list.begin(), list.end(), [](const ReachedPlane& a, const ReachedPlane& b) { return a.plane < b.plane; });
    }
  });
  reach.first.push_back(0);
  for (const auto& list : lists) {
    reach.candidate.insert(reach.candidate.end(), list.begin(), list.end());
    reach.first.push_back(static_cast<std::uint32_t>(reach.candidate.size()));
  }
  return reach;
}

void assign_points(const Reach& reach, const VoxelGrid& grid, const PointCloud& block,
                   std::span<int> plane_of_point, const Context& context) {
  parallel_blocks(context, block.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
    VoxelKey last{};
    int voxel = -2;
    for (std::size_t i = begin; i < end; ++i) {
      plane_of_point[i] = -1;
      const Vec3& p = block.positions[i];
      if (!p.allFinite()) continue;
      const VoxelKey key = grid.key_of(p);
      if (voxel == -2 || key != last) {
        voxel = grid.find(key);
        last = key;
      }
      if (voxel < 0) continue;
      double nearest = reach.tolerance[voxel], nearest_unsure = nearest;
      int unsure = -1;
      for (std::uint32_t c = reach.first[voxel]; c < reach.first[voxel + 1]; ++c) {
        const ReachedPlane& candidate = reach.candidate[c];
        const Plane& plane = reach.planes[candidate.plane];
        const double distance = std::abs(plane.signed_distance(p));
        if (distance >= nearest) continue;
        ReachedPlane::Normal normal = candidate.normal;
        if (normal != ReachedPlane::agrees && reach.use_point_normals) {
          const Vec3 n = block.normals[i].cast<double>();
          const double length = n.norm();
          if (length > 0.5 && length < 2.0 && std::abs(n.dot(plane.normal)) >= kCosNormal * length)
            normal = ReachedPlane::agrees;
        } else if (normal == ReachedPlane::unknown) {
          normal = ReachedPlane::agrees;
        }
        if (normal == ReachedPlane::agrees) {
          nearest = distance;
          plane_of_point[i] = candidate.plane;
        } else if (normal == ReachedPlane::unknown && distance < nearest_unsure) {
          nearest_unsure = distance;
          unsure = candidate.plane;
        }
      }
      if (plane_of_point[i] < 0) plane_of_point[i] = unsure;
    }
  });
}

PlaneSums::PlaneSums(const Model& model, double scale) : step_(scale / 65536.0), sums_(model.planes.size()) {
  for (const PlaneModel& p : model.planes) origin_.push_back(p.support.moments.mean);
}

void PlaneSums::add(const PointCloud& block, std::span<const int> plane_of_point, const std::vector<bool>& skip) {
  const double scale = 1.0 / step_;
  for (std::size_t i = 0; i < block.size(); ++i) {
    const int p = plane_of_point[i];
    if (p < 0 || (!skip.empty() && skip[i])) continue;
    Sums& s = sums_[p];
    const Vec3 d = (block.positions[i] - origin_[p]) * scale;
    const std::array<std::int64_t, 3> q = {std::llround(d.x()), std::llround(d.y()), std::llround(d.z())};
    ++s.count;
    for (int a = 0, k = 0; a < 3; ++a) {
      s.first[a] += q[a];
      for (int b = a; b < 3; ++b, ++k) s.second[k] += static_cast<Int128>(q[a]) * q[b];
    }
  }
}

Moments PlaneSums::moments(std::size_t plane) const {
  const Sums& s = sums_[plane];
  Moments m;
  m.count = static_cast<double>(s.count);
  if (s.count == 0) return m;
  const Vec3 mean = Vec3(s.first[0], s.first[1], s.first[2]) / m.count;
  m.mean = origin_[plane] + mean * step_;
  for (int a = 0, k = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b, ++k) {
      m.scatter(a, b) = m.scatter(b, a) =
          (static_cast<double>(s.second[k]) - m.count * mean[a] * mean[b]) * step_ * step_;
    }
  return m;
}

}  // namespace unseen::planes
