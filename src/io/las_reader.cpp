// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <array>
#include <cmath>

#include "io/columns.h"
#include "io/readers.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

constexpr bool kSwapLittleEndian = std::endian::native == std::endian::big;
constexpr std::array<std::size_t, 11> kRecord = {20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67};
constexpr std::string_view kHasWaves = "\4\5\11\12";  ///< formats that other data may follow
constexpr std::array<std::size_t, 11> kColor = {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};  ///< 0 = none

class LasSource final : public PointSource {
 public:
  explicit LasSource(const Input& input) : bytes_(input.bytes) {
    info_.name = input.name;
    read_header();
    find_columns();
    attributes_ = attributes_of(columns_);
    if (attributes_.colors) guess_color_range();
    info_.point_count = count_;
  }

  SourceInfo info() const override { return info_; }
  void rewind() override { done_ = 0; }

  bool next(PointCloud& block) override {
    if (done_ == count_) return false;
    const std::size_t count = std::min(kBlock, count_ - done_);
    resize(block, attributes_, count);
    const std::size_t at = start_ + done_ * stride_;
    for (const Column& column : columns_)
      decode_column(bytes_->view().data() + at, stride_, count, column, kSwapLittleEndian, block);
    bytes_->release_before(at);
    done_ += count;
    return true;
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& found,
                         const std::string& expected) const {
    throw InputError(info_.name, field, found, expected);
  }

  template <class T>
  T at(std::size_t offset) const {
    return load<T>(bytes_->view().data() + offset, kSwapLittleEndian);
  }

  void read_header() {
    constexpr std::size_t kShortest = 227;
    const std::string_view bytes = bytes_->view();
    if (bytes.substr(0, 4) != "LASF") fail("signature", shown(bytes.substr(0, 4)), "\"LASF\"");
    if (bytes.size() < kShortest) fail("header", count_of(bytes.size(), "byte"), "at least 227");
    const int major = at<std::uint8_t>(24), minor = at<std::uint8_t>(25);
    if (major != 1 || minor > 4)
      fail("version", std::to_string(major) + "." + std::to_string(minor), "1.0 to 1.4");
    format_ = at<std::uint8_t>(104);
    if (format_ & 0xC0)
      fail("point format", "compressed points (LAZ)",
           "LAS: convert it with las2las, PDAL or CloudCompare to LAS or PLY");
    if (format_ >= kRecord.size()) fail("point format", std::to_string(format_), "0 to 10");
    stride_ = at<std::uint16_t>(105);
    if (stride_ < kRecord[format_])
      fail("point record length", count_of(stride_, "byte"),
           "at least " + std::to_string(kRecord[format_]) + " for point format " + std::to_string(format_));
    start_ = at<std::uint32_t>(96);
    if (start_ < kShortest || start_ > bytes.size())
      fail("offset to point data", std::to_string(start_), "a place in the file after its header");
    read_count(minor);
  }

  void read_count(int minor) {
    const std::string_view bytes = bytes_->view();
    std::uint64_t count = at<std::uint32_t>(107);
    constexpr std::size_t kHeader14 = 375;
    const bool long_header = minor >= 4 && at<std::uint16_t>(94) >= kHeader14 && bytes.size() >= kHeader14;
    if (long_header)
      if (const auto count14 = at<std::uint64_t>(247); count14 > 0) count = count14;
    if (count == 0) fail("number of points", "0", "points");
    const std::size_t room = (bytes.size() - start_) / stride_;
    if (count > room)
      fail("number of points", count_of(room, "point"),
           "the " + std::to_string(count) + " that the header promises");
    count_ = count;
    const bool points_only = minor < 3 || (long_header && at<std::uint32_t>(243) == 0 && kHasWaves.find(static_cast<char>(format_)) == std::string_view::npos);
    if (count < room && points_only)
      info_.notes.push_back("the header promises " + count_of(count, "point") + " where there is room for " + std::to_string(room) + ": the others are left out");
  }

  void find_columns() {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Column column;
      column.role = static_cast<Role>(static_cast<std::size_t>(Role::x) + axis);
      column.type = Scalar::i32;
      column.offset = 4 * axis;
      column.scale = at<double>(131 + 8 * axis);
      column.shift = at<double>(155 + 8 * axis);
      const std::string name(1, static_cast<char>('x' + axis));
      if (!std::isfinite(column.scale) || column.scale == 0.0)
        fail(name + " scale factor", std::to_string(column.scale), "a finite number other than 0");
      if (!std::isfinite(column.shift))
        fail(name + " offset", std::to_string(column.shift), "a finite number");
      columns_.push_back(column);
    }
    check_not_degrees();
    if (kColor[format_] == 0) return;
    for (std::size_t i = 0; i < 3; ++i) {
      Column column;
      column.role = static_cast<Role>(static_cast<std::size_t>(Role::red) + i);
      column.type = Scalar::u16;
      column.offset = kColor[format_] + 2 * i;
      column.scale = 1.0 / 257.0;
      columns_.push_back(column);
    }
  }

  /// Longitude and latitude are stored in steps of some 1e-7, finer by far than the heights beside them.
  void check_not_degrees() const {
    constexpr double kFinest = 1e-5, kRougher = 100;
    const auto within = [&](std::size_t axis, double most) {
      const auto high = at<double>(179 + 16 * axis), low = at<double>(187 + 16 * axis);
      return low < high && low >= -most && high <= most;
    };
    const double x = std::abs(columns_[0].scale), y = std::abs(columns_[1].scale), z = std::abs(columns_[2].scale);
    if (within(0, 180) && within(1, 90) && x <= kFinest && y <= kFinest && z >= kRougher * x && z >= kRougher * y)
      fail("x, y", "longitude and latitude in degrees", "metres: project it first, as to UTM, with PDAL, las2las or QGIS");
  }

  /// The format wants colours from 0 to 65535; many files hold 0 to 255.
  void guess_color_range() {
    const std::size_t count = std::min(kBlock, count_);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        if (at<std::uint16_t>(start_ + i * stride_ + kColor[format_] + 2 * c) > 255) return;
    for (Column& column : columns_)
      if (column.type == Scalar::u16) column.scale = 1.0;
    info_.notes.push_back("colours read as 0 to 255: the first points hold none above");
  }

  std::shared_ptr<FileBytes> bytes_;
  SourceInfo info_;
  std::size_t format_ = 0, stride_ = 0, start_ = 0, count_ = 0;
  std::vector<Column> columns_;
  Attributes attributes_;
  std::size_t done_ = 0;
};

}  // namespace

std::unique_ptr<PointSource> open_las(const Input& input) {
  return std::make_unique<LasSource>(input);
}

}  // namespace unseen::io
