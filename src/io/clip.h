// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <memory>
#include <string>

#include "io/codecs.h"

namespace unseen::io {

/// A video file, read from its first frame to its last. Decoding is silent.
class Clip {
 public:
  /// Throws InputError for a file that is missing, not a video, or without a size that can be used.
  explicit Clip(std::string path);

  /// Decodes the next frame (8-bit BGR, turned as the file asks); false at the end. The image is overwritten by the next call.
  bool next(cv::Mat& frame);
  /// Time stamp of the frame that next() gave, s.
  double stamp() const { return stamp_; }

  const std::string& path() const { return path_; }
  double fps() const { return fps_; }    ///< what the file says; 0 = nothing that can be used
  int announced() const { return announced_; }  ///< frames, by the file's header; 0 = it does not say
  int turn() const { return turn_; }     ///< degrees clockwise, by the file's rotation flag

 private:
  std::string path_;
  std::unique_ptr<cv::VideoCapture> capture_;
  double fps_ = 0, stamp_ = 0;
  int announced_ = 0, turn_ = 0;
};

}  // namespace unseen::io
