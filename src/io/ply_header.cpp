// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/ply_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

bool scalar_of(std::string_view name, Scalar& type) {
  static constexpr std::pair<const char*, Scalar> kNames[] = {
      {"char", Scalar::i8},    {"int8", Scalar::i8},    {"uchar", Scalar::u8},   {"uint8", Scalar::u8},
      {"short", Scalar::i16},  {"int16", Scalar::i16},  {"ushort", Scalar::u16}, {"uint16", Scalar::u16},
      {"int", Scalar::i32},    {"int32", Scalar::i32},  {"uint", Scalar::u32},   {"uint32", Scalar::u32},
      {"int64", Scalar::i64},  {"uint64", Scalar::u64}, {"float", Scalar::f32},  {"float32", Scalar::f32},
      {"double", Scalar::f64}, {"float64", Scalar::f64}};
  for (const auto& [known, scalar] : kNames)
    if (name == known) {
      type = scalar;
      return true;
    }
  return false;
}

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  PlyHeader parse() {
    std::string_view line;
    Lines lines(bytes_);
    if (!lines.next(line) || trim(line) != "ply") fail("first line", shown(line), "\"ply\"");
    while (lines.next(line)) {
      const auto fields = words(line);
      if (fields.empty() || fields[0] == "comment" || fields[0] == "obj_info") continue;
      if (fields[0] == "end_header") {
        header_.data = lines.offset();
        header_.data_line = lines.number();
        check();
        return std::move(header_);
      }
      parse_line(line, fields);
    }
    fail("header", "no \"end_header\"", "a line \"end_header\"");
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& found,
                         const std::string& expected) const {
    throw InputError(name_, field, found, expected);
  }

  void parse_line(std::string_view line, const std::vector<std::string_view>& fields) {
    if (fields[0] == "format")
      parse_format(fields, line);
    else if (fields[0] == "element")
      parse_element(fields, line);
    else if (fields[0] == "property")
      parse_property(fields, line);
    else
      fail("header", shown(line), "format, element, property, comment or end_header");
  }

  void parse_format(const std::vector<std::string_view>& fields, std::string_view line) {
    constexpr bool kLittle = std::endian::native == std::endian::little;
    const std::string_view format = fields.size() > 1 ? fields[1] : std::string_view();
    if (format == "ascii")
      header_.ascii = true;
    else if (format == "binary_little_endian")
      header_.swap = !kLittle;
    else if (format == "binary_big_endian")
      header_.swap = kLittle;
    else
      fail("format", shown(line), "ascii, binary_little_endian or binary_big_endian");
    has_format_ = true;
  }

  void parse_element(const std::vector<std::string_view>& fields, std::string_view line) {
    PlyElement element;
    if (fields.size() != 3) fail("element", shown(line), "\"element NAME COUNT\"");
    element.name = fields[1];
    if (!to_count(fields[2], element.count))
      fail("element " + element.name, shown(fields[2]), "how many there are, a whole number from 0");
    header_.elements.push_back(std::move(element));
  }

  void parse_property(const std::vector<std::string_view>& fields, std::string_view line) {
    if (header_.elements.empty()) fail("property", shown(line), "an element before its properties");
    PlyProperty property;
    const bool list = fields.size() == 5 && fields[1] == "list";
    const bool plain = fields.size() == 3 && scalar_of(fields[1], property.type);
    if (!plain && !(list && scalar_of(fields[2], property.count_type) && is_integer(property.count_type) &&
                    scalar_of(fields[3], property.type)))
      fail("property", shown(line), "\"property TYPE NAME\" or \"property list TYPE TYPE NAME\"");
    property.is_list = list;
    property.name = fields.back();
    const PlyElement& element = header_.elements.back();
    if (element.name == "vertex" && (property.name == "x" || property.name == "y" || property.name == "z") &&
        std::any_of(element.properties.begin(), element.properties.end(), [&](const PlyProperty& other) { return other.name == property.name; }))
      fail("property", shown(line), fmt::format("one {} only: there is one before it", property.name));
    header_.elements.back().properties.push_back(std::move(property));
  }

  /// Before anything is allocated: each instance takes at least its stride, in text two characters a value.
  void check() const {
    if (!has_format_) fail("format", "no line \"format\"", "the format of the data");
    const std::size_t left = bytes_.size() - header_.data;
    for (const PlyElement& element : header_.elements) {
      if (element.count == 0) continue;
      if (element.properties.empty()) fail("element " + element.name, "no property", "at least one property");
      const std::size_t least = header_.ascii ? 2 * element.properties.size() : element.stride();
      const std::size_t room = (left + 1) / least;
      if (element.count <= room) continue;
      const std::string_view rest = bytes_.substr(header_.data);
      const std::size_t there = header_.ascii ? count_filled_lines(rest) : left / least;
      fail("element " + element.name, "data of at most " + std::to_string(there),
           "the " + std::to_string(element.count) + " that the header promises");
    }
  }

  std::string_view bytes_;
  const std::string& name_;
  PlyHeader header_;
  bool has_format_ = false;
};

}  // namespace

bool PlyElement::has_list() const {
  return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.is_list; });
}

std::size_t PlyElement::stride() const {
  std::size_t bytes = 0;
  for (const PlyProperty& property : properties)
    bytes += size_of(property.is_list ? property.count_type : property.type);
  return bytes;
}

const PlyElement* PlyHeader::find(std::string_view name) const {
  for (const PlyElement& element : elements)
    if (element.name == name) return &element;
  return nullptr;
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& name) {
  return HeaderParser(bytes, name).parse();
}

bool list_length(std::string_view bytes, std::size_t& at, const PlyProperty& property, bool swap,
                 std::size_t& length) {
  const std::size_t size = size_of(property.count_type);
  if (size > bytes.size() - at) return false;
  const double count = load_scalar(bytes.data() + at, property.count_type, swap);
  at += size;
  const std::size_t room = (bytes.size() - at) / size_of(property.type);
  if (!(count >= 0.0) || count > static_cast<double>(room)) return false;
  length = static_cast<std::size_t>(count);
  return true;
}

bool skip_instance(std::string_view bytes, std::size_t& at, const PlyElement& element, bool swap) {
  for (const PlyProperty& property : element.properties) {
    std::size_t length = 1;
    if (property.is_list && !list_length(bytes, at, property, swap, length)) return false;
    const std::size_t size = length * size_of(property.type);
    if (size > bytes.size() - at) return false;
    at += size;
  }
  return true;
}

}  // namespace unseen::io
