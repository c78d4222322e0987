// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "io/ply_header.h"
#include "io/readers.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

class PlySource final : public PointSource {
 public:
  explicit PlySource(const Input& input)
      : bytes_(input.bytes), header_(read_ply_header(input.view(), input.name)) {
    info_.name = input.name;
    vertex_ = header_.find("vertex");
    if (!vertex_ || vertex_->count == 0) fail("element vertex", vertex_ ? "no points" : "none", "points");
    find_columns(input.options.label_field);
    find_start();
    info_.point_count = vertex_->count;
    info_.has_normals = attributes_.normals;
    const PlyElement* face = header_.find("face");
    if (face && face->count > 0)
      info_.notes.push_back("the points are the vertices; " + count_of(face->count, "face") + " not used");
    rewind();
  }

  SourceInfo info() const override { return info_; }

  void rewind() override {
    done_ = 0;
    at_ = start_;
    lines_ = Lines(bytes_->view(), start_, start_line_);
  }

  bool next(PointCloud& block) override {
    if (done_ == vertex_->count) return false;
    const std::size_t count = std::min(kBlock, vertex_->count - done_);
    resize(block, attributes_, count);
    if (header_.ascii)
      read_text(block, count);
    else if (vertex_->has_list())
      read_lists(block, count);
    else
      read_records(block, count);
    done_ += count;
    if (done_ == vertex_->count && vertex_ == &header_.elements.back()) remark_on_rest();
    bytes_->release_before(header_.ascii ? lines_.offset() : at_);
    return true;
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& found,
                         const std::string& expected) const {
    throw InputError(info_.name, field, found, expected);
  }
  [[noreturn]] void fail_truncated(std::size_t found) const {
    fail("element vertex", count_of(found, "point"),
         "the " + std::to_string(vertex_->count) + " that the header promises");
  }

  void find_columns(const std::string& label_field) {
    std::size_t offset = 0;
    for (const PlyProperty& property : vertex_->properties) {
      Column column;
      column.type = property.type;
      column.offset = offset;
      if (!property.is_list)
        column.role = role_of_name(property.name, is_integer(property.type), label_field);
      offset += size_of(property.is_list ? property.count_type : property.type);
      columns_.push_back(column);
    }
    settle_roles(columns_);
    for (const auto& [role, name] : {std::pair{Role::x, "x"}, {Role::y, "y"}})
      if (!has_role(columns_, role))
        fail(std::string("property ") + name, "none in element vertex", "coordinates");
    info_.two_dimensional = !has_role(columns_, Role::z);
    if (info_.two_dimensional) info_.notes.push_back("no property z: read as a drawing");
    if (!label_field.empty() && !has_role(columns_, Role::label))
      fail("property " + label_field, "none in element vertex", "the field of the labels");
    attributes_ = attributes_of(columns_);
  }

  /// Passes the elements that come before the vertices.
  void find_start() {
    const std::string_view bytes = bytes_->view();
    start_ = header_.data;
    start_line_ = header_.data_line;
    Lines lines(bytes, start_, start_line_);
    std::string_view line;
    for (const PlyElement& element : header_.elements) {
      if (&element == vertex_) break;
      for (std::size_t i = 0; i < element.count; ++i)
        if (header_.ascii ? !lines.next_filled(line) : !skip_instance(bytes, start_, element, header_.swap))
          fail("element " + element.name, std::to_string(i),
               "the " + std::to_string(element.count) + " that the header promises");
    }
    if (header_.ascii) {
      start_ = lines.offset();
      start_line_ = lines.number();
    } else if (const std::size_t room = (bytes.size() - start_) / vertex_->stride(); room < vertex_->count) {
      fail_truncated(room);
    }
  }

  void read_records(PointCloud& block, std::size_t count) {
    const std::size_t stride = vertex_->stride();
    for (const Column& column : columns_)
      decode_column(bytes_->view().data() + at_, stride, count, column, header_.swap, block);
    at_ += count * stride;
  }

  void read_lists(PointCloud& block, std::size_t count) {
    const std::string_view bytes = bytes_->view();
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t c = 0; c < columns_.size(); ++c) {
        const PlyProperty& property = vertex_->properties[c];
        std::size_t length = 1;
        if (property.is_list && !list_length(bytes, at_, property, header_.swap, length))
          fail_truncated(done_ + i);
        const std::size_t size = length * size_of(property.type);
        if (size > bytes.size() - at_) fail_truncated(done_ + i);
        if (columns_[c].role != Role::ignored)
          set_value(block, i, columns_[c], load_scalar(bytes.data() + at_, property.type, header_.swap));
        at_ += size;
      }
  }

  void read_text(PointCloud& block, std::size_t count) {
    std::string_view line;
    for (std::size_t i = 0; i < count; ++i) {
      if (!lines_.next_filled(line)) fail_truncated(done_ + i);
      const char *p = line.data(), *end = line.data() + line.size();
      for (std::size_t c = 0; c < columns_.size(); ++c) {
        double value = read_value(p, end, c);
        if (vertex_->properties[c].is_list && !(value >= 0.0))
          fail("line " + std::to_string(lines_.number()) + ", property " + vertex_->properties[c].name,
               std::to_string(value), "the length of a list");
        if (vertex_->properties[c].is_list)
          for (double left = value; left >= 1.0; left -= 1.0) read_value(p, end, c);
        else
          set_value(block, i, columns_[c], value);
      }
      const std::string_view rest = trim({p, static_cast<std::size_t>(end - p)});
      if (!rest.empty())
        fail("line " + std::to_string(lines_.number()), shown(rest),
             "the end of the line after " + count_of(columns_.size(), "value"));
    }
  }

  /// A header that counts too few points hides the others.
  void remark_on_rest() {
    Lines ahead = lines_;
    std::string_view line;
    const bool more = header_.ascii ? ahead.next_filled(line) : bytes_->view().size() - at_ >= vertex_->stride();
    if (more && !remarked_) info_.notes.push_back("more follows after the " + std::to_string(vertex_->count) + " points that the header promises, and is left out");
    remarked_ = remarked_ || more;
  }

  double read_value(const char*& p, const char* end, std::size_t c) const {
    double value = 0;
    if (!read_number(p, end, value)) {
      const std::string_view rest = trim({p, static_cast<std::size_t>(end - p)});
      fail("line " + std::to_string(lines_.number()) + ", property " + vertex_->properties[c].name,
           rest.empty() ? "the end of the line" : shown(rest), "a number");
    }
    return value;
  }

  std::shared_ptr<FileBytes> bytes_;
  PlyHeader header_;
  const PlyElement* vertex_ = nullptr;
  std::vector<Column> columns_;
  Attributes attributes_;
  SourceInfo info_;
  std::size_t start_ = 0, start_line_ = 0;  ///< of the vertices
  std::size_t at_ = 0, done_ = 0;
  bool remarked_ = false;
  Lines lines_;
};

}  // namespace

std::unique_ptr<PointSource> open_ply(const Input& input) {
  return std::make_unique<PlySource>(input);
}

}  // namespace unseen::io
