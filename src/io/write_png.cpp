// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/write_png.h"

#include <opencv2/imgcodecs.hpp>
#include <stdexcept>
#include <vector>

#include "io/codecs.h"
#include "io/file_writer.h"

namespace unseen::io {
namespace {

void check_size(int width, int height, std::size_t pixels) {
  if (width < 1 || height < 1 || pixels != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    throw std::invalid_argument("an image of another size than its pixels");
}

void write_png(const std::filesystem::path& path, const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  codecs().encode(".png", image, bytes, {});
  FileWriter writer(path);
  writer.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  writer.close();
}

}  // namespace

void write_grey_png(const std::filesystem::path& path, int width, int height, std::span<const std::uint16_t> pixels) {
  check_size(width, height, pixels.size());
  cv::Mat image(height, width, CV_16UC1);
  std::copy(pixels.begin(), pixels.end(), image.begin<std::uint16_t>());
  write_png(path, image);
}

void write_color_png(const std::filesystem::path& path, int width, int height,
                     std::span<const std::array<std::uint8_t, 3>> pixels) {
  check_size(width, height, pixels.size());
  cv::Mat image(height, width, CV_8UC3);
  auto to = image.begin<cv::Vec3b>();
  for (const auto& [red, green, blue] : pixels) *to++ = cv::Vec3b(blue, green, red);
  write_png(path, image);
}

}  // namespace unseen::io
