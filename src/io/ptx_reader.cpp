// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <array>
#include <cmath>

#include "io/columns.h"
#include "io/readers.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

constexpr double kRightAngles = 0.02;  // how far a matrix may be from a rotation and a scale: files round

/// Scans one after another, each a grid of points in the scanner's coordinates and the matrix into the
/// world's.
class PtxSource final : public PointSource {
 public:
  explicit PtxSource(const Input& input) : bytes_(input.bytes) {
    info_.name = input.name;
    rewind();
    info_.viewpoint = position_;
    Lines ahead = lines_;
    std::string_view line;
    if (!ahead.next_filled(line)) fail_truncated();
    attributes_.colors = words(line).size() >= 7;
  }

  SourceInfo info() const override { return info_; }

  void rewind() override {
    lines_ = Lines(bytes_->view());
    left_ = 0;
    read_scan_header();
  }

  bool next(PointCloud& block) override {
    resize(block, attributes_, 0);
    while (block.size() < kBlock) {
      if (left_ == 0 && !read_scan_header()) break;
      for (; left_ > 0 && block.size() < kBlock; --left_) read_point(block);
    }
    bytes_->release_before(lines_.offset());
    return block.size() > 0;
  }

 private:
  [[noreturn]] void fail(const std::string& field, std::string_view line, const std::string& expected) const {
    throw InputError(info_.name, "line " + std::to_string(lines_.number()) + ", " + field, shown(line),
                     expected);
  }
  [[noreturn]] void fail_truncated() const {
    throw InputError(info_.name, "points", count_of(size_ - left_, "point"),
                     "the " + std::to_string(size_) + " of the scan");
  }

  [[noreturn]] void fail_matrix(const char* found) const {
    throw InputError(info_.name, "line " + std::to_string(lines_.number()) + ", matrix", found, "rotation, scale and translation, a column of the usual matrix in each line");
  }

  /// False at the end of the file, where that is no fault.
  bool read_scan_header() {
    std::string_view line;
    if (!lines_.next_filled(line)) {
      if (lines_.number() == 0) throw InputError(info_.name, "header", "no line", "the size of the scan");
      return false;
    }
    std::size_t columns = 0, rows = 0;
    if (!to_count(line, columns)) fail("columns", line, "a whole number from 0");
    line = {};
    if (!lines_.next_filled(line) || !to_count(line, rows)) fail("rows", line, "a whole number from 0");
    constexpr std::size_t kShortestRow = 6;  // "0 0 0" and the end of the line
    const std::size_t room = (bytes_->view().size() - lines_.offset() + 1) / kShortestRow;
    if (rows > 0 && columns > room / rows)
      throw InputError(info_.name, "columns and rows", std::to_string(columns) + " x " + std::to_string(rows),
                       "no more points than the file can hold");
    size_ = left_ = columns * rows;
    std::array<double, 3> numbers3{};
    std::array<double, 4> numbers4{};
    for (int i = 0; i < 4; ++i) {
      read_numbers("scanner position and axes", numbers3);
      if (i == 0) position_ = Vec3(numbers3[0], numbers3[1], numbers3[2]);
    }
    for (int i = 0; i < 4; ++i) {
      read_numbers("matrix", numbers4);
      const Vec3 row(numbers4[0], numbers4[1], numbers4[2]);
      if (!row.allFinite())
        throw InputError(info_.name, "matrix", "a number that is not finite", "finite numbers");
      if (numbers4[3] != (i < 3 ? 0.0 : 1.0)) fail_matrix(i < 3 ? "a last number that is not 0" : "a last number that is not 1");
      i < 3 ? void(rotation_.col(i) = row) : void(translation_ = row);
    }
    const Mat3 squared = rotation_.transpose() * rotation_;
    const double scale = squared.trace() / 3.0;  // its square
    const double skew = (squared / scale - Mat3::Identity()).cwiseAbs().maxCoeff();
    if (!(scale > 0.0) || !std::isfinite(scale) || !(skew <= kRightAngles)) fail_matrix("axes that are not at right angles and equally long");
    return true;
  }

  template <std::size_t N>
  void read_numbers(const char* field, std::array<double, N>& numbers) {
    std::string_view line;
    if (!lines_.next_filled(line)) fail(field, "", std::to_string(N) + " numbers");
    const char *p = line.data(), *end = line.data() + line.size();
    for (double& number : numbers)
      if (!read_number(p, end, number)) fail(field, line, std::to_string(N) + " numbers");
  }

  void read_point(PointCloud& block) {
    std::string_view line;
    if (!lines_.next_filled(line)) fail_truncated();
    const char *p = line.data(), *end = line.data() + line.size();
    Vec3 point;
    for (int i = 0; i < 3; ++i)
      if (!read_number(p, end, point[i])) fail("point", line, "x y z intensity [red green blue]");
    if (point == Vec3::Zero()) {
      if (info_.notes.empty()) info_.notes.push_back("grid cells without a return (0 0 0) left out");
      return;
    }
    block.positions.push_back(rotation_ * point + translation_);
    if (!attributes_.colors) return;
    std::array<double, 4> values{};  // intensity and colour
    for (double& value : values)
      if (!read_number(p, end, value)) value = 0.0;
    block.colors.push_back({to_color(values[1]), to_color(values[2]), to_color(values[3])});
  }

  std::shared_ptr<FileBytes> bytes_;
  SourceInfo info_;
  Attributes attributes_;
  Lines lines_;
  std::size_t size_ = 0, left_ = 0;  ///< points of the scan, those not read yet
  Vec3 position_ = Vec3::Zero(), translation_ = Vec3::Zero();
  Mat3 rotation_ = Mat3::Identity();
};

}  // namespace

std::unique_ptr<PointSource> open_ptx(const Input& input) {
  return std::make_unique<PtxSource>(input);
}

}  // namespace unseen::io
