// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <string>

#include "io/codecs.h"
#include "unseen/collision/types.h"
#include "unseen/core/context.h"
#include "unseen/core/geometry.h"
#include "unseen/core/random.h"

namespace unseen::collision::test {

inline constexpr int kWidth = 320, kHeight = 240;

/// A folder of its own that goes away with the test.
class Scratch {
 public:
  explicit Scratch(const std::string& name) : folder_(std::filesystem::temp_directory_path() / ("unseen_" + name + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Scratch() { std::filesystem::remove_all(folder_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  std::string file(const std::string& name) const { return (folder_ / name).string(); }

 private:
  std::filesystem::path folder_;
};

/// A wall with blotches: something for a stabiliser to hold on to. Larger than a frame by `margin` on every side.
inline cv::Mat wall(int margin = 0) {
  cv::Mat picture(kHeight + 2 * margin, kWidth + 2 * margin, CV_8UC3, cv::Scalar(120, 130, 140));
  Random random(5);
  for (int i = 0; i < 160; ++i) {
    const cv::Point at(static_cast<int>(random.index(static_cast<std::size_t>(picture.cols))), static_cast<int>(random.index(static_cast<std::size_t>(picture.rows))));
    const double light = random.uniform(70, 190);
    cv::rectangle(picture, at, at + cv::Point(14, 9), cv::Scalar(light, light * 0.95, light * 0.9), cv::FILLED);
  }
  cv::GaussianBlur(picture, picture, {5, 5}, 1.2);
  return picture;
}

/// A disc with a soft edge; its centre is exact to a sixteenth of a pixel.
inline void draw_disc(cv::Mat& frame, const Vec2& center, double radius, const cv::Scalar& color) {
  cv::circle(frame, {static_cast<int>(std::lround(16 * center.x())), static_cast<int>(std::lround(16 * center.y()))}, static_cast<int>(std::lround(16 * radius)),
             color, cv::FILLED, cv::LINE_AA, 4);
}

inline void add_noise(cv::Mat& frame, double sigma, Random& random) {
  for (int y = 0; y < frame.rows; ++y)
    for (int x = 0; x < frame.cols; ++x)
      for (int c = 0; c < 3; ++c)
        frame.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<unsigned char>(frame.at<cv::Vec3b>(y, x)[c] + sigma * random.normal());
}

/// Writes a lossless video of what `draw` gives for each frame.
inline void write_video(const std::string& path, int frames, const std::function<cv::Mat(int)>& draw, double fps = 50.0) {
  const auto writer = io::codecs().video_writer(path, io::fourcc('F', 'F', 'V', '1'), fps, {kWidth, kHeight});
  for (int k = 0; k < frames; ++k) writer->write(draw(k));
}

inline const cv::Scalar kRed(40, 40, 210);

inline Shot shot_of(const std::string& path) {
  Shot shot;
  shot.name = shot.video = path;
  return shot;
}

/// Where the disc of most tests is.
inline Vec2 thrown(int k) { return {30.0 + 6.3 * k, 190.0 - 12.0 * k + 0.3 * k * k}; }

inline bool warned(Context& context, const std::string& word) {
  for (const std::string& w : context.take_warnings())
    if (w.find(word) != std::string::npos) return true;
  return false;
}

}  // namespace unseen::collision::test
