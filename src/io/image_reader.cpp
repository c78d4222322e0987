// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "io/image.h"
#include "io/readers.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

constexpr double kMostlyDark = 0.7;   // of the pixels
constexpr double kBroad = 0.015;      // of the picture's shorter side: 3 mm of A4
constexpr int kLeastBroad = 12;       // pixels
constexpr double kMuch = 0.3, kAll = 0.99;  // of the dark pixels
constexpr double kFaint = 0.6, kManyFaint = 0.35;  // of the dark pixels; an anti-aliased line one pixel wide has half as many

/// Brightness of each pixel in [0,1], over white where the image is transparent.
cv::Mat brightness(cv::Mat image) {
  const double white = image.depth() == CV_16U ? 65535.0 : 255.0;
  cv::Mat grey, alpha;
  if (image.channels() == 4) {
    cv::extractChannel(image, alpha, 3);
    cv::cvtColor(image, grey, cv::COLOR_BGRA2GRAY);
  } else if (image.channels() == 3) {
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
  } else {
    cv::extractChannel(image, grey, 0);
    if (image.channels() == 2) cv::extractChannel(image, alpha, 1);
  }
  grey.convertTo(grey, CV_32F, 1.0 / white);
  if (alpha.empty()) return grey;
  alpha.convertTo(alpha, CV_32F, 1.0 / white);
  return grey.mul(alpha) + (1.0 - alpha);
}

/// True if most pixels are dark, but not all: light lines on a dark ground.
bool is_inverted(const cv::Mat& grey, double threshold) {
  const auto dark = static_cast<std::size_t>(cv::countNonZero(grey < threshold));
  return dark < grey.total() && static_cast<double>(dark) > kMostlyDark * static_cast<double>(grey.total());
}

/// Broad dark areas that touch the picture's border, as a scanner's lid or a table around the sheet leaves them, if they are much of what is dark: 255 where
/// they are. Walls are narrower.
cv::Mat surroundings(const cv::Mat& dark) {
  const int broad = std::max(kLeastBroad, static_cast<int>(kBroad * std::min(dark.rows, dark.cols)));
  cv::Mat outside = cv::Mat::zeros(dark.size(), CV_8U);
  int at_border = 0;
  for (const cv::Mat& side : {dark.row(0), dark.row(dark.rows - 1), dark.col(0), dark.col(dark.cols - 1)}) at_border += cv::countNonZero(side);
  if (at_border < broad) return outside;
  cv::Mat framed, areas, labels, stats, centers;
  cv::copyMakeBorder(dark, framed, broad, broad, broad, broad, cv::BORDER_REPLICATE);  // what leaves the picture goes on
  cv::morphologyEx(framed, areas, cv::MORPH_OPEN, cv::Mat::ones(broad, broad, CV_8U));
  const int count = cv::connectedComponentsWithStats(areas(cv::Rect(broad, broad, dark.cols, dark.rows)), labels, stats, centers);
  std::vector<std::uint8_t> mark(static_cast<std::size_t>(count), 0);
  for (int k = 1; k < count; ++k) {
    const cv::Rect box(stats.at<int>(k, cv::CC_STAT_LEFT), stats.at<int>(k, cv::CC_STAT_TOP), stats.at<int>(k, cv::CC_STAT_WIDTH), stats.at<int>(k, cv::CC_STAT_HEIGHT));
    if (box.x == 0 || box.y == 0 || box.br().x == dark.cols || box.br().y == dark.rows) mark[static_cast<std::size_t>(k)] = 255;
  }
  std::transform(labels.begin<int>(), labels.end<int>(), outside.begin<std::uint8_t>(), [&](int label) { return mark[static_cast<std::size_t>(label)]; });
  const double share = static_cast<double>(cv::countNonZero(outside)) / std::max(1, cv::countNonZero(dark));
  if (share < kMuch || share > kAll) return cv::Mat::zeros(dark.size(), CV_8U);
  cv::dilate(outside, outside, cv::Mat::ones(5, 5, CV_8U));  // with its blurred rim
  return outside;
}

}  // namespace

std::unique_ptr<PointSource> open_image(const Input& input) {
  const double threshold = input.options.threshold;
  if (!(threshold >= 0.0 && threshold <= 1.0))
    throw InputError("read options", "threshold", std::to_string(threshold), "a number 0…1");
  cv::Mat grey = brightness(decode_image(input.view(), input.name));
  const bool inverted = is_inverted(grey, threshold);
  if (inverted) grey = 1.0 - grey;
  const cv::Mat outside = surroundings(grey < threshold);
  PointCloud cloud;
  std::size_t faint = 0;
  for (int row = 0; row < grey.rows; ++row)
    for (int column = 0; column < grey.cols; ++column) {
      if (outside.at<std::uint8_t>(row, column) != 0) continue;
      const double value = grey.at<float>(row, column);
      if (value < threshold) cloud.positions.emplace_back(column, grey.rows - 1 - row, 0.0);
      faint += value >= threshold && value < kFaint;
    }
  if (cloud.size() == 0)
    throw InputError(input.name, "pixels", "none darker than " + std::to_string(threshold), "dark pixels (--threshold says how dark)");
  const bool gaps = static_cast<double>(faint) > kManyFaint * static_cast<double>(cloud.size());
  SourceInfo info;
  info.name = input.name;
  info.two_dimensional = true;
  info.notes.push_back(count_of(cloud.size(), "dark pixel") + " of " + std::to_string(grey.cols) + " x " +
                       std::to_string(grey.rows));
  if (inverted) info.notes.push_back("most of the picture is dark: read as light lines on a dark ground");
  if (cv::countNonZero(outside) > 0) info.notes.push_back("broad dark areas at the picture's border left out");
  if (gaps)
    info.notes.push_back(count_of(faint, "grey pixel") + " left out: thin lines may have gaps; --threshold " + fmt::format("{}", kFaint) + " takes them too");
  return std::make_unique<OwnedCloudSource>(std::move(cloud), std::move(info));
}

}  // namespace unseen::io
