// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "unseen/core/point_cloud.h"

namespace unseen::io {

/// What a column of a file holds.
enum class Role : std::uint8_t { ignored, x, y, z, nx, ny, nz, red, green, blue, packed_rgb, label };

/// How a number is stored.
enum class Scalar : std::uint8_t { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

std::size_t size_of(Scalar type);
inline bool is_integer(Scalar type) {
  return type != Scalar::f32 && type != Scalar::f64;
}

struct Column {
  Role role = Role::ignored;
  Scalar type = Scalar::f64;
  std::size_t offset = 0;  ///< bytes from the start of the record
  double scale = 1.0;      ///< stored · scale + shift is the value
  double shift = 0.0;
};

/// The arrays that a block needs for some columns.
struct Attributes {
  bool normals = false, colors = false, labels = false;
};

/// A field's name in lower case, without its unit ("X (m)") and without what programs put around an axis ("pos_x", "cartesianX", "X coordinate").
std::string plain_name(std::string_view name);
/// The role that a field's name speaks of (upper or lower case). Labels: only for integers, unless
/// `label_field` names the field.
Role role_of_name(std::string_view name, bool integer, const std::string& label_field);
/// Takes roles away that came twice or that miss a partner (nx without ny), and sets the scale of colours.
void settle_roles(std::vector<Column>& columns);
bool has_role(const std::vector<Column>& columns, Role role);
Attributes attributes_of(const std::vector<Column>& columns);

/// Makes room for `count` points at the origin with the arrays of `attributes`.
void resize(PointCloud& block, const Attributes& attributes, std::size_t count);
/// Sets what `role` stands for in point i; block must have been sized for it.
void set_value(PointCloud& block, std::size_t i, const Column& column, double value);
std::uint8_t to_color(double value);
std::int32_t to_label(double value);

/// One number at `data`, in the other byte order than this machine's if `swap`.
template <class T>
T load(const char* data, bool swap) {
  unsigned char bytes[sizeof(T)];
  std::memcpy(bytes, data, sizeof(T));
  if (swap)
    for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
  return std::bit_cast<T>(bytes);
}
double load_scalar(const char* data, Scalar type, bool swap);

/// Decodes one column of `count` records that lie `stride` bytes apart into points [0, count) of the block.
void decode_column(const char* records, std::size_t stride, std::size_t count, const Column& column,
                   bool swap, PointCloud& block);

}  // namespace unseen::io
