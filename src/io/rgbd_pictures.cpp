// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "io/file_bytes.h"
#include "io/image.h"
#include "io/rgbd_parts.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

cv::Mat read_image(const std::filesystem::path& path, const Camera& camera, const std::string& whose) {
  const cv::Mat image = decode_image(FileBytes::open(path)->view(), path.string());
  if (image.cols != camera.width || image.rows != camera.height)
    throw InputError(path.string(), "size", fmt::format("{} x {} pixels", image.cols, image.rows),
                     fmt::format("{} x {}, as {} has", camera.width, camera.height, whose));
  return image;
}

}  // namespace

std::vector<std::array<std::uint8_t, 3>> read_color(const std::filesystem::path& path, const Camera& camera) {
  cv::Mat image = read_image(path, camera, "the depth image");
  if (image.depth() == CV_16U) image.convertTo(image, CV_8U, 1.0 / 257.0);
  std::vector<std::array<std::uint8_t, 3>> colors;
  colors.reserve(image.total());
  const int channels = image.channels();
  for (int row = 0; row < image.rows; ++row) {
    const std::uint8_t* at = image.ptr(row);
    for (int column = 0; column < image.cols; ++column, at += channels) {
      if (channels < 3)
        colors.push_back({at[0], at[0], at[0]});
      else
        colors.push_back({at[2], at[1], at[0]});  // stored blue first
    }
  }
  return colors;
}

std::vector<std::int32_t> read_masks(const std::filesystem::path& path, const Camera& camera, const std::string& whose) {
  const cv::Mat image = read_image(path, camera, whose);
  if (image.depth() == CV_16U && image.channels() != 1)
    throw InputError(path.string(), "pixels", "colours of 16 bits", "grey values or 8-bit colours, 0 = no object");
  std::vector<std::int32_t> masks;
  masks.reserve(image.total());
  const int channels = image.channels();
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.cols; ++column) {
      if (image.depth() == CV_16U) {
        masks.push_back(image.at<std::uint16_t>(row, column));
        continue;
      }
      const std::uint8_t* at = image.ptr(row) + column * channels;
      masks.push_back(channels < 3 ? at[0] : at[2] << 16 | at[1] << 8 | at[0]);
    }
  return masks;
}

}  // namespace unseen::io
