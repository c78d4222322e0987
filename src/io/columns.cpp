// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/columns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "io/text.h"

namespace unseen::io {
namespace {

/// Calls body with a value of the C++ type that `type` stands for.
template <class Body>
auto with_type(Scalar type, Body&& body) {
  switch (type) {
    case Scalar::i8:
      return body(std::int8_t{});
    case Scalar::u8:
      return body(std::uint8_t{});
    case Scalar::i16:
      return body(std::int16_t{});
    case Scalar::u16:
      return body(std::uint16_t{});
    case Scalar::i32:
      return body(std::int32_t{});
    case Scalar::u32:
      return body(std::uint32_t{});
    case Scalar::i64:
      return body(std::int64_t{});
    case Scalar::u64:
      return body(std::uint64_t{});
    case Scalar::f32:
      return body(float{});
    case Scalar::f64:
      break;
  }
  return body(double{});
}

void set_packed(PointCloud& block, std::size_t i, Scalar type, double value) {
  std::uint32_t bits = 0;
  if (type == Scalar::f32 || type == Scalar::f64)
    bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  else if (value >= -2147483648.0 && value <= 4294967295.0)
    bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
  block.colors[i] = {static_cast<std::uint8_t>(bits >> 16), static_cast<std::uint8_t>(bits >> 8),
                     static_cast<std::uint8_t>(bits)};
}

bool complete(const std::vector<Column>& columns, std::initializer_list<Role> roles) {
  return std::all_of(roles.begin(), roles.end(), [&](Role role) { return has_role(columns, role); });
}

}  // namespace

std::size_t size_of(Scalar type) {
  return with_type(type, [](auto value) { return sizeof(value); });
}

std::string plain_name(std::string_view name) {
  std::string key = lower(trim(name));
  if (const std::size_t unit = key.find_first_of("(["); unit != std::string::npos && unit > 0) key = trim(std::string_view(key).substr(0, unit));
  std::string axis = key;
  std::replace_if(axis.begin(), axis.end(), [](char c) { return c == '_' || c == '.'; }, ' ');
  for (const std::string_view around : {"cartesian", "coordinates", "coordinate", "coord", "position", "pos"})
    if (const std::size_t at = axis.find(around); at != std::string::npos) std::fill_n(axis.begin() + static_cast<std::ptrdiff_t>(at), around.size(), ' ');
  const std::vector<std::string_view> left = words(axis);
  const bool names_axis = !left.empty() && left.size() <= 2 && left[0].size() == 1 && (left.size() == 1 || left[1] == "m");
  return names_axis ? std::string(left[0]) : key;
}

Role role_of_name(std::string_view name, bool integer, const std::string& label_field) {
  if (!label_field.empty()) {
    if (name == label_field) return Role::label;
  } else if (integer) {
    for (const char* label : {"label", "segment_index", "plane", "class"})
      if (lower(name) == label) return Role::label;
  }
  struct Known {
    Role role;
    std::initializer_list<std::string_view> names;
  };
  static const Known kKnown[] = {{Role::x, {"x", "points:0", "points_0", "easting", "east", "rechtswert"}},
                                 {Role::y, {"y", "points:1", "points_1", "northing", "north", "hochwert"}},
                                 {Role::z, {"z", "points:2", "points_2", "height", "elevation", "elev", "altitude", "höhe", "hoehe"}},
                                 {Role::nx, {"nx", "normal_x", "normalx", "normals:0", "normals_0"}},
                                 {Role::ny, {"ny", "normal_y", "normaly", "normals:1", "normals_1"}},
                                 {Role::nz, {"nz", "normal_z", "normalz", "normals:2", "normals_2"}},
                                 {Role::red, {"red", "diffuse_red", "r", "colorred", "rgb:0", "rgb_0"}},
                                 {Role::green, {"green", "diffuse_green", "g", "colorgreen", "rgb:1", "rgb_1"}},
                                 {Role::blue, {"blue", "diffuse_blue", "b", "colorblue", "rgb:2", "rgb_2"}}};
  const std::string key = plain_name(name);
  for (const Known& known : kKnown)
    if (std::find(known.names.begin(), known.names.end(), key) != known.names.end()) return known.role;
  return Role::ignored;
}

bool has_role(const std::vector<Column>& columns, Role role) {
  return std::any_of(columns.begin(), columns.end(), [&](const Column& c) { return c.role == role; });
}

void settle_roles(std::vector<Column>& columns) {
  std::array<bool, 16> seen{};
  for (Column& column : columns) {
    bool& used = seen[static_cast<std::size_t>(column.role)];
    if (used) column.role = Role::ignored;
    used = true;
  }
  const auto drop = [&](std::initializer_list<Role> roles) {
    for (Column& column : columns)
      if (std::find(roles.begin(), roles.end(), column.role) != roles.end()) column.role = Role::ignored;
  };
  if (!complete(columns, {Role::nx, Role::ny, Role::nz})) drop({Role::nx, Role::ny, Role::nz});
  if (!complete(columns, {Role::red, Role::green, Role::blue})) drop({Role::red, Role::green, Role::blue});
  if (has_role(columns, Role::red)) drop({Role::packed_rgb});
  for (Column& column : columns)
    if (column.role == Role::red || column.role == Role::green || column.role == Role::blue) {
      if (column.type == Scalar::u16) column.scale = 1.0 / 257.0;
      if (!is_integer(column.type)) column.scale = 255.0;
    }
}

Attributes attributes_of(const std::vector<Column>& columns) {
  return {has_role(columns, Role::nx), has_role(columns, Role::red) || has_role(columns, Role::packed_rgb),
          has_role(columns, Role::label)};
}

void resize(PointCloud& block, const Attributes& attributes, std::size_t count) {
  block.positions.assign(count, Vec3::Zero());
  block.normals.assign(attributes.normals ? count : 0, Vec3f::Zero());
  block.colors.assign(attributes.colors ? count : 0, {0, 0, 0});
  block.labels.assign(attributes.labels ? count : 0, -1);
  block.viewpoint.reset();
}

std::uint8_t to_color(double value) {
  return value > 0.0 ? static_cast<std::uint8_t>(std::min(value, 255.0) + 0.5) : std::uint8_t{0};
}

std::int32_t to_label(double value) {
  if (std::isnan(value)) return -1;
  return static_cast<std::int32_t>(std::clamp(std::round(value), -2147483648.0, 2147483647.0));
}

void set_value(PointCloud& block, std::size_t i, const Column& column, double value) {
  switch (column.role) {
    case Role::ignored:
      break;
    case Role::x:
      block.positions[i].x() = value;
      break;
    case Role::y:
      block.positions[i].y() = value;
      break;
    case Role::z:
      block.positions[i].z() = value;
      break;
    case Role::nx:
      block.normals[i].x() = static_cast<float>(value);
      break;
    case Role::ny:
      block.normals[i].y() = static_cast<float>(value);
      break;
    case Role::nz:
      block.normals[i].z() = static_cast<float>(value);
      break;
    case Role::red:
      block.colors[i][0] = to_color(value * column.scale);
      break;
    case Role::green:
      block.colors[i][1] = to_color(value * column.scale);
      break;
    case Role::blue:
      block.colors[i][2] = to_color(value * column.scale);
      break;
    case Role::packed_rgb:
      set_packed(block, i, column.type, value);
      break;
    case Role::label:
      block.labels[i] = to_label(value);
      break;
  }
}

double load_scalar(const char* data, Scalar type, bool swap) {
  return with_type(type, [&](auto zero) { return static_cast<double>(load<decltype(zero)>(data, swap)); });
}

void decode_column(const char* records, std::size_t stride, std::size_t count, const Column& column,
                   bool swap, PointCloud& block) {
  if (column.role == Role::ignored) return;
  with_type(column.type, [&](auto zero) {
    using T = decltype(zero);
    const char* at = records + column.offset;
    const bool coordinate = column.role == Role::x || column.role == Role::y || column.role == Role::z;
    if (coordinate) {
      const int axis = static_cast<int>(column.role) - static_cast<int>(Role::x);
      for (std::size_t i = 0; i < count; ++i, at += stride)
        block.positions[i][axis] = static_cast<double>(load<T>(at, swap)) * column.scale + column.shift;
    } else {
      for (std::size_t i = 0; i < count; ++i, at += stride)
        set_value(block, i, column, static_cast<double>(load<T>(at, swap)));
    }
  });
}

}  // namespace unseen::io
