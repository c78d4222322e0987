// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/result/assign.h"

#include <algorithm>
#include <cmath>

namespace unseen::planes {
namespace {

constexpr double kLeastSine = 0.17;  // planes at less than 10° have no edge to speak of
constexpr double kToss = 2.0;        // times the noise: points nearer to an edge may be either plane's
constexpr double kOver = 6.0, kOn = 0.05;  // times the noise, or of the tolerance: what is farther lies over a plane
constexpr double kClear = 0.25;      // of the scale: what lies nearer to a plane is on neither side of it
constexpr int kBeyondEnd = 2, kContradicted = 4;  // ranks of candidates, worse than what their normals say
constexpr double kStray = 0.1;       // share of a plane that may lie on the other side all the same
const double kCosNormal = std::cos(kPi / 4);

/// What find_reach gathers for one voxel.
struct VoxelReach {
  std::vector<ReachedPlane> candidates;
  std::vector<std::int8_t> side;
};

/// A voxel that supports a plane near the one in question.
struct Support {
  int plane, voxel;
};

/// On which side of each other candidate the supporting voxels of a candidate lie.
std::vector<std::int8_t> sides(const Reach& reach, const VoxelGrid& grid, double clear,
                               const std::vector<Support>& near, const std::vector<ReachedPlane>& candidates) {
  const std::size_t k = candidates.size();
  std::vector<double> above(k * k, 0.0), below(k * k, 0.0);
  for (const Support& s : near)
    for (std::size_t a = 0; a < k; ++a) {
      if (s.plane != candidates[a].plane) continue;
      for (std::size_t b = 0; b < k; ++b) {
        const double d = reach.planes[candidates[b].plane].signed_distance(grid.moments[s.voxel].mean);
        if (d > clear) above[a * k + b] += grid.moments[s.voxel].count;
        if (d < -clear) below[a * k + b] += grid.moments[s.voxel].count;
      }
      break;
    }
  std::vector<std::int8_t> side(k * k, 0);
  for (std::size_t i = 0; i < k * k; ++i) {
    if (above[i] > 0 && below[i] < kStray * above[i]) side[i] = 1;
    if (below[i] > 0 && above[i] < kStray * below[i]) side[i] = -1;
  }
  return side;
}

/// Whether a plane has ended before the foot of a point on it: it lies on one side of another candidate, which
/// it meets at an angle, and the foot on the other.
bool beyond_end(const Reach& reach, int voxel, std::size_t a, const Vec3& p) {
  const std::uint32_t first = reach.first[voxel];
  const std::size_t k = reach.first[voxel + 1] - first;
  const Plane& own = reach.planes[reach.candidate[first + a].plane];
  const double distance = own.signed_distance(p);
  for (std::size_t b = 0; b < k; ++b) {
    const std::int8_t side = reach.side[reach.first_side[voxel] + a * k + b];
    if (side == 0) continue;
    const Plane& other = reach.planes[reach.candidate[first + b].plane];
    const double cosine = own.normal.dot(other.normal);
    if (1.0 - cosine * cosine < kLeastSine * kLeastSine) continue;
    if (side * (other.signed_distance(p) - distance * cosine) < 0) return true;
  }
  return false;
}

}  // namespace

void update_planes(Reach& reach, const Model& model) {
  reach.planes.clear();
  reach.noise.clear();
  for (const Part& part : model.parts) {
    reach.planes.push_back(model.plane(part));
    reach.noise.push_back(model.surfaces[part.surface].support.fit.rms);
  }
}

Reach find_reach(const Model& model, const VoxelGrid& grid, const Cells& cells, bool use_point_normals,
                 const Context& context) {
  Reach reach;
  reach.use_point_normals = use_point_normals;
  reach.tolerance = cells.tolerance;
  std::vector<int> plane_of_cell(grid.size(), -1);
  update_planes(reach, model);
  for (std::size_t p = 0; p < model.parts.size(); ++p)
    for (const int i : model.parts[p].cells) plane_of_cell[i] = static_cast<int>(p);
  const std::vector<int> plane_of_block = grid.labels_of_blocks(plane_of_cell);
  LargeVector<VoxelReach> lists(grid.size());
  parallel_blocks(context, grid.size(), 1024, [&](std::size_t begin, std::size_t end) {
    std::vector<Support> near;
    std::vector<int> met;
    for (std::size_t i = begin; i < end; ++i) {
      met.clear();
      const int around = voxels_within(cells, grid, i, kBeyondReach);
      int last = VoxelGrid::kNone;  // neighbours mostly support the same plane
      const auto nothing_new = [&](std::uint32_t block) {
        return plane_of_block[block] == VoxelGrid::kNone || plane_of_block[block] == last;
      };
      grid.for_neighbours_unless(i, around, nothing_new, [&](int k) {
        const int p = plane_of_cell[k];
        if (p < 0 || p == last) return;
        last = p;
        if (std::find(met.begin(), met.end(), p) == met.end()) met.push_back(p);
      });
      std::vector<ReachedPlane>& list = lists[i].candidates;
      const Vec3 center = grid.center_of(grid.keys[i]);
      const double farthest = reach.tolerance[i] + 0.87 * grid.edge;
      for (const int p : met) {
        const Plane& plane = reach.planes[p];
        if (std::abs(plane.signed_distance(center)) <= farthest) list.push_back({p, compare_normal(cells, i, plane.normal)});
      }
      if (list.size() < 2) continue;
      std::sort(list.begin(), list.end(), [](const ReachedPlane& a, const ReachedPlane& b) { return a.plane < b.plane; });
      near.clear();
      grid.for_neighbours(i, around, [&](int k) {
        if (plane_of_cell[k] >= 0) near.push_back({plane_of_cell[k], k});
      });
      lists[i].side = sides(reach, grid, kClear * reach.tolerance[i], near, list);
    }
  });
  reach.first.push_back(0);
  for (const VoxelReach& v : lists) {
    reach.candidate.insert(reach.candidate.end(), v.candidates.begin(), v.candidates.end());
    reach.first.push_back(static_cast<std::uint32_t>(reach.candidate.size()));
    reach.first_side.push_back(static_cast<std::uint32_t>(reach.side.size()));
    reach.side.insert(reach.side.end(), v.side.begin(), v.side.end());
  }
  return reach;
}

void assign_points(const Reach& reach, const VoxelGrid& grid, const PointCloud& block, bool only_sure,
                   std::span<int> plane_of_point, const Context& context) {
  parallel_blocks(context, block.size(), 1 << 11, [&](std::size_t begin, std::size_t end) {
    VoxelKey last{};
    int voxel = -2;
    for (std::size_t i = begin; i < end; ++i) {
      plane_of_point[i] = -1;
      const Vec3& p = block.positions[i];
      if (!grid.within.contains(p)) continue;
      const VoxelKey key = grid.key_of(p);
      if (voxel == -2 || key != last) {
        voxel = grid.find(key);
        last = key;
      }
      if (voxel < 0) continue;
      double nearest = reach.tolerance[voxel];
      int worst = only_sure ? 0 : kContradicted;  // rank of the best candidate so far: lower is better, distance decides ties
      const std::uint32_t first = reach.first[voxel], end = reach.first[voxel + 1];
      for (std::uint32_t c = first; c < end; ++c) {
        const ReachedPlane& candidate = reach.candidate[c];
        const Plane& plane = reach.planes[candidate.plane];
        const double distance = std::abs(plane.signed_distance(p));
        if (distance >= reach.tolerance[voxel]) continue;
        NormalVerdict verdict = candidate.normal;
        if (verdict != NormalVerdict::agrees && reach.use_point_normals) {
          const Vec3 n = block.normals[i].cast<double>();
          const double length = n.norm();
          if (length > 0.5 && length < 2.0 && std::abs(n.dot(plane.normal)) >= kCosNormal * length)
            verdict = NormalVerdict::agrees;
        } else if (verdict == NormalVerdict::unknown) {
          verdict = NormalVerdict::agrees;
        }
        if (verdict == NormalVerdict::contradicts) continue;
        int rank = static_cast<int>(verdict);
        if (end - first > 1 && beyond_end(reach, voxel, c - first, p)) rank += kBeyondEnd;
        if (rank > worst || (rank == worst && distance >= nearest)) continue;
        worst = rank;
        nearest = distance;
        plane_of_point[i] = candidate.plane;
      }
    }
  });
}

void drop_doubtful(const Reach& reach, const VoxelGrid& grid, const PointCloud& block,
                     std::span<int> plane_of_point, const Context& context) {
  parallel_blocks(context, block.size(), 1 << 11, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const int plane = plane_of_point[i];
      if (plane < 0) continue;
      const Vec3& p = block.positions[i];
      const int voxel = grid.find(grid.key_of(p));
      const Plane& own = reach.planes[plane];
      if (std::abs(own.signed_distance(p)) > std::max(kOver * reach.noise[plane], kOn * reach.tolerance[voxel])) plane_of_point[i] = -1;
      for (std::uint32_t c = reach.first[voxel]; c < reach.first[voxel + 1]; ++c) {
        const int k = reach.candidate[c].plane;
        const Plane& other = reach.planes[k];
        const double cosine = own.normal.dot(other.normal);
        if (1.0 - cosine * cosine < kLeastSine * kLeastSine) continue;
        // From the foot of the point to the line where both meet it is |d₂ − d₁ cos| / sin.
        const double apart = std::abs(other.signed_distance(p) - own.signed_distance(p) * cosine);
        if (apart < kToss * std::max(reach.noise[plane], reach.noise[k])) plane_of_point[i] = -1;
      }
    }
  });
}

PlaneSums::PlaneSums(const Model& model, double scale) : step_(scale / 65536.0), sums_(model.parts.size()) {
  for (const Part& p : model.parts) origin_.push_back(model.surfaces[p.surface].support.moments.mean);
}

void PlaneSums::add(const PointCloud& block, std::span<const int> plane_of_point, const std::vector<bool>& skip,
                    std::size_t first) {
  const double scale = 1.0 / step_;
  for (std::size_t i = 0; i < block.size(); ++i) {
    const int p = plane_of_point[i];
    if (p < 0 || (!skip.empty() && skip[first + i])) continue;
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
