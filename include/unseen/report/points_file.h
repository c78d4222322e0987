// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::report {

/// points.ply while it grows: binary little-endian, `double x,y,z; int plane; int frame`, one vertex a point.
/// Blocks come as an AssignmentSink gets them. Frames are not known before the run ends, so finish() fills
/// them in. Throws InputError if the file cannot be written (no permission, disk full).
class PointsFile {
 public:
  explicit PointsFile(const std::filesystem::path& path);
  /// Appends points with their planes, −1 = none.
  void add(std::span<const Vec3> positions, std::span<const int> plane_of_point);
  /// Writes the number of points and the frame of each; frame_of_plane[p] is the frame of plane p.
  void finish(const std::vector<int>& frame_of_plane);

 private:
  void check(const char* what);

  std::filesystem::path path_;
  std::fstream file_;
  std::uint64_t count_ = 0;
};

}  // namespace unseen::report
