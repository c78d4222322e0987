// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "io/readers.h"
#include "io/text.h"
#include "io/text_layout.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

class TextSource final : public PointSource {
 public:
  explicit TextSource(const Input& input) : bytes_(input.bytes), layout_(guess_text_layout(input)) {
    info_.name = input.name;
    info_.point_count = layout_.promised;
    info_.notes = layout_.notes;
    info_.two_dimensional = layout_.two_dimensional;
    attributes_ = attributes_of(layout_.columns);
    if (layout_.normals_follow) {
      attributes_.normals = true;
      Lines lines(bytes_->view(), layout_.data, layout_.data_line);
      std::string_view line;
      for (std::size_t i = 0; i < *layout_.promised; ++i) lines.next_filled(line);
      normals_start_ = lines;
    }
    info_.has_normals = attributes_.normals;
    rewind();
  }

  SourceInfo info() const override { return info_; }

  void rewind() override {
    lines_ = Lines(bytes_->view(), layout_.data, layout_.data_line);
    normal_lines_ = normals_start_;
    done_ = 0;
    promised_ = layout_.promised.value_or(0);
  }

  bool next(PointCloud& block) override {
    // A row has at least a separator or line end for each column.
    const std::size_t room = (bytes_->view().size() - lines_.offset()) / layout_.columns.size() + 1;
    const std::size_t most = std::min(kBlock, room);
    resize(block, attributes_, most);
    std::size_t count = 0;
    while (count < most && next_point_line()) {
      read_row(block, count);
      if (layout_.normals_follow) read_normal(block, count);
      ++count;
      ++done_;
    }
    resize_to(block, count);
    if (!layout_.normals_follow) bytes_->release_before(lines_.offset());
    return count > 0;
  }

 private:
  [[noreturn]] void fail(const std::string& found, const std::string& expected, const Lines& lines) const {
    throw InputError(info_.name, "line " + std::to_string(lines.number()), found, expected);
  }

  void resize_to(PointCloud& block, std::size_t count) const {
    block.positions.resize(count);
    if (attributes_.normals) block.normals.resize(count);
    if (attributes_.colors) block.colors.resize(count);
    if (attributes_.labels) block.labels.resize(count);
  }

  /// The next row into line_; false at the end.
  bool next_point_line() {
    if (layout_.normals_follow && done_ == promised_) return false;
    do {
      if (!lines_.next_filled(line_)) {
        if (done_ >= promised_) return false;
        throw InputError(info_.name, "count of points", count_of(done_, "point"),
                         "the " + std::to_string(promised_) + " that the file promises");
      }
    } while (is_remark(line_));
    if (layout_.promised && done_ == promised_) start_next_scan();
    return true;
  }

  /// PTS files hold several scans one after another, each with its count.
  void start_next_scan() {
    std::size_t count = 0;
    if (!to_count(line_, count))
      fail(shown(line_), "the end of the file after " + count_of(promised_, "point"), lines_);
    if (count > bytes_->view().size())
      fail(std::to_string(count) + " points", "no more than the file can hold", lines_);
    promised_ += count;
    if (!lines_.next_filled(line_)) {
      if (count > 0) fail("the end of the file", count_of(count, "point"), lines_);
      line_ = {};
    }
  }

  void read_row(PointCloud& block, std::size_t i) {
    if (layout_.separator != ' ' || layout_.decimal_comma || line_.find('"') != std::string_view::npos)
      return read_parts(block, i);
    const char *p = line_.data(), *end = line_.data() + line_.size();
    for (const Column& column : layout_.columns) {
      double value = 0;
      const char* start = p;
      if (!read_number(p, end, value) || (p != end && !is_blank(*p))) {
        if (column.role != Role::ignored || !skip_word(start, end, p)) fail_row();
        continue;
      }
      set_value(block, i, column, value);
    }
    if (!std::all_of(p, end, is_blank)) fail_row();
  }

  static bool skip_word(const char* start, const char* end, const char*& p) {
    while (start != end && is_blank(*start)) ++start;
    p = std::find_if(start, end, is_blank);
    return p != start;
  }

  void read_parts(PointCloud& block, std::size_t i) {
    const char separator = layout_.separator;
    const std::vector<Column>& columns = layout_.columns;
    std::string_view rest = line_;
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (separator == ' ') rest = trim(rest);
      const std::size_t at = separator == ' ' ? rest.find_first_of(" \t") : rest.find(separator);
      if ((at == std::string_view::npos) != (c + 1 == columns.size())) fail_row();
      const std::string_view part = trim(rest.substr(0, at));
      double value = 0;
      if (columns[c].role != Role::ignored) {
        if (!row_number(part, layout_.decimal_comma, value)) fail_row();
        set_value(block, i, columns[c], value);
      }
      if (at != std::string_view::npos) rest.remove_prefix(at + 1);
    }
  }

  void read_normal(PointCloud& block, std::size_t i) {
    std::string_view line;
    if (!normal_lines_.next_filled(line))
      fail("the end of the file", "a normal for each point", normal_lines_);
    const char *p = line.data(), *end = line.data() + line.size();
    double n[3];
    for (double& value : n)
      if (!read_number(p, end, value)) fail(shown(line), "a normal of 3 numbers", normal_lines_);
    block.normals[i] = Vec3(n[0], n[1], n[2]).cast<float>();
  }

  [[noreturn]] void fail_row() const {
    fail(shown(line_), "a row of " + count_of(layout_.columns.size(), "number") + " like the first", lines_);
  }

  std::shared_ptr<FileBytes> bytes_;
  TextLayout layout_;
  Attributes attributes_;
  SourceInfo info_;
  Lines lines_, normal_lines_, normals_start_;
  std::string_view line_;
  std::size_t done_ = 0, promised_ = 0;  ///< points given, points promised so far
};

}  // namespace

std::unique_ptr<PointSource> open_text(const Input& input) {
  return std::make_unique<TextSource>(input);
}

}  // namespace unseen::io
