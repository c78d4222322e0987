// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/pcd_header.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

class HeaderParser {
 public:
  HeaderParser(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  PcdHeader parse() {
    Lines lines(bytes_);
    std::string_view line;
    while (lines.next_filled(line)) {
      const auto fields = words(line);
      if (fields[0].front() == '#') continue;
      const std::string key(fields[0]);
      if (!is_key(key)) fail("header", shown(line), "a header line such as FIELDS or DATA");
      entries_[key] = {fields.begin() + 1, fields.end()};
      if (key != "DATA") continue;
      header_.offset = lines.offset();
      header_.line = lines.number();
      read_fields();
      read_counts();
      read_viewpoint();
      read_data();
      return std::move(header_);
    }
    fail("header", "no line \"DATA\"",
         "a line \"DATA ascii\", \"DATA binary\" or \"DATA binary_compressed\"");
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& found,
                         const std::string& expected) const {
    throw InputError(name_, field, found, expected);
  }

  static bool is_key(const std::string& key) {
    for (const char* known : {"VERSION", "FIELDS", "COLUMNS", "SIZE", "TYPE", "COUNT", "WIDTH", "HEIGHT",
                              "VIEWPOINT", "POINTS", "DATA"})
      if (key == known) return true;
    return false;
  }

  std::size_t count_at(const std::string& key, std::string_view text) const {
    std::size_t count = 0;
    if (!to_count(text, count)) fail(key, shown(text), "a whole number from 0");
    return count;
  }

  const std::vector<std::string_view>& entry(const std::string& key, std::size_t size) const {
    const auto found = entries_.find(key);
    if (found == entries_.end()) fail(key, "no such line", "it in the header");
    if (found->second.size() != size)
      fail(key, count_of(found->second.size(), "value"), std::to_string(size));
    return found->second;
  }

  static bool scalar_of(std::string_view kind, std::size_t size, Scalar& type) {
    static constexpr std::tuple<char, std::size_t, Scalar> kTypes[] = {
        {'I', 1, Scalar::i8},  {'I', 2, Scalar::i16}, {'I', 4, Scalar::i32}, {'I', 8, Scalar::i64},
        {'U', 1, Scalar::u8},  {'U', 2, Scalar::u16}, {'U', 4, Scalar::u32}, {'U', 8, Scalar::u64},
        {'F', 4, Scalar::f32}, {'F', 8, Scalar::f64}};
    for (const auto& [letter, bytes, scalar] : kTypes)
      if (kind.size() == 1 && kind[0] == letter && size == bytes) {
        type = scalar;
        return true;
      }
    return false;
  }

  void read_fields() {
    auto names = entries_.find("FIELDS");
    if (names == entries_.end()) names = entries_.find("COLUMNS");
    if (names == entries_.end() || names->second.empty()) fail("FIELDS", "none", "the names of the fields");
    const std::size_t count = names->second.size();
    const auto sizes = entry("SIZE", count), types = entry("TYPE", count);
    const bool has_counts = entries_.count("COUNT") > 0;
    for (std::size_t i = 0; i < count; ++i) {
      PcdField field;
      field.name = names->second[i];
      if (field.name != "_" && std::count(names->second.begin(), names->second.end(), field.name) > 1) fail("FIELDS", shown(field.name) + " twice", "each once");
      if (!scalar_of(types[i], count_at("SIZE", sizes[i]), field.type))
        fail("TYPE of field " + field.name,
             std::string(types[i].substr(0, 8)) + " of " + shown(sizes[i]) + " bytes",
             "I or U of 1, 2, 4 or 8 bytes, or F of 4 or 8");
      if (has_counts) field.count = count_at("COUNT", entry("COUNT", count)[i]);
      if (field.count > 1000000)
        fail("COUNT of field " + field.name, std::to_string(field.count), "at most 1000000");
      header_.values += field.count;
      header_.stride += field.count * size_of(field.type);
      header_.fields.push_back(std::move(field));
    }
    if (header_.values == 0) fail("COUNT", "0 values a point", "at least one");
  }

  void read_counts() {
    const bool counted = entries_.count("POINTS") > 0;
    if (counted) header_.points = count_at("POINTS", entry("POINTS", 1)[0]);
    if (counted && !entries_.count("WIDTH")) return;
    const std::size_t width = count_at("WIDTH", entry("WIDTH", 1)[0]);
    const std::size_t height = entries_.count("HEIGHT") ? count_at("HEIGHT", entry("HEIGHT", 1)[0]) : 1;
    const std::size_t most = counted ? std::numeric_limits<std::size_t>::max() : bytes_.size();  // compressed points may take less than a byte
    if (height > 0 && width > most / height)
      fail("WIDTH", std::to_string(width) + " x " + std::to_string(height) + " points",
           "no more than the file can hold");
    if (!counted) header_.points = width * height;
    if (header_.points < width * height) fail("POINTS", std::to_string(header_.points), std::to_string(width * height) + ", as WIDTH and HEIGHT say");
  }

  void read_viewpoint() {
    if (!entries_.count("VIEWPOINT")) return;
    const auto& texts = entry("VIEWPOINT", 7);
    Vec3 point = Vec3::Zero();
    for (int i = 0; i < 3; ++i)
      if (!to_number(texts[i], point[i]) || !std::isfinite(point[i])) fail("VIEWPOINT", shown(texts[i]), "a number");
    // The origin is what every writer puts there that does not know.
    if (point != Vec3::Zero()) header_.viewpoint = point;
  }

  void read_data() {
    const std::string_view kind = entry("DATA", 1)[0];
    if (kind == "ascii")
      header_.data = PcdHeader::Data::ascii;
    else if (kind == "binary")
      header_.data = PcdHeader::Data::binary;
    else if (kind == "binary_compressed")
      header_.data = PcdHeader::Data::compressed;
    else
      fail("DATA", shown(kind), "ascii, binary or binary_compressed");
    if (header_.points == 0) fail("POINTS", "0", "points");
    if (header_.data == PcdHeader::Data::compressed) return;
    const bool ascii = header_.data == PcdHeader::Data::ascii;
    const std::size_t left = bytes_.size() - header_.offset;
    const std::size_t room = ascii ? (left + 1) / (2 * header_.values) : left / header_.stride;
    if (header_.points <= room) return;
    const std::size_t there = ascii ? count_filled_lines(bytes_.substr(header_.offset)) : room;
    fail("POINTS", count_of(there, "point"),
         "the " + std::to_string(header_.points) + " that the header promises");
  }

  std::string_view bytes_;
  const std::string& name_;
  std::map<std::string, std::vector<std::string_view>> entries_;
  PcdHeader header_;
};

}  // namespace

PcdHeader read_pcd_header(std::string_view bytes, const std::string& name) {
  return HeaderParser(bytes, name).parse();
}

}  // namespace unseen::io
