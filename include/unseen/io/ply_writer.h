// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace unseen::io {

/// A property of the vertices of a PLY file.
struct PlyColumn {
  enum class Type { uint8, int32, float32, float64 };
  std::string name;
  Type type = Type::float64;
};

/// Writes the vertices of a binary little-endian PLY row by row, without holding them: the count goes into
/// the header at the end. Writes to `path` itself; for a result that appears as a whole give it a path in an
/// OutputFolder or AtomicFile. Throws InputError (path, reason) if the file cannot be written.
class PlyWriter {
 public:
  PlyWriter(const std::filesystem::path& path, std::vector<PlyColumn> columns);
  ~PlyWriter();
  PlyWriter(const PlyWriter&) = delete;
  PlyWriter& operator=(const PlyWriter&) = delete;

  /// One vertex, a value a column; integers are rounded and clamped to their range.
  void add(std::span<const double> row);
  std::size_t count() const { return count_; }
  /// Completes header and file; nothing can be added after it.
  void finish();

 private:
  struct File;
  std::vector<PlyColumn> columns_;
  std::unique_ptr<File> file_;
  std::size_t count_ = 0;
};

}  // namespace unseen::io
