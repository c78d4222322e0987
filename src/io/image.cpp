// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/image.h"

#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>
#include <new>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "io/codecs.h"
#include "io/columns.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

constexpr bool kSwapBigEndian = std::endian::native == std::endian::little;  // both formats are big endian

struct Size {
  std::uint64_t width = 0, height = 0;
};

/// From the header chunk, which always comes first.
Size png_size(std::string_view bytes) {
  if (bytes.size() < 33 || bytes.substr(12, 4) != "IHDR") return {};
  return {load<std::uint32_t>(bytes.data() + 16, kSwapBigEndian), load<std::uint32_t>(bytes.data() + 20, kSwapBigEndian)};
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
      return {load<std::uint16_t>(bytes.data() + at + 7, kSwapBigEndian),
              load<std::uint16_t>(bytes.data() + at + 5, kSwapBigEndian)};
    at += 2 + load<std::uint16_t>(bytes.data() + at + 2, kSwapBigEndian);
  }
  return {};
}

/// What libpng reads from and where it goes wrong to; it must not print.
struct PngStream {
  std::string_view bytes;
  std::size_t at = 0;
};

void png_read(png_structp png, png_bytep to, png_size_t count) {
  auto* stream = static_cast<PngStream*>(png_get_io_ptr(png));
  if (count > stream->bytes.size() - stream->at) png_error(png, "truncated");
  std::memcpy(to, stream->bytes.data() + stream->at, count);
  stream->at += count;
}

[[noreturn]] void png_fail(png_structp png, png_const_charp) {
  png_longjmp(png, 1);
}
void png_ignore(png_structp, png_const_charp) {}

/// Nothing here has a destructor: libpng leaves by longjmp.
bool decode_rows(png_structp png, png_infop info, PngStream* stream, cv::Mat* image,
                 std::vector<png_bytep>* rows) {
  if (setjmp(png_jmpbuf(png))) return false;
  png_set_read_fn(png, stream, png_read);
  png_read_info(png, info);
  png_set_expand(png);  // palettes, transparency, fewer than 8 bits
  if constexpr (std::endian::native == std::endian::little) png_set_swap(png);
  png_set_bgr(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  const int depth = png_get_bit_depth(png, info) == 16 ? CV_16U : CV_8U;
  image->create(static_cast<int>(png_get_image_height(png, info)),
                static_cast<int>(png_get_image_width(png, info)),
                CV_MAKETYPE(depth, png_get_channels(png, info)));
  rows->resize(static_cast<std::size_t>(image->rows));
  for (int row = 0; row < image->rows; ++row) (*rows)[static_cast<std::size_t>(row)] = image->ptr(row);
  png_read_image(png, rows->data());
  png_read_end(png, nullptr);
  return true;
}

cv::Mat decode_png(std::string_view bytes) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, png_fail, png_ignore);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info) throw std::bad_alloc();
  PngStream stream{bytes};
  cv::Mat image;
  std::vector<png_bytep> rows;
  if (!decode_rows(png, info, &stream, &image, &rows)) image.release();
  png_destroy_read_struct(&png, &info, nullptr);
  return image;
}

cv::Mat decode_jpeg(std::string_view bytes) {
  // The library would make up what is missing, and talk about it.
  const std::string_view end("\xff\xd9", 2);
  if (bytes.rfind(end) == std::string_view::npos) return {};
  try {
    const cv::Mat data(1, static_cast<int>(bytes.size()), CV_8U, const_cast<char*>(bytes.data()));
    return codecs().decode(data, cv::IMREAD_COLOR);
  } catch (const cv::Exception&) {
    return {};
  }
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
  const cv::Mat image = png ? decode_png(bytes) : decode_jpeg(bytes);
  if (image.empty()) throw InputError(name, "image", "broken or truncated data", "a PNG or JPEG image");
  return image;
}

}  // namespace unseen::io
