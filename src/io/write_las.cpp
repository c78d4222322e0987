// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <cmath>

#include "io/bytes_out.h"
#include "io/file_writer.h"
#include "io/text.h"
#include "io/writers.h"
#include "unseen/core/error.h"

namespace unseen::io {
namespace {

struct Bounds {
  Vec3 low = Vec3::Constant(INFINITY), high = Vec3::Constant(-INFINITY);
  std::size_t count = 0, dropped = 0;
};

Bounds bounds_of(const Output& out) {
  Bounds bounds;
  for_each_block(out.source, [&](const PointCloud& block, std::size_t) {
    out.context.check();
    for (const Vec3& p : block.positions) {
      if (!p.allFinite()) {
        ++bounds.dropped;
        continue;
      }
      ++bounds.count;
      bounds.low = bounds.low.cwiseMin(p);
      bounds.high = bounds.high.cwiseMax(p);
    }
  });
  return bounds;
}

/// Integers of 32 bits times `scale` plus `offset`.
struct Grid {
  Vec3 scale, offset;
};

/// The finest power of ten that covers the extent, but no finer than a double is at that distance from zero.
Grid grid_of(const Bounds& bounds) {
  Grid grid;
  for (int k = 0; k < 3; ++k) {
    grid.offset[k] = std::round(0.5 * bounds.low[k] + 0.5 * bounds.high[k]);
    const double reach = std::max(bounds.high[k] - grid.offset[k], grid.offset[k] - bounds.low[k]);
    const double most = std::max(std::abs(bounds.low[k]), std::abs(bounds.high[k]));
    const double finest = std::max({reach / 2e9, most * 2e-16, 1e-12});
    grid.scale[k] = std::pow(10.0, std::ceil(std::log10(finest) - 1e-9));
  }
  return grid;
}

std::string header(const Bounds& bounds, const Grid& grid) {
  constexpr std::uint16_t kHeader = 227, kRecord = 20;
  std::string h = "LASF";
  h.append(20, '\0');  // source, encoding, project
  h += '\x01';
  h += '\x02';  // version 1.2
  std::string names = "unseen";
  names.resize(32);
  names += "unseen convert";
  names.resize(64);
  h += names;
  append_little(h, std::uint16_t{0});  // no date: the same input gives the same bytes
  append_little(h, std::uint16_t{0});
  append_little(h, kHeader);
  append_little(h, std::uint32_t{kHeader});
  append_little(h, std::uint32_t{0});
  h += '\0';  // point format
  append_little(h, kRecord);
  append_little(h, static_cast<std::uint32_t>(bounds.count));
  append_little(h, static_cast<std::uint32_t>(bounds.count));  // all are first returns
  h.append(16, '\0');
  for (int k = 0; k < 3; ++k) append_little(h, grid.scale[k]);
  for (int k = 0; k < 3; ++k) append_little(h, grid.offset[k]);
  for (int k = 0; k < 3; ++k) {
    append_little(h, bounds.high[k]);
    append_little(h, bounds.low[k]);
  }
  return h;
}

}  // namespace

void write_las(const Output& out) {
  const Bounds bounds = bounds_of(out);
  const std::string name = out.source.info().name;
  if (bounds.count == 0) throw InputError(name, "points", "no finite one", "points to write");
  if (bounds.count > 0xffffffffu)
    throw InputError(name, "points", std::to_string(bounds.count),
                     "at most 4294967295, which LAS 1.2 can count");
  if (bounds.dropped > 0)
    out.context.warn(count_of(bounds.dropped, "point") + " not finite and not written: LAS cannot hold them");
  if (out.has.normals || out.has.colors || out.has.labels)
    out.context.warn("normals, colours and labels not written: LAS point format 0 holds positions");
  const Grid grid = grid_of(bounds);
  FileWriter writer(out.path);
  writer.write(header(bounds, grid));
  std::string bytes;
  for_each_block(out.source, [&](const PointCloud& block, std::size_t) {
    out.context.check();
    bytes.clear();
    for (const Vec3& p : block.positions) {
      if (!p.allFinite()) continue;
      for (int k = 0; k < 3; ++k)
        append_little(bytes, clamped<std::int32_t>((p[k] - grid.offset[k]) / grid.scale[k]));
      bytes.append(2, '\0');  // intensity
      bytes += '\x09';        // the first of one return
      bytes.append(5, '\0');  // class, angle, user data, source
    }
    writer.write(bytes);
  });
  writer.close();
}

}  // namespace unseen::io
