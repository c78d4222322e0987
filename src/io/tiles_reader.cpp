// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "io/columns.h"
#include "io/output_place.h"
#include "io/readers.h"
#include "io/sniff.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

namespace fs = std::filesystem;

Format format_by_name(const fs::path& path) {
  std::string extension = lower(path.extension().string());
  if (!extension.empty()) extension.erase(0, 1);
  return format_of_extension(extension);
}

bool is_tile(const fs::path& path) {
  switch (format_by_name(path)) {
    case Format::ply:
    case Format::pcd:
    case Format::las:
    case Format::e57:
    case Format::ptx:
    case Format::text:
      return true;
    default:
      return false;
  }
}

bool is_mesh_or_picture(const fs::path& path) { return format_by_name(path) != Format::unknown && !is_tile(path); }

/// One file after another; only one is open at a time.
class TilesSource final : public PointSource {
 public:
  TilesSource(const fs::path& folder, const ReadOptions& options) : options_(options) {
    info_.name = folder.string();
    const std::vector<fs::path> paths = find_tiles(folder);
    info_.point_count = 0;
    info_.two_dimensional = true;
    for (const fs::path& path : paths) inspect(path);
    if (tiles_.empty())
      throw InputError(info_.name, "folder",
                       paths.empty() ? (info_.notes.empty() ? "no point files" : "no point files; " + info_.notes.front()) : "no usable tile (" + info_.notes.back() + ")",
                       "point files, or depth frames with camera-intrinsics.txt");
    check_together();
    info_.has_normals = keep_.normals;
    if (dropped_) info_.notes.push_back("normals, colours or labels that only some tiles have left out");
  }

  SourceInfo info() const override { return info_; }

  void rewind() override {
    at_ = 0;
    tile_.reset();
  }

  bool next(PointCloud& block) override {
    while (at_ < tiles_.size()) {
      if (!tile_) tile_ = open_file(input_from(tiles_[at_], options_));
      if (tile_->next(block)) {
        if (!keep_.normals) block.normals.clear();
        if (!keep_.colors) block.colors.clear();
        if (!keep_.labels) block.labels.clear();
        return true;
      }
      tile_.reset();
      ++at_;
    }
    return false;
  }

 private:
  /// In the order of their names, but for those that an earlier run wrote there as its result.
  std::vector<fs::path> find_tiles(const fs::path& folder) {
    const auto results = result_files(folder);
    std::vector<fs::path> paths;
    std::vector<std::string> others;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (!entry.is_regular_file() || name.front() == '.') continue;
      if (!is_tile(entry.path())) {
        if (is_mesh_or_picture(entry.path())) others.push_back(name);
        continue;
      }
      if (results.count(name) > 0)
        info_.notes.push_back(name + ": from the result of an earlier run, not read as a tile");
      else
        paths.push_back(entry.path());
    }
    std::sort(info_.notes.begin(), info_.notes.end());
    if (!others.empty())
      info_.notes.push_back(fmt::format("meshes and pictures are not read as tiles: {}{}", *std::min_element(others.begin(), others.end()), others.size() > 1 ? fmt::format(" and {} more", others.size() - 1) : ""));
    std::sort(paths.begin(), paths.end());
    return paths;
  }

  /// Reads a tile once, so that what is broken is known before anything is computed.
  void inspect(const fs::path& path) {
    try {
      const auto tile = open_file(input_from(path, options_));
      PointCloud block;
      std::size_t count = 0;
      Eigen::AlignedBox3d box;
      Attributes has;
      while (tile->next(block)) {
        count += block.size();
        for (const Vec3& p : block.positions)
          if (p.allFinite()) box.extend(p);
        has = {!block.normals.empty(), !block.colors.empty(), !block.labels.empty()};
      }
      if (count == 0) throw InputError(path.string(), "content", "no points", "points");
      add(path, tile->info(), has, count);
      boxes_.push_back(box);
    } catch (const InputError& error) {
      info_.notes.push_back(std::string("tile left out: ") + error.what());
    }
  }

  void add(const fs::path& path, const SourceInfo& info, const Attributes& has, std::size_t count) {
    for (const std::string& note : info.notes) {
      std::string line = path.filename().string() + ": " + note;
      info_.notes.push_back(std::move(line));
    }
    const auto merge = [&](bool& keep, bool tile_has) {
      if (!tiles_.empty() && keep != tile_has) dropped_ = true;
      keep = (tiles_.empty() || keep) && tile_has;
    };
    merge(keep_.normals, has.normals);
    merge(keep_.colors, has.colors);
    merge(keep_.labels, has.labels);
    info_.two_dimensional = info_.two_dimensional && info.two_dimensional;
    *info_.point_count += count;
    tiles_.push_back(path);
  }

  /// Tiles in coordinates of their own beside others in those of a map have nothing in common.
  void check_together() const {
    constexpr double kFarApart = 1e6;  // m
    for (std::size_t t = 1; t < tiles_.size(); ++t)
      if (const double apart = boxes_.front().exteriorDistance(boxes_[t]); apart > kFarApart && std::isfinite(apart))
        throw InputError(info_.name, "tiles",
                         fmt::format("{} and {} {:.0f} km apart", tiles_.front().filename().string(), tiles_[t].filename().string(), 1e-3 * apart),
                         "tiles in the same coordinates");
  }

  ReadOptions options_;
  SourceInfo info_;
  std::vector<fs::path> tiles_;
  std::vector<Eigen::AlignedBox3d> boxes_;  ///< of the tiles' finite points; infinitely far from all others where there are none
  Attributes keep_;  ///< what all tiles have
  bool dropped_ = false;
  std::size_t at_ = 0;
  std::unique_ptr<PointSource> tile_;
};

}  // namespace

std::unique_ptr<PointSource> open_tiles(const fs::path& folder, const ReadOptions& options) {
  return std::make_unique<TilesSource>(folder, options);
}

}  // namespace unseen::io
