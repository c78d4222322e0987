// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace unseen::io {

/// The bytes of a file, mapped so that only what is being read occupies memory, or of a buffer.
class FileBytes {
 public:
  /// Throws InputError if the path is not a readable regular file.
  static std::shared_ptr<FileBytes> open(const std::filesystem::path& path);
  static std::shared_ptr<FileBytes> own(std::string bytes);
  ~FileBytes();
  FileBytes(const FileBytes&) = delete;
  FileBytes& operator=(const FileBytes&) = delete;

  std::string_view view() const { return view_; }
  /// Lets the pages before `offset` go; reading them again is possible and fetches them from the file.
  void release_before(std::size_t offset);

 private:
  FileBytes() = default;
  std::string_view view_;
  std::string owned_;
  bool mapped_ = false;
  std::size_t released_ = 0;
};

}  // namespace unseen::io
