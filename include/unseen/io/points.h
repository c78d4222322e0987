// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "unseen/core/context.h"
#include "unseen/core/point_cloud.h"

namespace unseen::io {

/// How to read what does not speak for itself.
struct ReadOptions {
  double threshold = 0.4;  ///< images: pixels darker than this share of white become points, in [0,1]
  std::vector<double> depth_range = {0.3, 3.5};  ///< m, depth folders: nearest and farthest depth that counts
  int depth_step = 1;                 ///< depth folders: every n-th pixel in both directions, at least 1
  int frame_step = 1;                 ///< depth folders: every n-th frame, at least 1
  std::size_t mesh_samples = 200000;  ///< meshes: points sampled on the surface
  std::uint64_t seed = 1;             ///< meshes: of the sampling
  /// Name of the field that holds a label a point; empty = label, segment_index, plane or class, if integer.
  std::string label_field;
};

/// Opens anything that holds points: PLY, PCD, XYZ/CSV/TXT/PWN/PTS, PTX, LAS, a mesh (OBJ, OFF, STL;
/// sampled), an image (PNG, JPEG; dark pixels become points of a drawing, x = column, y = rows from the
/// bottom), a folder of depth frames (`camera-intrinsics.txt`, `frame-*.depth.png` in mm, `frame-*.pose.txt`
/// camera to world), or a folder of point files (tiles, read in the order of their names). The content
/// decides what a file is; an ending that contradicts it is an error. Large files are streamed. A PLY with
/// faces gives its vertices. Throws InputError (file, field, found, expected) for what cannot be read; a
/// broken tile or frame among usable ones is a note in info() instead (of frames whose image is broken, once
/// they were reached).
std::unique_ptr<PointSource> open_points(const std::filesystem::path& path, const ReadOptions& options = {});

/// The same for the bytes of one file in memory; `name` stands for the file, ending included.
std::unique_ptr<PointSource> open_points_in_memory(std::string bytes, const std::string& name,
                                                   const ReadOptions& options = {});

}  // namespace unseen::io
