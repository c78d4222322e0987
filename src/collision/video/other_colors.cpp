// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/other_colors.h"

#include <algorithm>
#include <array>

namespace unseen::collision {
namespace {

constexpr float kOther = 20.0F;       // grey levels, and
constexpr float kOtherSigmas = 6.0F;  // σ: farther from the median is another colour,
constexpr float kOtherMost = 40.0F;   // grey levels, whatever σ is: that of a place that is covered in half of the frames tells nothing
constexpr double kShare = 0.08;       // of the frames that have to show it
constexpr int kFewest = 3;            // frames
constexpr double kBetween = 0.1;      // of the frames of another colour: more of them between those of the median, and something only went past
constexpr int kFollowed = 6;          // colours of a pixel

/// A pixel's colours other than the median's, as the frames come.
class Colors {
 public:
  void add_median() {
    for (int i = 0; i < size_; ++i) {
      if (median_seen_) shown_[i].between += shown_[i].waiting;
      shown_[i].waiting = 0;
    }
    median_seen_ = true;
  }
  void add(const cv::Vec3f& color) {
    int i = 0;
    while (i < size_ && farthest(color, shown_[i].mean()) > kOther) ++i;
    if (i == kFollowed) return;
    size_ = std::max(size_, i + 1);
    shown_[i].sum += color;
    ++shown_[i].count, ++shown_[i].waiting;
  }
  /// Those of enough frames.
  std::vector<cv::Vec3b> lasting(double fewest) const {
    std::vector<cv::Vec3b> colors;
    for (int i = 0; i < size_; ++i)
      if (shown_[i].count >= fewest) colors.emplace_back(shown_[i].mean());
    return colors;
  }
  bool follow(double fewest) const {
    return std::any_of(shown_.begin(), shown_.begin() + size_, [&](const Shown& s) { return s.count >= fewest && s.between <= kBetween * s.count; });
  }

 private:
  struct Shown {
    cv::Vec3f sum;
    int count = 0;
    int waiting = 0;  ///< of them, since the median's colour was seen
    int between = 0;  ///< after a frame of the median's colour, and before another
    cv::Vec3f mean() const { return sum / std::max(1, count); }
  };
  std::array<Shown, kFollowed> shown_;
  int size_ = 0;
  bool median_seen_ = false;
};

}  // namespace

OtherColors other_colors(const std::vector<cv::Mat>& frames, const cv::Mat& noise, const cv::Mat& median, const Context& context) {
  const double fewest = std::max<double>(kFewest, kShare * static_cast<double>(frames.size()));
  OtherColors others{cv::Mat::zeros(median.size(), CV_8U), {}, cv::Mat::zeros(median.size(), CV_8U)};
  for (cv::Mat& colors : others.colors) colors.create(median.size(), CV_8UC3);
  parallel_blocks(context, static_cast<std::size_t>(median.rows), 16, [&](std::size_t begin, std::size_t end) {
    std::vector<Colors> row;
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      row.assign(static_cast<std::size_t>(median.cols), {});
      for (const cv::Mat& frame : frames)
        for (int x = 0; x < median.cols; ++x) {
          const cv::Vec3f f = frame.at<cv::Vec3b>(y, x);
          if (farthest(f, median.at<cv::Vec3b>(y, x)) > std::clamp(kOtherSigmas * noise.at<float>(y, x), kOther, kOtherMost)) row[static_cast<std::size_t>(x)].add(f);
          else row[static_cast<std::size_t>(x)].add_median();
        }
      for (int x = 0; x < median.cols; ++x) {
        const Colors& colors = row[static_cast<std::size_t>(x)];
        int count = 0;
        for (const cv::Vec3b& color : colors.lasting(fewest))
          if (count < OtherColors::kMost) others.colors[static_cast<std::size_t>(count++)].at<cv::Vec3b>(y, x) = color;
        others.count.at<unsigned char>(y, x) = static_cast<unsigned char>(count);
        if (colors.follow(fewest)) others.follow.at<unsigned char>(y, x) = 255;
      }
    }
  });
  return others;
}

}  // namespace unseen::collision
