// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "io/file_bytes.h"
#include "unseen/core/mesh.h"
#include "unseen/io/points.h"

namespace unseen::io {

/// Points a block.
inline constexpr std::size_t kBlock = std::size_t{1} << 16;

/// One file on its way to a reader.
struct Input {
  std::shared_ptr<FileBytes> bytes;
  std::string name;       ///< starts the messages
  std::string extension;  ///< lower case, without the dot
  ReadOptions options;

  std::string_view view() const { return bytes->view(); }
};

std::unique_ptr<PointSource> open_ply(const Input& input);
std::unique_ptr<PointSource> open_pcd(const Input& input);
std::unique_ptr<PointSource> open_text(const Input& input);
std::unique_ptr<PointSource> open_ptx(const Input& input);
std::unique_ptr<PointSource> open_las(const Input& input);
std::unique_ptr<PointSource> open_image(const Input& input);
/// OBJ, OFF or STL: samples of the surface, or the vertices if there is none.
std::unique_ptr<PointSource> open_mesh(const Input& input);
std::unique_ptr<PointSource> open_depth_folder(const std::filesystem::path& folder,
                                               const ReadOptions& options);
std::unique_ptr<PointSource> open_tiles(const std::filesystem::path& folder, const ReadOptions& options);

/// Opens one file by its content.
std::unique_ptr<PointSource> open_file(const Input& input);
Input input_from(const std::filesystem::path& path, const ReadOptions& options);
Input input_from_memory(std::string bytes, const std::string& name, const ReadOptions& options);

/// Meshes with their degenerate triangles; read_mesh() takes those out.
TriangleMesh read_obj(const Input& input);
TriangleMesh read_off(const Input& input);
TriangleMesh read_stl(const Input& input);
TriangleMesh read_ply_mesh(const Input& input);
/// Any of them by its content, without degenerate triangles.
TriangleMesh read_mesh_file(const Input& input);

/// A source that owns its cloud.
class OwnedCloudSource final : public PointSource {
 public:
  OwnedCloudSource(PointCloud cloud, SourceInfo info);
  SourceInfo info() const override { return info_; }
  bool next(PointCloud& block) override { return blocks_.next(block); }
  void rewind() override { blocks_.rewind(); }
  const PointCloud* cloud() const override { return &cloud_; }

 private:
  PointCloud cloud_;
  SourceInfo info_;
  CloudSource blocks_;
};

}  // namespace unseen::io
