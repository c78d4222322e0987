// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <memory>

#include "unseen/core/context.h"
#include "unseen/core/point_cloud.h"

namespace unseen::io {

/// How to read what does not speak for itself.
struct ReadOptions {
  double threshold = 0.4;                      ///< images: pixels darker than this share of white become points
  std::vector<double> depth_range = {0.3, 3.5};  ///< m, depth folders: nearest and farthest depth that counts
  int depth_step = 1;                          ///< depth folders: every n-th pixel in both directions
  int frame_step = 1;                          ///< depth folders: every n-th frame
  std::size_t mesh_samples = 200000;           ///< meshes: points sampled on the surface
};

/// Opens anything that holds points: PLY, PCD, XYZ/CSV/TXT/PWN/PTS, PTX, LAS, a mesh (OBJ, OFF, STL; sampled),
/// an image (PNG, JPEG; dark pixels become points of a drawing), a folder of depth frames
/// (`camera-intrinsics.txt`, `frame-*.depth.png` in mm, `frame-*.pose.txt` camera to world), or a folder of
/// such files (tiles). The content decides, not the ending. Large files are streamed.
/// Throws InputError (file, field, found, expected) for what cannot be read; a broken tile among usable ones
/// is a note in info() instead.
std::unique_ptr<PointSource> open_points(const std::filesystem::path& path, const ReadOptions& options = {});

}  // namespace unseen::io
