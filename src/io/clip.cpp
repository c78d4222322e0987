// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/clip.h"

#include <cmath>
#include <filesystem>
#include <opencv2/core.hpp>

#include "io/quiet_opencv.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

constexpr const char* kExpectedVideo = "a video that FFmpeg can decode";

/// Degrees clockwise by which the file asks to be turned. OpenCV 4.6 says how far counter-clockwise, and would turn pictures so.
int asked_turn(const cv::VideoCapture& capture) {
  constexpr int kSign = CV_VERSION_MAJOR == 4 && CV_VERSION_MINOR == 6 ? -1 : 1;
  const auto turn = kSign * static_cast<int>(std::lround(capture.get(cv::CAP_PROP_ORIENTATION_META)));
  return (turn % 360 + 360) % 360;
}

}  // namespace

Clip::Clip(std::string path) : path_(std::move(path)), capture_(codecs().video_reader()) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path_, error)) throw InputError(path_, "video", std::filesystem::is_directory(path_, error) ? "a folder" : "no such file", kExpectedVideo);
  const QuietOpenCv quiet;
  bool open = false;
  try {
    open = capture_->open(path_, cv::CAP_FFMPEG);
  } catch (const cv::Exception&) {
    open = false;
  }
  if (!open) throw InputError(path_, "video", "no video stream that can be read", kExpectedVideo);
  capture_->set(cv::CAP_PROP_ORIENTATION_AUTO, 0.0);
  const double fps = capture_->get(cv::CAP_PROP_FPS), count = capture_->get(cv::CAP_PROP_FRAME_COUNT);
  fps_ = std::isfinite(fps) && fps > 0.1 && fps < 1e5 ? fps : 0.0;
  announced_ = std::isfinite(count) && count > 0.0 && count < 1e8 ? static_cast<int>(std::lround(count)) : 0;
  turn_ = asked_turn(*capture_);
}

bool Clip::next(cv::Mat& frame) {
  const QuietOpenCv quiet;
  try {
    if (!capture_->read(frame) || frame.empty()) return false;
  } catch (const cv::Exception&) {
    return false;
  }
  if (turn_ == 90) cv::rotate(frame, frame, cv::ROTATE_90_CLOCKWISE);
  if (turn_ == 180) cv::rotate(frame, frame, cv::ROTATE_180);
  if (turn_ == 270) cv::rotate(frame, frame, cv::ROTATE_90_COUNTERCLOCKWISE);
  stamp_ = 1e-3 * capture_->get(cv::CAP_PROP_POS_MSEC);
  return true;
}

}  // namespace unseen::io
