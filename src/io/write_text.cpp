// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <iterator>

#include "io/file_writer.h"
#include "io/writers.h"

namespace unseen::io {
namespace {

/// Rows of the shortest text that reads back as the same number.
void write_rows(const Output& out, const std::string& header, const char* separator, bool labels) {
  FileWriter writer(out.path);
  writer.write(header);
  std::string text;
  for_each_block(out.source, [&](const PointCloud& block, std::size_t) {
    out.context.check();
    text.clear();
    const auto to = std::back_inserter(text);
    for (std::size_t i = 0; i < block.size(); ++i) {
      const Vec3& p = block.positions[i];
      fmt::format_to(to, "{1}{0}{2}{0}{3}", separator, p.x(), p.y(), p.z());
      if (out.has.normals)
        for (int k = 0; k < 3; ++k) fmt::format_to(to, "{}{}", separator, block.normals[i][k]);
      if (out.has.colors)
        for (const std::uint8_t c : block.colors[i])
          fmt::format_to(to, "{}{}", separator, static_cast<int>(c));
      if (labels) fmt::format_to(to, "{}{}", separator, block.labels[i]);
      text += '\n';
    }
    writer.write(text);
  });
  writer.close();
}

}  // namespace

void write_xyz(const Output& out) {
  if (out.has.labels) out.context.warn("labels not written: XYZ has no column for them (CSV has)");
  write_rows(out, "", " ", false);
}

void write_csv(const Output& out) {
  std::string header = "x,y,z";
  if (out.has.normals) header += ",nx,ny,nz";
  if (out.has.colors) header += ",red,green,blue";
  if (out.has.labels) header += ",label";
  write_rows(out, header + "\n", ",", out.has.labels);
}

}  // namespace unseen::io
