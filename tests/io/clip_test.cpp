// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/clip.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/videoio.hpp>

namespace unseen::io {
namespace {

/// Writes a landscape video whose upper left corner is white, with a track matrix (a, b, c, d of ISO/IEC 14496-12: x' = a x + c y, y' = b x + d y).
void write_turned(const std::string& path, const std::array<int, 4>& matrix) {
  cv::Mat frame(240, 320, CV_8UC3, cv::Scalar::all(20));
  frame(cv::Rect(0, 0, 100, 80)).setTo(cv::Scalar::all(230));
  {
    cv::VideoWriter writer(path, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), 30.0, frame.size());
    ASSERT_TRUE(writer.isOpened());
    for (int k = 0; k < 3; ++k) writer.write(frame);
  }
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const std::size_t header = bytes.find("tkhd");
  ASSERT_NE(header, std::string::npos);
  for (std::size_t k = 0; k < 4; ++k) {
    const std::size_t at = header + 44 + 4 * (k < 2 ? k : k + 1);  // a b u c d …, 16.16 fixed point
    const auto value = static_cast<std::uint32_t>(matrix[k] * 65536);
    for (std::size_t b = 0; b < 4; ++b) bytes[at + b] = static_cast<char>(value >> (24 - 8 * b));
  }
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Which corner of a picture is white: 0 upper left, 1 upper right, 2 lower right, 3 lower left.
int white_corner(const cv::Mat& picture) {
  const cv::Point right(picture.cols - 20, 0), down(0, picture.rows - 20), inside(10, 10);
  const std::array<cv::Point, 4> corners = {inside, inside + right - cv::Point(10, 0), inside + right + down - cv::Point(10, 10), inside + down - cv::Point(0, 10)};
  for (int k = 0; k < 4; ++k)
    if (picture.at<cv::Vec3b>(corners[static_cast<std::size_t>(k)])[0] > 150) return k;
  return -1;
}

TEST(Clip, IsTurnedAsTheFileAsks) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / ("unseen_clip" + std::to_string(::getpid()) + ".mp4");
  const std::array<std::array<int, 4>, 4> matrices = {{{1, 0, 0, 1}, {0, 1, -1, 0}, {-1, 0, 0, -1}, {0, -1, 1, 0}}};  // a quarter more clockwise each
  for (int quarters = 0; quarters < 4; ++quarters) {
    write_turned(path.string(), matrices[static_cast<std::size_t>(quarters)]);
    Clip clip(path.string());
    EXPECT_EQ(clip.turn(), 90 * quarters);
    for (int k = 0; k < 3; ++k) {
      cv::Mat frame;
      ASSERT_TRUE(clip.next(frame));
      EXPECT_EQ(frame.size(), quarters % 2 == 0 ? cv::Size(320, 240) : cv::Size(240, 320));
      EXPECT_EQ(white_corner(frame), quarters);
    }
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace unseen::io
