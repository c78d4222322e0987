// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/text_layout.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/text.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

using Row = std::vector<double>;

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
    if (!names_.empty() && names_.size() == width_)
      roles_from_names();
    else
      roles_from_values();
    finish();
    find_normals_block(bytes);
    return std::move(layout_);
  }

 private:
  [[noreturn]] void fail(const std::string& field, const std::string& found,
                         const std::string& expected) const {
    throw InputError(input_.name, field, found, expected);
  }

  /// Passes byte order mark, remarks, a header line and the number of points.
  void find_start(std::string_view bytes) {
    const bool marked = bytes.substr(0, 3) == "\xef\xbb\xbf";
    Lines lines(bytes, marked ? 3 : 0);
    std::string_view line;
    while (true) {
      layout_.data = lines.offset();
      layout_.data_line = lines.number();
      if (!lines.next_filled(line)) fail("content", "no row of numbers", "points, one a line");
      if (is_remark(line)) {
        take_names(line.substr(line[line.find_first_not_of(" \t")] == '#' ? 1 : 2));
        continue;
      }
      guess_separator(line);
      const auto parts = split_row(line, layout_.separator);
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
      if (numbers || had_header_ || !looks_like_text(line))
        fail("line " + std::to_string(lines.number()), shown(line), "the numbers of a point");
      had_header_ = true;
      take_names(line);
    }
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
    const auto has = [&](Role role) {
      return std::any_of(names.begin(), names.end(), [&](const std::string& n) { return role_of_name(n, false, "") == role; });
    };
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
    while (sample_.size() < kSample && lines.next_filled(line)) {
      if (is_remark(line)) continue;
      layout_.decimal_comma = layout_.decimal_comma || (layout_.separator != ',' && has_decimal_commas(line));
      const auto parts = split_row(line, layout_.separator);
      if (sample_.empty()) width_ = parts.size();
      if (parts.size() != width_) break;  // the reader says what it found there, if it matters
      Row row;
      for (const std::string_view part : parts) {
        double value = kMissing;
        if (!row_number(part, layout_.decimal_comma, value)) value = kMissing;
        row.push_back(value);
      }
      sample_.push_back(std::move(row));
    }
    constexpr std::size_t kWidest = 1000;
    if (width_ < 2 || width_ > kWidest) fail("columns", std::to_string(width_), "2 to 1000");
    layout_.columns.resize(width_);
  }

  template <class Test>
  bool all(std::size_t column, Test test) const {
    return std::all_of(sample_.begin(), sample_.end(), [&](const Row& row) { return test(row[column]); });
  }
  bool whole(std::size_t column, double low, double high) const {
    return all(column, [&](double v) { return v == std::floor(v) && v >= low && v <= high; });
  }
  bool bytes_at(std::size_t column) const {
    return column + 3 <= width_ && whole(column, 0, 255) && whole(column + 1, 0, 255) &&
           whole(column + 2, 0, 255);
  }
  bool unit_at(std::size_t c) const {
    return c + 3 <= width_ && std::all_of(sample_.begin(), sample_.end(), [&](const Row& row) {
             const double length =
                 std::sqrt(row[c] * row[c] + row[c + 1] * row[c + 1] + row[c + 2] * row[c + 2]);
             return length == 0.0 || std::abs(length - 1.0) < 0.01;
           });
  }

  void set_three(std::size_t column, Role first, std::size_t count = 3) {
    for (std::size_t i = 0; i < count; ++i)
      layout_.columns[column + i].role = static_cast<Role>(static_cast<std::size_t>(first) + i);
  }

  void roles_from_names() {
    for (std::size_t c = 0; c < width_; ++c)
      layout_.columns[c].role =
          role_of_name(names_[c], whole(c, -2147483648.0, 2147483647.0), input_.options.label_field);
    settle_roles(layout_.columns);
    for (std::size_t c = 0; c < width_; ++c) {
      Column& column = layout_.columns[c];
      if (column.role != Role::red && column.role != Role::green && column.role != Role::blue) continue;
      const bool share = all(c, [](double v) { return v >= 0.0 && v <= 1.0; }) && !whole(c, 0, 255);
      column.scale = share ? 255.0 : whole(c, 0, 255) || !whole(c, 0, 65535) ? 1.0 : 1.0 / 257.0;
    }
    const double scale = common_color_scale();
    for (Column& column : layout_.columns)
      if (column.role == Role::red || column.role == Role::green || column.role == Role::blue)
        column.scale = scale;
  }

  /// A column that is 0 or 1 throughout says nothing of its range: the others decide.
  double common_color_scale() const {
    double scale = 1.0;
    for (const Column& column : layout_.columns)
      if (column.role == Role::red || column.role == Role::green || column.role == Role::blue)
        if (column.scale != 1.0) scale = column.scale;
    return scale;
  }

  /// Point numbers in the first of four or more columns. Where the second one stays the same, it may be a grid's first row.
  bool first_counts_rows() const {
    if (width_ < 4 || sample_.size() < 3) return false;
    for (std::size_t r = 0; r < sample_.size(); ++r)
      if (sample_[r][0] != sample_[0][0] + static_cast<double>(r) || sample_[r][0] != std::floor(sample_[r][0])) return false;
    return std::any_of(sample_.begin(), sample_.end(), [&](const Row& row) { return row[1] != sample_[0][1]; });
  }

  void roles_from_values() {
    const std::size_t first = first_counts_rows() ? 1 : 0;
    if (first == 1) layout_.notes.push_back("the first column counts the rows: left out");
    set_three(first, Role::x, std::min<std::size_t>(width_, 3));
    // x y z intensity r g b is what scanners write; the intensity may look like a colour.
    if (width_ == first + 7 && !unit_at(first + 3) && bytes_at(first + 4)) return set_colors(first + 4);
    bool normals = false, colors = false;
    for (std::size_t c = first + 3; c + 3 <= width_;) {
      if (!normals && unit_at(c)) {
        set_three(c, Role::nx);
        normals = true;
        c += 3;
      } else if (!colors && bytes_at(c)) {
        set_colors(c);
        colors = true;
        c += 3;
      } else {
        ++c;
      }
    }
  }

  void set_colors(std::size_t column) { set_three(column, Role::red); }

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
    layout_.notes.push_back(fmt::format("columns read as {} ({})", fmt::join(list, " "),
                                        names_.size() == width_ ? "by their names" : "guessed"));
    if (layout_.two_dimensional) layout_.notes.push_back("no z: read as a drawing");
    if (layout_.decimal_comma) layout_.notes.push_back("commas read as decimal points");
    for (const auto& [role, name] : {std::pair{Role::x, "x"}, {Role::y, "y"}, {Role::z, "z"}})
      for (std::size_t c = 0; c < width_; ++c)
        if (layout_.columns[c].role == role && all(c, [](double v) { return std::isnan(v); }))
          layout_.notes.push_back(std::string("column ") + name + " holds no number in the first rows");
    if (!input_.options.label_field.empty() && !has_role(layout_.columns, Role::label))
      fail("columns", "no column named " + input_.options.label_field, "the column of the labels");
  }

  /// PWN: the number of points, the points, then the normals.
  void find_normals_block(std::string_view bytes) {
    if (!layout_.promised || width_ != 3) return;
    if (count_filled_lines(bytes.substr(layout_.data)) != 2 * *layout_.promised) return;
    layout_.normals_follow = true;
    layout_.notes.push_back("twice as many rows as points: the second half read as normals");
  }

  const Input& input_;
  TextLayout layout_;
  std::vector<std::string> names_;
  bool had_header_ = false;
  std::vector<Row> sample_;
  std::size_t width_ = 0;
};

}  // namespace

TextLayout guess_text_layout(const Input& input) {
  return Guess(input).make();
}

bool is_remark(std::string_view line) {
  line = trim(line);
  return !line.empty() && (line[0] == '#' || line.substr(0, 2) == "//");
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
