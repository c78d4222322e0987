// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/quiet_opencv.h"

#include <cstdlib>
#include <mutex>

namespace unseen::io {

QuietOpenCv::QuietOpenCv() : level_(cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT)) {
  static std::once_flag once;
  std::call_once(once, [] { ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0); });
}

QuietOpenCv::~QuietOpenCv() { cv::utils::logging::setLogLevel(level_); }

}  // namespace unseen::io
