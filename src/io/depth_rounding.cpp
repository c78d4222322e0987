// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "io/depth_rounding.h"

#include <algorithm>
#include <utility>

namespace unseen::io {
namespace {

constexpr double kUsual = 0.05;    // of the pixels that the most frequent value nearby has, one has which the sensor tells
constexpr double kNearby = 0.03;   // of the depth, to either side
constexpr std::size_t kFewest = 30;  // values
constexpr double kAlike = 1.5;     // times as large a gap may be as the one before it, beside what whole millimetres make of it
constexpr double kInOrder = 0.8;   // of the pixels are at such gaps

struct Value {
  double millimetres;
  double pixels;
};

/// Values that are none of single pixels on an edge.
std::vector<Value> usual_values(const std::vector<std::uint64_t>& pixels) {
  std::vector<Value> all, usual;
  for (std::size_t z = 1; z < pixels.size(); ++z)
    if (pixels[z] > 0) all.push_back({static_cast<double>(z), static_cast<double>(pixels[z])});
  for (auto v = all.begin(), begin = all.begin(), end = all.begin(); v != all.end(); ++v) {
    while (begin->millimetres < (1.0 - kNearby) * v->millimetres) ++begin;
    while (end != all.end() && end->millimetres <= (1.0 + kNearby) * v->millimetres) ++end;
    const double most = std::max_element(begin, end, [](const Value& a, const Value& b) { return a.pixels < b.pixels; })->pixels;
    if (v->pixels >= kUsual * most) usual.push_back(*v);
  }
  return usual;
}

}  // namespace

void DepthValues::add(const DepthImage& image, double low, double high) {
  for (const std::uint16_t z : image.millimetres)
    if (1e-3 * z >= low && 1e-3 * z <= high) ++pixels_[z];
}

double DepthValues::rounding() const {
  const std::vector<Value> values = usual_values(pixels_);
  if (values.size() < kFewest) return 0.0;
  std::vector<std::pair<double, double>> gaps;  // mm, and pixels
  double in_order = 0, all = 0, before = values[1].millimetres - values[0].millimetres;
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double gap = values[i].millimetres - values[i - 1].millimetres;
    gaps.emplace_back(gap, values[i].pixels);
    all += values[i].pixels;
    if (gap < kAlike * before + 1.0 && before < kAlike * gap + 1.0) in_order += values[i].pixels;
    before = gap;
  }
  if (in_order < kInOrder * all) return 0.0;
  std::sort(gaps.begin(), gaps.end());
  auto typical = gaps.begin();
  for (double below = typical->second; below < 0.5 * all; below += typical->second) ++typical;
  return 1e-3 * typical->first;
}

}  // namespace unseen::io
