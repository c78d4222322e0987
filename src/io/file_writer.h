// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdio>
#include <filesystem>
#include <string_view>

namespace unseen::io {

/// A new file that is written through a large buffer. Every failure is an InputError with path and reason.
class FileWriter {
 public:
  explicit FileWriter(const std::filesystem::path& path);
  ~FileWriter();
  FileWriter(const FileWriter&) = delete;
  FileWriter& operator=(const FileWriter&) = delete;

  void write(std::string_view bytes);
  /// Overwrites bytes from `offset` on, which must have been written before.
  void patch(std::size_t offset, std::string_view bytes);
  /// Writes what is still in the buffer; a file that was not closed is not complete.
  void close();

 private:
  [[noreturn]] void fail() const;
  std::filesystem::path path_;
  std::FILE* file_ = nullptr;
};

}  // namespace unseen::io
