// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>

#include "io/lzf.h"
#include "io/pcd_header.h"
#include "io/readers.h"
#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

class PcdSource final : public PointSource {
 public:
  explicit PcdSource(const Input& input)
      : bytes_(input.bytes), header_(read_pcd_header(input.view(), input.name)) {
    info_.name = input.name;
    find_columns(input.options.label_field);
    if (header_.data == PcdHeader::Data::compressed) decompress();
    info_.point_count = header_.points;
    info_.has_normals = attributes_.normals;
    info_.viewpoint = header_.viewpoint;
    info_.in_memory = header_.data == PcdHeader::Data::compressed;
    rewind();
  }

  SourceInfo info() const override { return info_; }

  void rewind() override {
    done_ = 0;
    lines_ = Lines(bytes_->view(), header_.offset, header_.line);
  }

  bool next(PointCloud& block) override {
    if (done_ == header_.points) return false;
    const std::size_t count = std::min(kBlock, header_.points - done_);
    resize(block, attributes_, count);
    if (header_.data == PcdHeader::Data::ascii)
      read_text(block, count);
    else if (header_.data == PcdHeader::Data::binary)
      read_records(block, count);
    else
      read_planes(block, count);
    done_ += count;
    return true;
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& found,
                         const std::string& expected) const {
    throw InputError(info_.name, field, found, expected);
  }

  void find_columns(const std::string& label_field) {
    std::size_t offset = 0;
    for (const PcdField& field : header_.fields) {
      Column column;
      column.type = field.type;
      column.offset = offset;
      if (field.count == 1) {
        const std::string name = lower(field.name);
        column.role = name == "rgb" || name == "rgba"
                          ? Role::packed_rgb
                          : role_of_name(name, is_integer(field.type), lower(label_field));
      }
      offset += field.count * size_of(field.type);
      columns_.push_back(column);
    }
    settle_roles(columns_);
    for (const auto& [role, name] : {std::pair{Role::x, "x"}, {Role::y, "y"}})
      if (!has_role(columns_, role)) fail("FIELDS", std::string("no field ") + name, "x, y and z");
    info_.two_dimensional = !has_role(columns_, Role::z);
    if (info_.two_dimensional) info_.notes.push_back("no field z: read as a drawing");
    if (!label_field.empty() && !has_role(columns_, Role::label))
      fail("FIELDS", "no field " + label_field, "the field of the labels");
    attributes_ = attributes_of(columns_);
  }

  /// Each field lies in one piece: x of all points, then y of all points, …
  void decompress() {
    const std::string_view bytes = bytes_->view().substr(header_.offset);
    if (bytes.size() < 8) fail("DATA", count_of(bytes.size(), "byte"), "the sizes of the compressed data");
    constexpr bool kSwap = std::endian::native == std::endian::big;
    const std::size_t packed = load<std::uint32_t>(bytes.data(), kSwap);
    const std::size_t size = load<std::uint32_t>(bytes.data() + 4, kSwap);
    if (size % header_.stride != 0 || size / header_.stride != header_.points)
      fail("DATA", count_of(size, "byte"),
           count_of(header_.points, "point") + " of " + count_of(header_.stride, "byte"));
    if (packed > bytes.size() - 8)
      fail("DATA", count_of(bytes.size() - 8, "byte"), "the " + std::to_string(packed) + " that it promises");
    if (!lzf_decompress(bytes.substr(8, packed), size, planes_))
      fail("DATA", "broken compressed data", count_of(header_.points, "point"));
  }

  void read_records(PointCloud& block, std::size_t count) {
    constexpr bool kSwap = std::endian::native == std::endian::big;
    const std::size_t at = header_.offset + done_ * header_.stride;
    for (const Column& column : columns_)
      decode_column(bytes_->view().data() + at, header_.stride, count, column, kSwap, block);
    bytes_->release_before(at);
  }

  void read_planes(PointCloud& block, std::size_t count) {
    constexpr bool kSwap = std::endian::native == std::endian::big;
    for (const Column& column : columns_) {
      if (column.role == Role::ignored) continue;
      Column plain = column;
      plain.offset = 0;
      const std::size_t size = size_of(column.type);
      decode_column(planes_.data() + column.offset * header_.points + done_ * size, size, count, plain, kSwap,
                    block);
    }
  }

  void read_text(PointCloud& block, std::size_t count) {
    std::string_view line;
    for (std::size_t i = 0; i < count; ++i) {
      if (!lines_.next_filled(line))
        fail("POINTS", count_of(done_ + i, "point"),
             "the " + std::to_string(header_.points) + " that the header promises");
      const char *p = line.data(), *end = line.data() + line.size();
      double value = 0;
      for (std::size_t f = 0; f < columns_.size(); ++f)
        for (std::size_t k = 0; k < header_.fields[f].count; ++k) {
          if (!read_number(p, end, value)) {
            const std::string_view rest = trim({p, static_cast<std::size_t>(end - p)});
            fail("line " + std::to_string(lines_.number()) + ", field " + header_.fields[f].name,
                 rest.empty() ? "the end of the line" : shown(rest), "a number");
          }
          set_value(block, i, columns_[f], value);
        }
      const std::string_view rest = trim({p, static_cast<std::size_t>(end - p)});
      if (!rest.empty())
        fail("line " + std::to_string(lines_.number()), shown(rest),
             "the end of the line after " + count_of(header_.values, "value"));
    }
    bytes_->release_before(lines_.offset());
  }

  std::shared_ptr<FileBytes> bytes_;
  PcdHeader header_;
  std::vector<Column> columns_;
  Attributes attributes_;
  SourceInfo info_;
  std::string planes_;  ///< decompressed data, field by field
  std::size_t done_ = 0;
  Lines lines_;
};

}  // namespace

std::unique_ptr<PointSource> open_pcd(const Input& input) {
  return std::make_unique<PcdSource>(input);
}

}  // namespace unseen::io
