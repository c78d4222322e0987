// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/report/points_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <system_error>

#include "unseen/core/error.h"

namespace unseen::report {
namespace {

static_assert(std::endian::native == std::endian::little, "records are written as they lie in memory");

struct Record {
  double x, y, z;
  std::int32_t plane, frame;
};
static_assert(sizeof(Record) == 32);

constexpr std::size_t kBlock = 1 << 15;  ///< records in memory at a time

/// The header, always of the same length, so that it can be written again once the count is known.
std::string header(std::uint64_t count) {
  std::string text = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", count);
  const std::size_t padding = 20 - std::to_string(count).size();
  return text +
         "property double x\nproperty double y\nproperty double z\nproperty int plane\nproperty int frame\n" +
         "comment planes of unseen, -1 = none" + std::string(padding, ' ') + "\nend_header\n";
}

std::streamsize bytes(std::size_t records) {
  return static_cast<std::streamsize>(records * sizeof(Record));
}

}  // namespace

PointsFile::PointsFile(const std::filesystem::path& path)
    : path_(path), file_(path, std::ios::in | std::ios::out | std::ios::binary | std::ios::trunc) {
  check("a file that can be written");
  const std::string text = header(0);
  file_.write(text.data(), static_cast<std::streamsize>(text.size()));
}

void PointsFile::check(const char* what) {
  if (!file_) throw InputError(path_.string(), "", std::generic_category().message(errno), what);
}

void PointsFile::add(std::span<const Vec3> positions, std::span<const int> plane_of_point) {
  std::vector<Record> records;
  for (std::size_t begin = 0; begin < positions.size(); begin += kBlock) {
    const std::size_t end = std::min(begin + kBlock, positions.size());
    records.clear();
    for (std::size_t i = begin; i < end; ++i)
      records.push_back({positions[i].x(), positions[i].y(), positions[i].z(), plane_of_point[i], -1});
    file_.write(reinterpret_cast<const char*>(records.data()), bytes(records.size()));
    check("room on the disk");
  }
  count_ += positions.size();
}

void PointsFile::finish(const std::vector<int>& frame_of_plane) {
  const std::string text = header(count_);
  file_.seekp(0);
  file_.write(text.data(), static_cast<std::streamsize>(text.size()));
  std::vector<Record> records;
  for (std::uint64_t begin = 0; begin < count_; begin += kBlock) {
    records.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, count_ - begin)));
    const auto at = static_cast<std::streamoff>(text.size() + begin * sizeof(Record));
    file_.seekg(at);
    file_.read(reinterpret_cast<char*>(records.data()), bytes(records.size()));
    for (Record& r : records)
      r.frame = r.plane < 0 ? -1 : frame_of_plane.at(static_cast<std::size_t>(r.plane));
    file_.seekp(at);
    file_.write(reinterpret_cast<const char*>(records.data()), bytes(records.size()));
    check("room on the disk");
  }
  file_.close();
  check("room on the disk");
}

}  // namespace unseen::report
