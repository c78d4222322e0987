// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/image.h"

#include <opencv2/imgcodecs.hpp>

#include "io/columns.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

constexpr bool kSwap = std::endian::native == std::endian::little;  // both formats are big endian

struct Size {
  std::uint64_t width = 0, height = 0;
};

/// From the header chunk, which always comes first.
Size png_size(std::string_view bytes) {
  if (bytes.size() < 33 || bytes.substr(12, 4) != "IHDR") return {};
  return {load<std::uint32_t>(bytes.data() + 16, kSwap), load<std::uint32_t>(bytes.data() + 20, kSwap)};
}

/// From the first start-of-frame segment.
Size jpeg_size(std::string_view bytes) {
  std::size_t at = 2;
  while (at + 9 <= bytes.size()) {
    if (bytes[at] != '\xff') return {};
    const auto marker = static_cast<unsigned char>(bytes[at + 1]);
    if (marker == 0xff) {
      ++at;
      continue;
    }
    const bool frame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (frame)
      return {load<std::uint16_t>(bytes.data() + at + 7, kSwap),
              load<std::uint16_t>(bytes.data() + at + 5, kSwap)};
    at += 2 + load<std::uint16_t>(bytes.data() + at + 2, kSwap);
  }
  return {};
}

}  // namespace

cv::Mat decode_image(std::string_view bytes, const std::string& name) {
  const bool png = bytes.substr(0, 4) == "\x89PNG";
  const Size size = png ? png_size(bytes) : jpeg_size(bytes);
  if (size.width == 0 || size.height == 0)
    throw InputError(name, "image", "a broken header", "a PNG or JPEG image");
  constexpr std::uint64_t kMost = std::uint64_t{1} << 28, kMostPerByte = 9000;  // a blank 1-bit PNG has 8256
  if (size.width > kMost / size.height || size.width * size.height / kMostPerByte > bytes.size())
    throw InputError(name, "image",
                     std::to_string(size.width) + " x " + std::to_string(size.height) + " pixels in " +
                         count_of(bytes.size(), "byte"),
                     "a size that fits the file");
  cv::Mat image;
  try {
    const cv::Mat data(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    cv::imdecode(data, png ? cv::IMREAD_UNCHANGED : cv::IMREAD_COLOR, &image);
  } catch (const cv::Exception&) {
    image.release();
  }
  if (image.empty()) throw InputError(name, "image", "broken or truncated data", "a PNG or JPEG image");
  return image;
}

}  // namespace unseen::io
