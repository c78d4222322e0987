// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/text_layout.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/text.h"
#include "io/text_columns.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

constexpr int kMostHeaderLines = 5;
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

class Guess {
 public:
  explicit Guess(const Input& input) : input_(input) {}

  TextLayout make() {
    std::string_view bytes = input_.view();
    if (bytes.substr(0, 2) == "\xff\xfe" || bytes.substr(0, 2) == "\xfe\xff")
      fail("encoding", "UTF-16 text", "ASCII or UTF-8");
    find_start(bytes);
    take_sample(bytes);
    if (!names_.empty() && names_.size() == sample_.width)
      roles_from_names(sample_, names_, input_.options.label_field, layout_);
    else
      roles_from_values(sample_, input_.extension, layout_);
    finish();
    find_normals_block(bytes);
    return std::move(layout_);
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& found,
                         const std::string& expected) const {
    throw InputError(input_.name, field, found, expected);
  }

  [[noreturn]] void fail_at(std::size_t number, std::string_view line) const {
    fail("line " + std::to_string(number), shown(line), "the numbers of a point");
  }

  /// Passes byte order mark, remarks, a few lines of text and the number of points.
  void find_start(std::string_view bytes) {
    const bool marked = bytes.substr(0, 3) == "\xef\xbb\xbf";
    Lines lines(bytes, marked ? 3 : 0);
    std::string_view line;
    while (true) {
      layout_.data = lines.offset();
      layout_.data_line = lines.number();
      if (!lines.next_filled(line)) {
        if (header_lines_ > 1) fail_at(second_.first, second_.second);
        fail("content", "no row of numbers", "points, one a line");
      }
      if (is_remark(line)) {
        const std::string_view remark = trim(line);
        take_names(remark.substr(remark[0] == '/' ? 2 : 1));
        continue;
      }
      guess_separator(line);
      const auto parts = split_row(line, layout_.separator);
      if (header_lines_ == 0 && counts_columns(parts)) {
        ++header_lines_;
        continue;
      }
      double value = 0;
      const bool numbers = row_number(parts[0], layout_.decimal_comma, value) &&
                           (parts.size() == 1 || row_number(parts[1], layout_.decimal_comma, value));
      if (numbers && parts.size() > 1) return;
      if (numbers && !layout_.promised) {
        std::size_t count = 0;
        if (!to_count(parts[0], count))
          fail("line " + std::to_string(lines.number()), shown(line), "a count of points, or a point");
        if (count == 0) fail("count of points", "0", "points");
        if (count > (bytes.size() - lines.offset() + 1) / 4)
          fail("count of points", count_of(count_filled_lines(bytes.substr(lines.offset())), "line"),
               "the " + std::to_string(count) + " points that the first line promises");
        layout_.promised = count;
        continue;
      }
      if (numbers || !looks_like_text(line)) fail_at(lines.number(), line);
      if (++header_lines_ == 2) second_ = {lines.number(), std::string(line)};  // a title, or a row of units
      if (header_lines_ > kMostHeaderLines) fail_at(second_.first, second_.second);
      if (names_.empty()) take_names(line);
    }
  }

  /// The header of a data frame without names: nothing over the rows' numbers, then 0 1 2 … over the columns.
  static bool counts_columns(const std::vector<std::string_view>& parts) {
    if (parts.size() < 3 || !parts[0].empty()) return false;
    for (std::size_t c = 1; c < parts.size(); ++c)
      if (parts[c] != std::to_string(c - 1)) return false;
    return true;
  }

  static bool looks_like_text(std::string_view line) {
    return line.size() < 4096 && std::none_of(line.begin(), line.end(), [](char c) {
             return (static_cast<unsigned char>(c) < 0x20 && c != '\t' && c != '\r') || c == 0x7f;
           });
  }

  void take_names(std::string_view line) {
    guess_separator(line);
    std::vector<std::string> names;
    for (std::string_view part : split_row(trim(line), layout_.separator)) {
      part = trim(part);
      if (part.size() > 1 && part.front() == '"' && part.back() == '"')
        part = part.substr(1, part.size() - 2);
      names.emplace_back(part);
    }
    const std::vector<Role> roles = roles_of_names(names);
    const auto has = [&](Role role) { return std::find(roles.begin(), roles.end(), role) != roles.end(); };
    if (has(Role::x) && has(Role::y)) {
      names_ = std::move(names);
    } else if (names_degrees(names)) {
      fail("columns", "longitude and latitude in degrees", "x, y and z in metres: project it first, as to UTM");
    }
  }

  static bool names_degrees(const std::vector<std::string>& names) {
    const auto has = [&](std::initializer_list<const char*> known) {
      return std::any_of(names.begin(), names.end(), [&](const std::string& n) { return std::find(known.begin(), known.end(), lower(n)) != known.end(); });
    };
    return has({"lon", "lng", "long", "longitude"}) && has({"lat", "latitude"});
  }

  void guess_separator(std::string_view line) {
    const bool semicolon = line.find(';') != std::string_view::npos;
    const bool comma = line.find(',') != std::string_view::npos && !has_decimal_commas(line);
    layout_.separator = semicolon ? ';' : comma ? ',' : ' ';
    layout_.decimal_comma = has_decimal_commas(line);
  }

  /// Commas between the digits of numbers that something else separates.
  static bool has_decimal_commas(std::string_view line) {
    const bool semicolon = line.find(';') != std::string_view::npos;
    const auto parts = split_row(line, semicolon ? ';' : ' ');
    bool any = false;
    for (const std::string_view part : parts) {
      double value = 0;
      if (to_number(part, value)) continue;
      if (std::count(part.begin(), part.end(), ',') != 1 || part.back() == ',' || !row_number(part, true, value)) {
        if (!semicolon) return false;
        continue;
      }
      any = true;
    }
    return any && parts.size() > 1;
  }

  void take_sample(std::string_view bytes) {
    constexpr std::size_t kSample = 1000;
    Lines lines(bytes, layout_.data, layout_.data_line);
    std::string_view line;
    while (sample_.rows.size() < kSample && lines.next_filled(line)) {
      if (is_remark(line)) continue;
      layout_.decimal_comma = layout_.decimal_comma || (layout_.separator != ',' && has_decimal_commas(line));
      const auto parts = split_row(line, layout_.separator);
      if (sample_.rows.empty()) sample_.width = parts.size();
      if (parts.size() != sample_.width) break;  // the reader says what it found there, if it matters
      std::vector<double> row;
      for (const std::string_view part : parts) {
        double value = kMissing;
        if (!row_number(part, layout_.decimal_comma, value)) value = kMissing;
        row.push_back(value);
      }
      sample_.rows.push_back(std::move(row));
    }
    constexpr std::size_t kWidest = 1000;
    if (sample_.width < 2 || sample_.width > kWidest) fail("columns", std::to_string(sample_.width), "2 to 1000");
    layout_.columns.resize(sample_.width);
  }

  /// States what was taken for what.
  void finish() {
    static constexpr const char* kNames[] = {"ignored", "x",   "y",     "z",    "nx",  "ny",
                                             "nz",      "red", "green", "blue", "rgb", "label"};
    if (!has_role(layout_.columns, Role::x) || !has_role(layout_.columns, Role::y))
      fail("columns", "no x and y", "coordinates");
    layout_.two_dimensional = !has_role(layout_.columns, Role::z);
    std::vector<const char*> list;
    for (const Column& column : layout_.columns)
      list.push_back(kNames[static_cast<std::size_t>(column.role)]);
    layout_.notes.push_back(fmt::format("columns read as {} ({}), separated by {}", fmt::join(list, " "), names_.size() == sample_.width ? "by their names" : "guessed",
                                        layout_.separator == ',' ? "commas" : layout_.separator == ';' ? "semicolons" : "blanks"));
    if (header_lines_ > 0 && names_.empty()) layout_.notes.push_back("the header names no x and y");
    if (layout_.two_dimensional) layout_.notes.push_back("no z: read as a drawing");
    if (layout_.decimal_comma) layout_.notes.push_back("commas read as decimal points");
    for (const auto& [role, name] : {std::pair{Role::x, "x"}, {Role::y, "y"}, {Role::z, "z"}})
      for (std::size_t c = 0; c < sample_.width; ++c)
        if (layout_.columns[c].role == role && sample_.all(c, [](double v) { return std::isnan(v); }))
          layout_.notes.push_back(std::string("column ") + name + " holds no number in the first rows");
    if (!input_.options.label_field.empty() && !has_role(layout_.columns, Role::label))
      fail("columns", "no column named " + input_.options.label_field, "the column of the labels");
  }

  /// PWN: the number of points, the points, then the normals.
  void find_normals_block(std::string_view bytes) {
    if (!layout_.promised || sample_.width != 3) return;
    if (count_filled_lines(bytes.substr(layout_.data)) != 2 * *layout_.promised) return;
    layout_.normals_follow = true;
    layout_.notes.push_back("twice as many rows as points: the second half read as normals");
  }

  const Input& input_;
  TextLayout layout_;
  std::vector<std::string> names_;
  int header_lines_ = 0;  ///< of text, before the first row
  std::pair<std::size_t, std::string> second_;  ///< of these: number and text
  TextSample sample_;
};

}  // namespace

TextLayout guess_text_layout(const Input& input) {
  return Guess(input).make();
}

bool is_remark(std::string_view line) {
  line = trim(line);
  return !line.empty() && (line[0] == '#' || line[0] == '%' || line.substr(0, 2) == "//");
}

std::vector<std::string_view> split_row(std::string_view line, char separator) {
  if (separator == ' ') return words(line);
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t at = line.find(separator);
    parts.push_back(trim(line.substr(0, at)));
    if (at == std::string_view::npos) return parts;
    line.remove_prefix(at + 1);
  }
}

bool row_number(std::string_view part, bool decimal_comma, double& value) {
  if (part.size() > 1 && part.front() == '"' && part.back() == '"') part = part.substr(1, part.size() - 2);
  if (part.empty()) {
    value = kMissing;
    return true;
  }
  if (!decimal_comma) return to_number(part, value);
  std::string text(part);
  std::replace(text.begin(), text.end(), ',', '.');
  return to_number(text, value);
}

}  // namespace unseen::io
