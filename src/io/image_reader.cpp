// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "io/image.h"
#include "io/readers.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

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

}  // namespace

std::unique_ptr<PointSource> open_image(const Input& input) {
  const double threshold = input.options.threshold;
  if (!(threshold >= 0.0 && threshold <= 1.0))
    throw InputError("read options", "threshold", std::to_string(threshold), "a number 0…1");
  const cv::Mat grey = brightness(decode_image(input.view(), input.name));
  PointCloud cloud;
  std::size_t faint = 0;
  for (int row = 0; row < grey.rows; ++row)
    for (int column = 0; column < grey.cols; ++column) {
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
  if (gaps)
    info.notes.push_back(count_of(faint, "grey pixel") + " left out: thin lines may have gaps; --threshold " + fmt::format("{}", kFaint) + " keeps them whole");
  return std::make_unique<OwnedCloudSource>(std::move(cloud), std::move(info));
}

}  // namespace unseen::io
