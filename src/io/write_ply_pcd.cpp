// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/bytes_out.h"
#include "io/file_writer.h"
#include "io/writers.h"
#include "unseen/io/ply_writer.h"

namespace unseen::io {
namespace {

/// How far single precision moves a coordinate at most, m. What is no number stays it.
double lost_by_single(const Output& out) {
  double most = 0;
  for_each_block(out.source, [&](const PointCloud& block, std::size_t) {
    out.context.check();
    for (const Vec3& p : block.positions)
      for (int k = 0; k < 3; ++k) most = std::max(most, std::isfinite(p[k]) ? std::abs(p[k] - static_cast<double>(static_cast<float>(p[k]))) : 0.0);
  });
  return most;
}

/// As long for every count, like the header of PlyWriter.
std::string pcd_header(const Output& out, bool single, std::size_t count) {
  std::string fields = "x y z", size = single ? "4 4 4" : "8 8 8", type = "F F F", counts = "1 1 1";
  const auto add = [&](const char* f, const char* s, const char* t, const char* c) {
    fields += f;
    size += s;
    type += t;
    counts += c;
  };
  if (out.has.normals) add(" normal_x normal_y normal_z", " 4 4 4", " F F F", " 1 1 1");
  if (out.has.colors) add(" rgb", " 4", " U", " 1");
  if (out.has.labels) add(" label", " 4", " I", " 1");
  const Vec3 eye = out.source.info().viewpoint.value_or(Vec3::Zero());
  constexpr std::size_t kDigits = 40;
  const std::string digits = std::to_string(count);
  return fmt::format(
      "# .PCD v0.7 - Point Cloud Data file format\n# unseen{}\nVERSION 0.7\nFIELDS {}\nSIZE {}\nTYPE "
      "{}\nCOUNT {}\n"
      "WIDTH {}\nHEIGHT 1\nVIEWPOINT {} {} {} 1 0 0 0\nPOINTS {}\nDATA binary\n",
      std::string(kDigits - 2 * digits.size(), ' '), fields, size, type, counts, digits, eye.x(), eye.y(),
      eye.z(), digits);
}

}  // namespace

void write_ply(const Output& out) {
  using Type = PlyColumn::Type;
  std::vector<PlyColumn> columns;
  for (const char* name : {"x", "y", "z"}) columns.push_back({name, Type::float64});
  if (out.has.normals)
    for (const char* name : {"nx", "ny", "nz"}) columns.push_back({name, Type::float32});
  if (out.has.colors)
    for (const char* name : {"red", "green", "blue"}) columns.push_back({name, Type::uint8});
  if (out.has.labels) columns.push_back({"label", Type::int32});
  PlyWriter writer(out.path, columns);
  std::vector<double> row(columns.size());
  for_each_block(out.source, [&](const PointCloud& block, std::size_t) {
    out.context.check();
    for (std::size_t i = 0; i < block.size(); ++i) {
      double* to = row.data();
      for (int k = 0; k < 3; ++k) *to++ = block.positions[i][k];
      for (int k = 0; out.has.normals && k < 3; ++k) *to++ = static_cast<double>(block.normals[i][k]);
      for (std::size_t k = 0; out.has.colors && k < 3; ++k) *to++ = block.colors[i][k];
      if (out.has.labels) *to++ = block.labels[i];
      writer.add(row);
    }
  });
  writer.finish();
}

void write_pcd(const Output& out) {
  constexpr double kHardly = 1e-5;  // m
  const bool single = lost_by_single(out) < kHardly;  // PCL and Open3D take no others
  if (!single) out.context.warn("the coordinates need double precision, and programs that use PCL read none: take an offset off them first, or write PLY");
  FileWriter writer(out.path);
  writer.write(pcd_header(out, single, 0));
  std::size_t count = 0;
  std::string bytes;
  for_each_block(out.source, [&](const PointCloud& block, std::size_t) {
    out.context.check();
    bytes.clear();
    for (std::size_t i = 0; i < block.size(); ++i) {
      for (int k = 0; k < 3; ++k) {
        if (single) append_little(bytes, static_cast<float>(block.positions[i][k]));
        else append_little(bytes, block.positions[i][k]);
      }
      for (int k = 0; out.has.normals && k < 3; ++k) append_little(bytes, block.normals[i][k]);
      if (out.has.colors) {
        const auto& c = block.colors[i];
        append_little(bytes, static_cast<std::uint32_t>(c[0] << 16 | c[1] << 8 | c[2]));
      }
      if (out.has.labels) append_little(bytes, block.labels[i]);
    }
    writer.write(bytes);
    count += block.size();
  });
  writer.patch(0, pcd_header(out, single, count));
  writer.close();
}

}  // namespace unseen::io
