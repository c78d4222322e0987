// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

namespace unseen::io {

/// A video file that is written frame by frame: MPEG-4 part 2 if it ends in .mp4, motion JPEG in .avi.
class VideoFile {
 public:
  /// Throws InputError (path, reason) if it cannot be written.
  VideoFile(const std::filesystem::path& path, int width, int height, double fps);
  ~VideoFile();
  VideoFile(const VideoFile&) = delete;
  VideoFile& operator=(const VideoFile&) = delete;

  /// One frame, 8-bit BGR, row by row.
  void add(const std::vector<std::uint8_t>& bgr);
  /// Completes the file. Throws InputError if it is not there.
  void close();

 private:
  struct Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace unseen::io
