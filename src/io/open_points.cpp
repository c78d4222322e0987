// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/depth_frames.h"
#include "io/ply_header.h"
#include "io/readers.h"
#include "io/sniff.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

std::string extension_of(const std::filesystem::path& path) {
  const std::string extension = lower(path.extension().string());
  return extension.empty() ? extension : extension.substr(1);
}

/// A mesh that somebody drew, rather than a meshed scan, whose vertices say more than its faces.
bool is_drawn_mesh(const Input& input) {
  constexpr std::size_t kFewVertices = 1000;
  const PlyHeader header = read_ply_header(input.view(), input.name);
  const PlyElement *vertex = header.find("vertex"), *face = header.find("face");
  return vertex && vertex->count < kFewVertices && face && face->count > 0;
}

}  // namespace

OwnedCloudSource::OwnedCloudSource(PointCloud cloud, SourceInfo info)
    : cloud_(std::move(cloud)), info_(std::move(info)), blocks_(cloud_, info_.name) {
  info_.point_count = cloud_.size();
  info_.has_normals = !cloud_.normals.empty();
  info_.in_memory = true;
}

Input input_from(const std::filesystem::path& path, const ReadOptions& options) {
  return {FileBytes::open(path), path.string(), extension_of(path), options};
}

Input input_from_memory(std::string bytes, const std::string& name, const ReadOptions& options) {
  return {FileBytes::own(std::move(bytes)), name, extension_of(name), options};
}

std::unique_ptr<PointSource> open_file(const Input& input) {
  switch (decide_format(input.view(), input.name, input.extension)) {
    case Format::ply:
      return input.options.label_field.empty() && is_drawn_mesh(input) ? open_mesh(input) : open_ply(input);
    case Format::pcd:
      return open_pcd(input);
    case Format::las:
      return open_las(input);
    case Format::png:
    case Format::jpeg:
      return open_image(input);
    case Format::obj:
    case Format::off:
    case Format::stl:
      return open_mesh(input);
    case Format::ptx:
      return open_ptx(input);
    case Format::e57:
      throw InputError(input.name, "content", "an E57 file",
                       "LAS or PLY: convert it with CloudCompare or PDAL");
    default:
      return open_text(input);
  }
}

std::unique_ptr<PointSource> open_points(const std::filesystem::path& path, const ReadOptions& options) {
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) return open_file(input_from(path, options));
  try {
    return is_depth_folder(path) ? open_depth_folder(path, options) : open_tiles(path, options);
  } catch (const std::filesystem::filesystem_error& fault) {
    throw InputError(path.string(), "folder", fault.code().message(), "a readable folder");
  }
}

std::unique_ptr<PointSource> open_points_in_memory(std::string bytes, const std::string& name,
                                                   const ReadOptions& options) {
  return open_file(input_from_memory(std::move(bytes), name, options));
}

}  // namespace unseen::io
