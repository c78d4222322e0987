// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/videoio.hpp>
#include <string>
#include <vector>

namespace unseen::io {

/// OpenCV's readers and writers of pictures and videos. They need two hundred libraries, which take longer to load than a small scan takes to solve:
/// so they are a module of their own (codecs_module.cpp), loaded when one of them is first asked for.
struct Codecs {
  std::unique_ptr<cv::VideoCapture> (*video_reader)();
  /// With FFmpeg; isOpened() tells whether the file can be written.
  std::unique_ptr<cv::VideoWriter> (*video_writer)(const std::string& path, int fourcc, double fps, cv::Size size);
  cv::Mat (*decode)(cv::InputArray bytes, int flags);  ///< cv::imdecode
  bool (*encode)(const std::string& extension, cv::InputArray image, std::vector<std::uint8_t>& bytes, const std::vector<int>& parameters);  ///< cv::imencode
};

/// Throws std::runtime_error where the module is missing.
const Codecs& codecs();

/// cv::VideoWriter::fourcc, which is in the module.
constexpr int fourcc(char a, char b, char c, char d) { return a | b << 8 | c << 16 | d << 24; }

}  // namespace unseen::io
