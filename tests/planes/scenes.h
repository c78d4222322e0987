// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include "planes/patches/cuts.h"
#include "planes/scan/cells.h"
#include "planes/scan/voxels.h"
#include "unseen/core/point_cloud.h"
#include "unseen/core/random.h"
#include "unseen/io/points.h"
#include "unseen/planes/planes.h"

namespace unseen::planes::test {

/// Points on origin + s·a + t·b for s, t in (0,1), on a jittered grid of the given spacing (m), with normal
/// noise (m) across.
inline void add_rectangle(PointCloud& cloud, const Vec3& origin, const Vec3& a, const Vec3& b, double spacing,
                          double noise, Random& random) {
  const Vec3 n = a.cross(b).normalized();
  const int na = std::max(1, static_cast<int>(a.norm() / spacing)),
            nb = std::max(1, static_cast<int>(b.norm() / spacing));
  for (int i = 0; i < na; ++i)
    for (int k = 0; k < nb; ++k)
      cloud.positions.push_back(origin + a * ((i + random.uniform()) / na) +
                                b * ((k + random.uniform()) / nb) + noise * random.normal() * n);
}

/// A slanting rectangle of 2 by 1.6 m.
inline PointCloud plane_cloud(double spacing, double noise) {
  PointCloud cloud;
  Random random(9);
  add_rectangle(cloud, {0, 0, 0}, {2, 0, 0.4}, {0, 1.6, 0}, spacing, noise, random);
  return cloud;
}

/// The six inner faces of a box, its corner at `origin`.
inline PointCloud box_cloud(const Vec3& origin, const Vec3& size, double spacing, double noise,
                            std::uint64_t seed) {
  PointCloud cloud;
  Random random(seed);
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 a = Vec3::Unit((axis + 1) % 3) * size[(axis + 1) % 3],
               b = Vec3::Unit((axis + 2) % 3) * size[(axis + 2) % 3];
    add_rectangle(cloud, origin, a, b, spacing, noise, random);
    add_rectangle(cloud, origin + Vec3::Unit(axis) * size[axis], a, b, spacing, noise, random);
  }
  return cloud;
}

inline void turn(PointCloud& cloud, const Mat3& rotation) {
  for (Vec3& p : cloud.positions) p = rotation * p;
  for (Vec3f& n : cloud.normals) n = rotation.cast<float>() * n;
}

/// A fixed pseudo-random order of `count` things.
inline std::vector<std::size_t> shuffled(std::size_t count, std::uint64_t seed) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random(seed);
  for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[random.index(i)]);
  return order;
}

inline PointCloud reordered(const PointCloud& cloud, const std::vector<std::size_t>& order) {
  PointCloud result;
  result.viewpoint = cloud.viewpoint;
  for (const std::size_t i : order) {
    result.positions.push_back(cloud.positions[i]);
    if (!cloud.normals.empty()) result.normals.push_back(cloud.normals[i]);
  }
  return result;
}

inline VoxelGrid grid_of(const PointCloud& cloud, double edge) {
  VoxelBuilder builder(edge);
  builder.add(cloud);
  return VoxelGrid(builder);
}

/// The pieces that a grid as a whole is cut into.
inline CellSets pieces_of(const VoxelGrid& grid) {
  std::vector<int> region(grid.size());
  std::iota(region.begin(), region.end(), 0);
  return best_cut(grid, {}, region).pieces;
}

/// The cloud as a source that streams blocks and cannot be looked at as a whole.
class Stream final : public PointSource {
 public:
  Stream(const PointCloud& cloud, bool two_dimensional, std::size_t block)
      : cloud_(cloud), two_dimensional_(two_dimensional), block_(block) {}
  SourceInfo info() const override {
    SourceInfo info;
    info.name = "stream";
    info.has_normals = !cloud_.normals.empty();
    info.two_dimensional = two_dimensional_;
    return info;
  }
  bool next(PointCloud& block) override {
    block = PointCloud();
    const std::size_t end = std::min(cloud_.size(), at_ + block_);
    for (; at_ < end; ++at_) {
      block.positions.push_back(cloud_.positions[at_]);
      if (!cloud_.normals.empty()) block.normals.push_back(cloud_.normals[at_]);
    }
    return block.size() > 0;
  }
  void rewind() override { at_ = 0; }

 private:
  const PointCloud& cloud_;
  bool two_dimensional_;
  std::size_t block_, at_ = 0;
};

struct Run {
  Arrangement result;
  std::vector<int> plane_of_point;
};

inline Run run(PointSource& source, const Options& options, Context& context) {
  Run r;
  r.result = find_planes(source, options, context, [&](std::span<const Vec3>, std::span<const int> planes) {
    r.plane_of_point.insert(r.plane_of_point.end(), planes.begin(), planes.end());
  });
  return r;
}

inline Run run(const PointCloud& cloud, const Options& options, int threads = 2) {
  CloudSource source(cloud);
  Context context;
  context.threads = threads;
  return run(source, options, context);
}

inline Options with_scale(double scale, std::vector<double> angles = {90.0}) {
  Options options;
  options.scale = scale;
  options.angles = std::move(angles);
  return options;
}

inline constexpr const char* kNoScan = "no shared data beside the project: nothing to check";

/// A file of the shared scans, beside the project; empty where it is missing.
inline std::filesystem::path shared_scan(const std::string& name) {
  const auto file = std::filesystem::path(UNSEEN_SOURCE_DIR) / "../shared/data/planes" / name;
  return std::filesystem::exists(file) ? file : std::filesystem::path();
}

inline PointCloud read_cloud(const std::filesystem::path& file, bool& two_dimensional) {
  const auto source = io::open_points(file);
  two_dimensional = source->info().two_dimensional;
  return read_all(*source);
}

inline PointCloud read_cloud(const std::filesystem::path& file) {
  bool two_dimensional = false;
  return read_cloud(file, two_dimensional);
}

}  // namespace unseen::planes::test
