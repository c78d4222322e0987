// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/surfaces/cut_off.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace unseen::cuboids {
namespace {

constexpr int kMargin = 16;          // pixels without depth, of a border of the picture or of an edge
constexpr double kCut = 0.3;         // of where the surface ends, that is the border
constexpr double kEnding = 0.05;     // … that has something farther beside it, or nothing

enum class Beside { border, hiding, farther };

/// What lies next to the end of a surface in one direction; other points of its plane are stepped over. None if the surface goes on behind them.
std::optional<Beside> beside(const Scan& scan, const Level& level, const std::vector<char>& on, int u, int v, int du, int dv) {
  for (int without = 0; without < kMargin;) {
    u += du;
    v += dv;
    if (u < 0 || v < 0 || u >= scan.width || v >= scan.height()) return Beside::border;
    const std::size_t pixel = static_cast<std::size_t>(v) * scan.width + u;
    if (on[pixel]) return std::nullopt;
    const int point = scan.point_of_pixel[pixel];
    if (point < 0) {
      ++without;
      continue;
    }
    const double distance = level.plane.signed_distance(scan.points[point]), noise = kOffPlane * scan.graph.sigma[point];
    if (std::abs(distance) > noise) return distance > 0.0 ? Beside::hiding : Beside::farther;
  }
  return Beside::farther;
}

}  // namespace

bool goes_on_beyond_picture(const Scan& scan, const Level& level) {
  if (scan.point_of_pixel.empty()) return false;
  std::vector<char> on(scan.point_of_pixel.size(), 0);
  const std::vector<int> points = points_of(scan, level.faces);
  for (const int i : points) on[scan.pixel_of_point[i]] = 1;
  std::array<double, 3> ends{};  // by what is beside
  for (const int i : points)
    for (const auto& [du, dv] : std::array<std::pair<int, int>, 4>{{{-1, 0}, {1, 0}, {0, -1}, {0, 1}}})
      if (const auto what = beside(scan, level, on, scan.pixel_of_point[i] % scan.width, scan.pixel_of_point[i] / scan.width, du, dv)) ++ends[static_cast<std::size_t>(*what)];
  const double all = ends[0] + ends[1] + ends[2];
  return ends[static_cast<std::size_t>(Beside::border)] > kCut * all && ends[static_cast<std::size_t>(Beside::farther)] < kEnding * all;
}

}  // namespace unseen::cuboids
