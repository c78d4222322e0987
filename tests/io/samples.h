// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "unseen/io/points.h"

namespace unseen::io {

/// A folder that goes with the test.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  std::filesystem::path operator/(const std::string& name) const { return path / name; }
  std::filesystem::path path;
};

void write_file(const std::filesystem::path& path, const std::string& bytes);
std::string read_file(const std::filesystem::path& path);

/// All points of a file whose bytes are given.
PointCloud read(const std::string& bytes, const std::string& name, const ReadOptions& options = {});
/// Checks that body throws an InputError whose message holds each of the parts.
void expect_error(const std::function<void()>& body, const std::vector<std::string>& parts);
/// The same for reading bytes; the message must hold the name as well.
void expect_read_error(const std::string& bytes, const std::string& name,
                       const std::vector<std::string>& parts);
void expect_same(const PointCloud& a, const PointCloud& b);

/// Appends the bytes of a number, the least significant first or last.
template <class T>
void put(std::string& to, T value, bool big = false) {
  std::string bytes(reinterpret_cast<const char*>(&value), sizeof(T));
  if (big) bytes.assign(bytes.rbegin(), bytes.rend());
  to += bytes;
}

/// Small valid files.
std::string ply_ascii();
std::string ply_binary(bool big);
std::string pcd(const std::string& data);  ///< "ascii", "binary" or "binary_compressed"
std::string las(int format, int minor);
std::string ptx();
std::string png16(int width, int height, int value);
std::string png8(const std::vector<std::string>& rows);  ///< '#' is black

}  // namespace unseen::io
