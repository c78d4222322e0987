// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Bytes that begin as a PNG does are a picture of a frame; any others are the text of a frame file beside
// depth.png (2 × 2 pixels of 16 bits) and cloud.xyz.
#include <stdlib.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "unseen/core/error.h"
#include "unseen/io/rgbd.h"

namespace unseen::io {
namespace {

namespace fs = std::filesystem;

void put_number(std::string& bytes, std::size_t at, std::uint32_t value) {  // big endian
  for (int i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(value >> (24 - 8 * i));
}

std::uint32_t get_number(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// CRC-32 of a chunk's name and data, as a PNG ends it.
std::uint32_t crc(std::string_view bytes) {
  std::uint32_t sum = 0xffffffff;
  for (const char c : bytes) {
    sum ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) sum = sum >> 1 ^ (sum & 1 ? 0xedb88320 : 0);
  }
  return ~sum;
}

/// Gives every chunk its right sum, without which nothing beyond the header would be looked at.
std::string with_sums(std::string png) {
  constexpr std::size_t kFrame = 12;  // length, name and sum
  for (std::size_t at = 8; at + kFrame <= png.size();) {
    const std::size_t size = get_number(png, at);
    if (size > png.size() - at - kFrame) break;
    put_number(png, at + 8 + size, crc(std::string_view(png).substr(at + 4, 4 + size)));
    at += kFrame + size;
  }
  return png;
}

void chunk(std::string& png, const std::string& name, const std::string& data) {
  const std::size_t at = png.size();
  png += std::string(4, '\0') + name + data + std::string(4, '\0');
  put_number(png, at, static_cast<std::uint32_t>(data.size()));
}

/// Depths of 1000 to 1003 mm.
std::string small_png() {
  std::string png("\x89PNG\r\n\x1a\n"), header(13, '\0');
  put_number(header, 0, 2);
  put_number(header, 4, 2);
  header[8] = 16;
  chunk(png, "IHDR", header);
  const std::string rows("\0\x03\xe8\x03\xe9\0\x03\xea\x03\xeb", 10);
  std::uint32_t a = 1, b = 0;  // Adler-32
  for (const char c : rows) a = (a + static_cast<unsigned char>(c)) % 65521, b = (b + a) % 65521;
  std::string stored("\x78\x01\x01\x0a\0\xf5\xff", 7);  // zlib: one block, not compressed
  stored += rows + std::string(4, '\0');
  put_number(stored, stored.size() - 4, b << 16 | a);
  chunk(png, "IDAT", stored);
  chunk(png, "IEND", "");
  return with_sums(png);
}

struct Folder {
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "unseen-fuzz-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) std::abort();
    path = pattern;
    write("depth.png", small_png());
    write("cloud.xyz", "0 0 1\n0.1 0 1\n0 0.1 1.5\n");
  }
  ~Folder() { fs::remove_all(path); }
  void write(const std::string& name, std::string_view bytes) const {
    std::ofstream(path / name, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  fs::path path;
};

/// Whatever the files, that gives a frame whose parts fit together, or an InputError.
void read(const Folder& folder, std::string_view text) {
  folder.write("frame.json", text);
  try {
    const RgbdFrame frame = read_rgbd_frame(folder.path);
    const auto pixels =
        static_cast<std::size_t>(frame.camera.width) * static_cast<std::size_t>(frame.camera.height);
    bool good =
        frame.is_fused() ? frame.cloud.viewpoint.has_value() : pixels > 0 && frame.depth.size() == pixels;
    good = good && (frame.color.empty() || frame.color.size() == pixels);
    good = good && (frame.masks.empty() || frame.masks.size() == pixels);
    for (const GivenSupport& s : frame.supports)
      good = good && std::isfinite(s.plane.offset) && s.plane.normal.allFinite();
    if (!good) std::abort();
  } catch (const InputError&) {
  }
}

}  // namespace
}  // namespace unseen::io

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace unseen::io;
  static const Folder folder;
  const std::string bytes(data, data + size);
  if (bytes.empty() || bytes[0] != '\x89') {
    if (bytes.find('/') == std::string::npos) read(folder, bytes);  // names no file elsewhere
    return 0;
  }
  constexpr const char* kCamera = R"(, "camera": {"fx": 10, "fy": 11, "cx": 3.5, "cy": 2.5}})";
  folder.write("bytes.png", with_sums(bytes));
  read(folder, std::string(R"({"depth": "bytes.png")") + kCamera);
  read(folder, std::string(R"({"depth": "depth.png", "color": "bytes.png", "masks": "bytes.png")") + kCamera);
  return 0;
}
