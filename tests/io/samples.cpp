// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/samples.h"

#include <unistd.h>

#include <atomic>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "unseen/core/error.h"

namespace unseen::io {

ScratchFolder::ScratchFolder() {
  static std::atomic<int> counter{0};
  path = std::filesystem::temp_directory_path() /
         ("unseen_io_" + std::to_string(::getpid()) + "_" + std::to_string(counter++));
  std::filesystem::create_directories(path);
}

ScratchFolder::~ScratchFolder() {
  std::error_code error;
  std::filesystem::remove_all(path, error);
}

void write_file(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

std::string read_file(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

PointCloud read(const std::string& bytes, const std::string& name, const ReadOptions& options) {
  return read_all(*open_points_in_memory(bytes, name, options));
}

void expect_error(const std::function<void()>& body, const std::vector<std::string>& parts) {
  try {
    body();
    ADD_FAILURE() << "no error; wanted " << parts.back();
  } catch (const InputError& error) {
    for (const std::string& part : parts)
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
          << error.what() << "\nlacks: " << part;
  }
}

void expect_read_error(const std::string& bytes, const std::string& name,
                       const std::vector<std::string>& parts) {
  std::vector<std::string> all = parts;
  all.push_back(name);
  expect_error([&] { read(bytes, name); }, all);
}

void expect_same(const PointCloud& a, const PointCloud& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.positions.data(), b.positions.data(), a.size() * sizeof(Vec3)), 0);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.colors, b.colors);
  EXPECT_EQ(a.labels, b.labels);
}

std::string ply_ascii() {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
         "property int label\nend_header\n500000.123456789 1 2 7\n-1 -2 -3 8\n0.5 nan 1e-3 9\n";
}

std::string ply_binary(bool big) {
  std::string s =
      std::string("ply\nformat binary_") + (big ? "big" : "little") +
      "_endian 1.0\nelement camera 2\nproperty uchar id\nproperty list uchar short path\n"
      "element vertex 2\nproperty uchar red\nproperty float nz\nproperty double z\nproperty double y\n"
      "property double x\nproperty float ny\nproperty float nx\nproperty uchar green\n"
      "property uchar blue\nproperty short class\nelement face 0\n"
      "property list uchar int vertex_indices\nend_header\n";
  for (int camera = 0; camera < 2; ++camera) {
    put<std::uint8_t>(s, 9);
    put<std::uint8_t>(s, static_cast<std::uint8_t>(camera + 1));
    for (int i = 0; i <= camera; ++i) put<std::int16_t>(s, 300, big);
  }
  for (int i = 0; i < 2; ++i) {
    put<std::uint8_t>(s, 10);
    put<float>(s, 1.0f, big);
    put<double>(s, 3.0 + i, big);
    put<double>(s, 2.0 + i, big);
    put<double>(s, 500000.123456789, big);
    put<float>(s, 0.0f, big);
    put<float>(s, 0.0f, big);
    put<std::uint8_t>(s, 20);
    put<std::uint8_t>(s, 30);
    put<std::int16_t>(s, static_cast<std::int16_t>(-5 + i), big);
  }
  return s;
}

std::string pcd(const std::string& data) {
  std::string s =
      "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb label\nSIZE 8 4 4 4 4\nTYPE F F F U I\nCOUNT 1 1 1 1 "
      "1\nWIDTH 2\n"
      "HEIGHT 1\nVIEWPOINT 1 2 3 1 0 0 0\nPOINTS 2\nDATA " +
      data + "\n";
  if (data == "ascii") return s + "500000.123456789 2 3 660510 4\n-1 nan -3 660510 5\n";
  std::string body;
  const double x[] = {500000.123456789, -1};
  const float y[] = {2, NAN}, z[] = {3, -3};
  const auto add = [&](auto value) { put(body, value); };
  if (data == "binary") {
    for (int i = 0; i < 2; ++i)
      add(x[i]), add(y[i]), add(z[i]), add(std::uint32_t{660510}), add(std::int32_t{4 + i});
    return s + body;
  }
  add(x[0]), add(x[1]), add(y[0]), add(y[1]), add(z[0]), add(z[1]);
  add(std::uint32_t{660510}), add(std::uint32_t{660510}), add(std::int32_t{4}), add(std::int32_t{5});
  std::string packed;  // the second colour as a copy of the first, all else as literals
  packed += static_cast<char>(27), packed += body.substr(0, 28);
  packed += static_cast<char>(7), packed += body.substr(28, 8);
  packed += static_cast<char>(2 << 5), packed += static_cast<char>(3);  // 4 bytes from 4 back
  packed += static_cast<char>(7), packed += body.substr(40);
  put(s, static_cast<std::uint32_t>(packed.size()));
  put(s, static_cast<std::uint32_t>(body.size()));
  return s + packed;
}

std::string las(int format, int minor) {
  const int record[] = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67},
            color[] = {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};
  const std::size_t size = minor >= 4 ? 375 : 227;
  std::string s = "LASF" + std::string(20, '\0') + '\1' + static_cast<char>(minor) + std::string(64, '\0');
  put<std::uint32_t>(s, 0);
  put<std::uint16_t>(s, static_cast<std::uint16_t>(size));
  put<std::uint32_t>(s, static_cast<std::uint32_t>(size));
  put<std::uint32_t>(s, 0);
  put<std::uint8_t>(s, static_cast<std::uint8_t>(format));
  put<std::uint16_t>(s, static_cast<std::uint16_t>(record[format]));
  put<std::uint32_t>(s, minor >= 4 ? 0 : 2);
  s += std::string(20, '\0');
  for (int k = 0; k < 3; ++k) put<double>(s, 1e-7);
  for (const double offset : {500000.0, 5000000.0, 0.0}) put<double>(s, offset);
  s.resize(size);
  if (minor >= 4) s.replace(247, 8, std::string("\2\0\0\0\0\0\0\0", 8));
  for (int i = 0; i < 2; ++i) {
    std::string r;
    for (const std::int32_t v : {1234567, -20000000, 30000000 + i}) put(r, v);
    r.resize(static_cast<std::size_t>(record[format]));
    if (color[format])
      r.replace(static_cast<std::size_t>(color[format]), 6, std::string("\0\xff\0\x80\0\0", 6));
    s += r;
  }
  return s;
}

std::string ptx() {
  const std::string scan = "2\n2\n1 2 3\n1 0 0\n0 1 0\n0 0 1\n0 1 0 0\n-1 0 0 0\n0 0 1 0\n10 20 30 1\n";
  return scan + "1 0 0 0.5 255 0 9\n0 0 0 0.5 0 0 0\n0 1 0 0.5 1 2 3\n0 0 1 0.5 4 5 6\n" + scan +
         "2 0 0 0.5 7 8 9\n0 0 0 0.5 0 0 0\n0 0 0 0 0 0 0\n0 0 0 0 0 0 0\n";
}

std::string png16(int width, int height, int value) {
  const cv::Mat image(height, width, CV_16UC1, cv::Scalar(value));
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

std::string png8(const std::vector<std::string>& rows) {
  cv::Mat image(static_cast<int>(rows.size()), static_cast<int>(rows[0].size()), CV_8UC1);
  for (int r = 0; r < image.rows; ++r)
    for (int c = 0; c < image.cols; ++c)
      image.at<unsigned char>(r, c) =
          rows[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)] == '#' ? 0 : 255;
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

}  // namespace unseen::io
