// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "unseen/core/geometry.h"

namespace unseen {

/// Points in the order of their source. Optional arrays are empty or as long as `positions`.
struct PointCloud {
  std::vector<Vec3> positions;  ///< metres; may hold non-finite entries, as files do
  std::vector<Vec3f> normals;   ///< unit length where usable; sign is not relied upon
  std::vector<std::array<std::uint8_t, 3>> colors;
  std::vector<std::int32_t> labels;  ///< e.g. the true plane of a point; -1 = none
  std::optional<Vec3> viewpoint;     ///< where the sensor stood, if one position is known

  std::size_t size() const { return positions.size(); }
};

/// What is known of a source before its points are read.
struct SourceInfo {
  std::string name;                        ///< for messages: file, folder or "memory"
  std::optional<std::size_t> point_count;  ///< if known without reading
  bool has_normals = false;
  bool two_dimensional = false;  ///< points of a drawing; z = 0
  bool in_memory = false;        ///< reading again costs next to nothing
  std::optional<Vec3> viewpoint;
  double rounding = 0;  ///< m, how far apart the values are that depths have; 0 = not known: it takes a first pass
  std::vector<std::string> notes;  ///< what a reader had to guess or leave out, one line each
};

/// A stream of points that can be read more than once, so that a cloud need not fit in memory.
class PointSource {
 public:
  virtual ~PointSource() = default;
  virtual SourceInfo info() const = 0;
  /// Replaces the content of `block` by the next points, in source order; false at the end.
  /// Throws InputError where the file turns out to be broken.
  virtual bool next(PointCloud& block) = 0;
  /// Starts again at the first point; the same points come in the same order.
  virtual void rewind() = 0;
  /// All points as one cloud, if that is what the source holds anyway; else null.
  virtual const PointCloud* cloud() const { return nullptr; }
};

/// A cloud in memory as a source. Keeps a reference: the cloud must outlive it.
class CloudSource final : public PointSource {
 public:
  explicit CloudSource(const PointCloud& cloud, std::string name = "memory");
  SourceInfo info() const override;
  bool next(PointCloud& block) override;
  void rewind() override { at_ = 0; }
  const PointCloud* cloud() const override { return &cloud_; }

 private:
  const PointCloud& cloud_;
  std::string name_;
  std::size_t at_ = 0;
};

/// Reads a whole source into memory.
PointCloud read_all(PointSource& source);

/// Calls `body` with each block of the source from its start; `first` counts the points before the block.
/// A source that has its cloud in memory gives it as one block, without a copy.
void for_each_block(PointSource& source,
                    const std::function<void(const PointCloud& block, std::size_t first)>& body);

}  // namespace unseen
