// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <limits>
#include <new>
#include <opencv2/imgcodecs.hpp>

#include "io/codecs.h"
#include "io/file_bytes.h"
#include "io/image.h"
#include "io/quiet_opencv.h"
#include "io/readers.h"
#include "io/rgbd_parts.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

/// Nothing reaches std::cerr while it lives: imdecode tells there what it caught itself.
struct MutedErrors {
  const std::ios_base::iostate state = std::cerr.rdstate();
  MutedErrors() { std::cerr.setstate(std::ios_base::badbit); }
  ~MutedErrors() { std::cerr.clear(state); }
};

cv::Mat decode_tiff(std::string_view bytes, const std::string& name) {
  const QuietOpenCv quiet;
  const MutedErrors muted;
  cv::Mat image;
  try {
    const cv::Mat data(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    image = codecs().decode(data, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) throw InputError(name, "image", "broken or truncated data", "a TIFF image");
  return image;
}

StoredDepth depth_of(const cv::Mat& image, const std::string& name) {
  StoredDepth stored;
  stored.width = image.cols;
  stored.height = image.rows;
  if (image.type() == CV_16UC1) {
    stored.whole_numbers = true;
    stored.values.assign(image.begin<std::uint16_t>(), image.end<std::uint16_t>());
  } else if (image.type() == CV_32FC1) {
    stored.values.assign(image.begin<float>(), image.end<float>());
  } else {
    throw InputError(name, "pixels", fmt::format("{} channel(s) of {} bits", image.channels(), 8 * image.elemSize1()),
                     "one channel of 16 bits or of floats");
  }
  return stored;
}

/// WIDTH and HEIGHT of the header.
std::pair<std::size_t, std::size_t> organisation(std::string_view bytes) {
  std::size_t width = 0, height = 0;
  Lines lines(bytes);
  std::string_view line;
  while (lines.next_filled(line)) {
    const auto word = words(line);
    if (word.front() == "DATA") break;
    if (word.size() == 2 && word.front() == "WIDTH") to_count(word[1], width);
    if (word.size() == 2 && word.front() == "HEIGHT") to_count(word[1], height);
  }
  return {width, height};
}

/// Focal length and principal point along one axis of the image: pixel = f · (across / depth) + c, least squares.
Vec2 fit_axis(const std::vector<Vec2>& ratio_and_pixel, const std::string& name) {
  double s = 0, r = 0, p = 0, rr = 0, rp = 0;
  for (const Vec2& v : ratio_and_pixel) s += 1, r += v.x(), p += v.y(), rr += v.x() * v.x(), rp += v.x() * v.y();
  const double spread = s * rr - r * r;
  const double f = spread > 0 ? (s * rp - r * p) / spread : 0.0, c = s > 0 ? (p - f * r) / s : 0.0;
  double worst = 0;
  for (const Vec2& v : ratio_and_pixel) worst = std::max(worst, std::abs(f * v.x() + c - v.y()));
  constexpr double kHalf = 0.5;  // px
  if (!(f > 0) || !std::isfinite(f + c) || worst > kHalf)
    throw InputError(name, "points", "no order that a camera would give them",
                     "x right, y down, z forward, in rows as a camera sees them");
  return {f, c};
}

StoredDepth read_organised(const std::filesystem::path& path, std::string_view bytes) {
  const std::string name = path.string();
  const auto [width, height] = organisation(bytes);
  const PointCloud cloud = read_all(*open_points(path));
  if (width < 2 || height < 2 || width > cloud.size() || width * height != cloud.size())
    throw InputError(name, "HEIGHT", std::to_string(height), "an organised cloud: rows and columns of a depth image");
  StoredDepth stored;
  stored.width = static_cast<int>(width);
  stored.height = static_cast<int>(height);
  stored.colors = cloud.colors;
  stored.values.assign(cloud.size(), std::numeric_limits<float>::quiet_NaN());
  std::vector<Vec2> across, down;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const Vec3& p = cloud.positions[i];
    if (!p.allFinite() || !(p.z() > 0)) continue;
    stored.values[i] = static_cast<float>(p.z());
    across.emplace_back(p.x() / p.z(), static_cast<double>(i % width));
    down.emplace_back(p.y() / p.z(), static_cast<double>(i / width));
  }
  if (across.empty()) return stored;
  const Vec2 x = fit_axis(across, name), y = fit_axis(down, name);
  stored.camera = Camera{x[0], y[0], x[1], y[1], stored.width, stored.height};
  return stored;
}

}  // namespace

StoredDepth read_stored_depth(const std::filesystem::path& path) {
  const std::string name = path.string();
  const auto file = FileBytes::open(path);
  const std::string_view bytes = file->view();
  const auto starts = [&](std::string_view magic) { return bytes.substr(0, magic.size()) == magic; };
  if (starts("\x89PNG")) return depth_of(decode_image(bytes, name), name);
  if (starts(std::string_view("II*\0", 4)) || starts(std::string_view("MM\0*", 4)))
    return depth_of(decode_tiff(bytes, name), name);
  if (starts("\x76\x2f\x31\x01")) return read_exr_depth(bytes, name);
  if (lower(path.extension().string()) == ".pcd") return read_organised(path, bytes);
  throw InputError(name, "depth", bytes.empty() ? "an empty file" : "an unknown format",
                   "a PNG, TIFF or EXR image, or a PCD");
}

}  // namespace unseen::io
