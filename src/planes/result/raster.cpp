// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/result/raster.h"

namespace unseen::planes {
namespace {

/// Each cell combined with those within `radius` along both axes; `nothing` lies outside. Windows are put together from halves (van Herk), so that a
/// pass over the cells takes few steps, for 16 cells at a time.
template <class Combine>
Raster combined(const Raster& r, int radius, std::uint8_t nothing, Combine combine) {
  const std::size_t window = 2 * static_cast<std::size_t>(radius) + 1;
  Raster to = r;
  const auto slide = [&](std::size_t stride, std::size_t count, std::vector<std::uint8_t>& padded, std::uint8_t* out) {  // over `count` rows of `stride` cells
    std::size_t width = 1;
    for (; 2 * width <= window; width *= 2)
      for (std::size_t i = 0, end = padded.size() - width * stride; i < end; ++i) padded[i] = combine(padded[i], padded[i + width * stride]);
    const std::size_t second = (window - width) * stride;
    for (std::size_t i = 0; i < count * stride; ++i) out[i] = combine(padded[i], padded[i + second]);
  };
  const std::size_t width = static_cast<std::size_t>(r.width), height = static_cast<std::size_t>(r.height);
  std::vector<std::uint8_t> padded;
  for (std::size_t y = 0; y < height; ++y) {
    padded.assign(width + window - 1, nothing);
    std::copy_n(r.cells.begin() + static_cast<std::ptrdiff_t>(y * width), width, padded.begin() + radius);
    slide(1, width, padded, &to.cells[y * width]);
  }
  padded.assign((height + window - 1) * width, nothing);
  std::copy(to.cells.begin(), to.cells.end(), padded.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(radius) * width));
  slide(width, height, padded, to.cells.data());
  return to;
}

}  // namespace

Raster rasterize(const std::vector<Vec2>& points, const Vec2& low, const Vec2& high, double cell, int margin) {
  Raster r;
  r.width = static_cast<int>((high - low).x() / cell) + 1 + 2 * margin;
  r.height = static_cast<int>((high - low).y() / cell) + 1 + 2 * margin;
  r.cells.assign(static_cast<std::size_t>(r.width) * r.height, 0);
  for (const Vec2& p : points) r.at(static_cast<int>((p - low).x() / cell) + margin, static_cast<int>((p - low).y() / cell) + margin) = 1;
  return r;
}

Raster dilated(const Raster& r, int radius) {
  return combined(r, radius, 0, [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a | b); });
}

Raster closed(const Raster& r, int radius) {
  return combined(dilated(r, radius), radius, 1, [](std::uint8_t a, std::uint8_t b) { return static_cast<std::uint8_t>(a & b); });
}

void keep_largest(Raster& r) {
  std::vector<int> part(r.cells.size(), -1);
  std::vector<std::size_t> size, stack;
  const auto width = static_cast<std::size_t>(r.width);
  for (std::size_t s = 0; s < r.cells.size(); ++s) {
    if (!r.cells[s] || part[s] >= 0) continue;
    const int id = static_cast<int>(size.size());
    size.push_back(0);
    part[s] = id;
    stack = {s};
    while (!stack.empty()) {
      const std::size_t c = stack.back();
      stack.pop_back();
      ++size[id];
      for (const std::size_t next : {c - 1, c + 1, c - width, c + width})
        if (r.cells[next] && part[next] < 0) {
          part[next] = id;
          stack.push_back(next);
        }
    }
  }
  const int keep = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
  for (std::size_t c = 0; c < r.cells.size(); ++c) r.cells[c] = r.cells[c] && part[c] == keep;
}

}  // namespace unseen::planes
