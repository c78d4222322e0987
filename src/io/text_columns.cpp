// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/text_columns.h"

#include "io/text.h"

namespace unseen::io {
namespace {

void set_three(TextLayout& layout, std::size_t column, Role first, std::size_t count = 3) {
  for (std::size_t i = 0; i < count; ++i)
    layout.columns[column + i].role = static_cast<Role>(static_cast<std::size_t>(first) + i);
}

/// A single column of numbers beside x and y is the third coordinate, unless its name is that of something else.
void take_other_as_z(const TextSample& sample, const std::vector<std::string>& names, TextLayout& layout) {
  static constexpr std::string_view kNoAxis[] = {"intensity", "i", "reflectance", "reflectivity", "amplitude", "scalar", "time", "t", "timestamp", "gpstime", "gps_time", "id", "index",
                                                 "idx", "label", "class", "classification", "segment", "plane", "alpha", "a", "quality", "confidence", "weight", "width", "error", "code", "lat", "latitude", "lon", "longitude"};
  std::vector<std::size_t> others;
  for (std::size_t c = 0; c < sample.width; ++c)
    if (layout.columns[c].role == Role::ignored && !names[c].empty() && sample.all(c, [](double v) { return !std::isnan(v); })) others.push_back(c);
  if (others.size() != 1 || std::find(std::begin(kNoAxis), std::end(kNoAxis), plain_name(names[others[0]])) != std::end(kNoAxis)) return;
  layout.columns[others[0]].role = Role::z;
  layout.notes.push_back("column " + shown(names[others[0]]) + " read as z");
}

/// A column that is 0 or 1 throughout says nothing of its range: the others decide.
double common_color_scale(const std::vector<Column>& columns) {
  double scale = 1.0;
  for (const Column& column : columns)
    if (column.role == Role::red || column.role == Role::green || column.role == Role::blue)
      if (column.scale != 1.0) scale = column.scale;
  return scale;
}

/// Point numbers in the first of four or more columns. Where the second one stays the same, it may be a grid's first row.
bool first_counts_rows(const TextSample& sample) {
  if (sample.width < 4 || sample.rows.size() < 3) return false;
  for (std::size_t r = 0; r < sample.rows.size(); ++r)
    if (sample.rows[r][0] != sample.rows[0][0] + static_cast<double>(r) || sample.rows[r][0] != std::floor(sample.rows[r][0])) return false;
  return std::any_of(sample.rows.begin(), sample.rows.end(), [&](const std::vector<double>& row) { return row[1] != sample.rows[0][1]; });
}

/// Row and column of a scanner's grid before the coordinates.
bool has_grid_places(const TextSample& sample) {
  const auto fraction = [&](std::size_t c) { return !sample.whole(c, -1e15, 1e15); };
  return sample.width >= 5 && sample.rows.size() > 2 && sample.whole(0, 0, 1e6) && sample.whole(1, 0, 1e6) && fraction(2) && fraction(3) && fraction(4) && !sample.unit_at(3);
}

}  // namespace

std::vector<Role> roles_of_names(const std::vector<std::string>& names) {
  std::vector<Role> roles;
  std::vector<std::string> plain;
  for (const std::string& name : names) {
    roles.push_back(role_of_name(name, false, ""));
    plain.push_back(plain_name(name));
  }
  const auto has = [&](Role role) { return std::find(roles.begin(), roles.end(), role) != roles.end(); };
  const auto at = [&](const char* name) { return static_cast<std::size_t>(std::find(plain.begin(), plain.end(), name) - plain.begin()); };
  if (const std::size_t e = at("e"), n = at("n"); !has(Role::x) && !has(Role::y) && e < names.size() && n < names.size()) {
    roles[e] = Role::x;
    roles[n] = Role::y;
  }
  if (const std::size_t h = at("h"); !has(Role::z) && h < names.size()) roles[h] = Role::z;
  return roles;
}

void roles_from_names(const TextSample& sample, const std::vector<std::string>& names, const std::string& label_field, TextLayout& layout) {
  const std::vector<Role> roles = roles_of_names(names);
  for (std::size_t c = 0; c < sample.width; ++c) {
    const Role role = role_of_name(names[c], sample.whole(c, -2147483648.0, 2147483647.0), label_field);
    layout.columns[c].role = role == Role::ignored ? roles[c] : role;
  }
  if (!has_role(layout.columns, Role::z)) take_other_as_z(sample, names, layout);
  settle_roles(layout.columns);
  for (std::size_t c = 0; c < sample.width; ++c) {
    Column& column = layout.columns[c];
    if (column.role != Role::red && column.role != Role::green && column.role != Role::blue) continue;
    const bool share = sample.all(c, [](double v) { return v >= 0.0 && v <= 1.0; }) && !sample.whole(c, 0, 255);
    column.scale = share ? 255.0 : sample.whole(c, 0, 255) || !sample.whole(c, 0, 65535) ? 1.0 : 1.0 / 257.0;
  }
  const double scale = common_color_scale(layout.columns);
  for (Column& column : layout.columns)
    if (column.role == Role::red || column.role == Role::green || column.role == Role::blue)
      column.scale = scale;
}

void roles_from_values(const TextSample& sample, std::string_view extension, TextLayout& layout) {
  const std::size_t first = has_grid_places(sample) ? 2 : first_counts_rows(sample) ? 1 : 0;
  if (first == 1) layout.notes.push_back("the first column counts the rows: left out");
  if (first == 2) layout.notes.push_back("the first two columns are places in a grid: left out");
  set_three(layout, first, Role::x, std::min<std::size_t>(sample.width, 3));
  // x y z intensity r g b is what scanners write; the intensity may look like a colour.
  if (sample.width == first + 7 && !sample.unit_at(first + 3) && sample.bytes_at(first + 4)) return set_three(layout, first + 4, Role::red);
  if (extension == "xyzrgb" && sample.width == 6 && sample.shares_at(3)) {
    set_three(layout, 3, Role::red);
    for (std::size_t c = 3; c < 6; ++c) layout.columns[c].scale = 255.0;
    return;
  }
  bool normals = false, colors = false;
  for (std::size_t c = first + 3; c + 3 <= sample.width;) {
    if (!normals && sample.unit_at(c)) {
      set_three(layout, c, Role::nx);
      normals = true;
      c += 3;
    } else if (!colors && sample.bytes_at(c)) {
      set_three(layout, c, Role::red);
      colors = true;
      c += 3;
    } else {
      ++c;
    }
  }
}

}  // namespace unseen::io
