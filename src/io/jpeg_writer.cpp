// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <opencv2/imgcodecs.hpp>
#include <stdexcept>

#include "io/codecs.h"
#include "unseen/io/write_image.h"

namespace unseen::io {

std::string jpeg_of(const std::vector<std::array<std::uint8_t, 3>>& colors, int width, int height, int quality) {
  if (width < 1 || height < 1 || colors.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    throw std::invalid_argument("a picture whose colours do not fill it");
  cv::Mat image(height, width, CV_8UC3);
  for (std::size_t i = 0; i < colors.size(); ++i)
    image.at<cv::Vec3b>(static_cast<int>(i) / width, static_cast<int>(i) % width) = {colors[i][2], colors[i][1], colors[i][0]};
  std::vector<std::uint8_t> bytes;
  if (!codecs().encode(".jpg", image, bytes, {cv::IMWRITE_JPEG_QUALITY, quality})) throw std::runtime_error("cannot make a JPEG");
  return {bytes.begin(), bytes.end()};
}

}  // namespace unseen::io
