// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/seam_lines.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr std::array<double, 3> kBeside = {2.0, 3.5, 6.0};  // pixels, from a seam to what is beside it: of narrow ones, and of wide ones,
constexpr double kMostBeside = 0.009;  // m, at most: what is wider is a strap, or a shadow
constexpr double kRowPixels = 3.0;    // along a line, that are looked at together
constexpr double kLeastContrast = 5.0, kContrastNoise = 2.5;  // of 255; times the noise of the picture
constexpr int kOnLine = 1, kBesideLine = 4;    // places: a line may be off by so much; what is beside it is no farther
constexpr double kUsual = 0.75, kLeastUsual = 0.02;  // of the lines of a side; of a line
constexpr int kMostPlaces = 4000;
constexpr double kOnLevel = 3.0, kFewLeft = 0.1;  // σ, of a point to the plane that it is on; of the points, on none
constexpr std::size_t kMostLevels = 12;
constexpr double kShortest = 0.2;     // pixels a step, of a direction that runs away from the camera

/// A point of a side: where it is, and what the picture shows there across a line.
struct Look {
  double across = 0, along = 0;  ///< m
  double dark = 0, step = 0;     ///< of 255: than what is on either side, and between both sides
};

/// m: where most of some values lie that scatter by `spread` to either side, then where most of the others do, until few are left; the first twelve.
std::vector<double> levels_of_most(std::vector<double> values, double spread) {
  std::sort(values.begin(), values.end());
  const auto fewest = static_cast<std::size_t>(kFewLeft * static_cast<double>(values.size()));
  std::vector<double> levels;
  while (values.size() > fewest && levels.size() < kMostLevels) {
    std::size_t best = 0, from = 0, low = 0;
    for (std::size_t high = 0; high < values.size(); ++high) {
      while (values[high] - values[low] > 2.0 * spread) ++low;
      if (high - low + 1 > best) best = high - low + 1, from = low;
    }
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(from);
    levels.push_back(std::accumulate(first, first + static_cast<std::ptrdiff_t>(best), 0.0) / static_cast<double>(best));
    values.erase(first, first + static_cast<std::ptrdiff_t>(best));
  }
  return levels;
}

struct Cell {
  double dark = 0, step = 0;
  int count = 0;
};

/// All looks at a side, and what a pixel is there.
struct Looks {
  std::vector<Look> at;
  double width = 0, height = 0;  ///< m, of a pixel across and along the lines
  double contrast = 0;           ///< of 255, that is no noise
};

/// Places are those where the rays meet the planes of the side: the noise of the depth would bend the lines.
Looks looks_at(const GreyPicture& picture, const Camera& camera, const Observation& seen, const Directions& directions, std::span<const int> points, int across, int along) {
  const RigidTransform T_camera_world = seen.T_world_camera.inverse();
  const std::array<Vec3, 3> axes{Vec3(directions.along.x(), directions.along.y(), 0), Vec3(-directions.along.y(), directions.along.x(), 0), Vec3::UnitZ()};
  const int out = 3 - across - along;
  const Vec3& eye = seen.T_world_camera.translation;
  const double eye_out = directions(eye)[out];
  std::vector<double> outs;
  double spread = 0;
  for (const int i : points) {
    outs.push_back(directions(seen.points[i])[out]);
    spread += kOnLevel * seen.graph.sigma[i] / static_cast<double>(points.size());
  }
  const std::vector<double> levels = levels_of_most(outs, spread);
  Looks looks;
  std::vector<double> width, height, noise;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const auto level = std::find_if(levels.begin(), levels.end(), [&](double l) { return std::abs(outs[n] - l) < spread; });
    if (level == levels.end() || std::abs(outs[n] - eye_out) < spread) continue;
    const Vec3 p = eye + (*level - eye_out) / (outs[n] - eye_out) * (seen.points[points[n]] - eye);
    const double spacing = seen.graph.spacing[points[n]];
    const Vec2 at = camera.project(T_camera_world * p);
    const Vec2 over = camera.project(T_camera_world * (p + spacing * axes[across])) - at, on = camera.project(T_camera_world * (p + spacing * axes[along])) - at;
    if (over.norm() < kShortest || on.norm() < kShortest) continue;
    width.push_back(spacing / over.norm());
    height.push_back(spacing / on.norm());
    const Vec2 unit = over.normalized();
    const double here = picture.at(at);
    double dark = -here, step = 0;
    for (const double beside : kBeside) {
      if (beside > kBeside.front() && beside * width.back() > kMostBeside) break;
      const double before = picture.at(at - beside * unit), beyond = picture.at(at + beside * unit);
      dark = std::max(dark, std::min(before, beyond) - here);
      if (beside == kBeside.front()) step = beyond - before;
    }
    noise.push_back(std::abs(picture.at(at - unit) - 2.0 * here + picture.at(at + unit)));
    const Vec3 q = directions(p);
    looks.at.push_back({q[across], q[along], dark, step});
  }
  if (looks.at.empty()) return looks;
  looks.width = median(std::move(width));
  looks.height = median(std::move(height));
  looks.contrast = std::max(kLeastContrast, kContrastNoise * median(std::move(noise)) / (0.6745 * std::sqrt(6.0)));
  return looks;
}

/// Looks by place across the lines (columns) and along them (rows).
struct Grid {
  double low = 0, width = 0;  ///< m, of the columns
  int columns = 0, rows = 0;
  std::vector<Cell> cells;

  const Cell* row(int r) const { return &cells[static_cast<std::size_t>(r) * columns]; }
  bool has(int r, int from, int to) const {
    const Cell* cells_of_row = row(r);
    for (int c = std::max(from, 0); c <= std::min(to, columns - 1); ++c)
      if (cells_of_row[c].count > 0) return true;
    return false;
  }
};

Grid grid_of(const Looks& looks) {
  const auto [left, right] = std::minmax_element(looks.at.begin(), looks.at.end(), [](const Look& a, const Look& b) { return a.across < b.across; });
  const auto [first, last] = std::minmax_element(looks.at.begin(), looks.at.end(), [](const Look& a, const Look& b) { return a.along < b.along; });
  Grid grid{left->across, std::max(looks.width, (right->across - left->across) / kMostPlaces), 0, 0, {}};
  const double bottom = first->along, height = std::max(kRowPixels * looks.height, (last->along - bottom) / kMostPlaces);
  grid.columns = static_cast<int>((right->across - grid.low) / grid.width) + 1;
  grid.rows = static_cast<int>((last->along - bottom) / height) + 1;
  grid.cells.resize(static_cast<std::size_t>(grid.columns) * grid.rows);
  for (const Look& look : looks.at) {
    Cell& cell = grid.cells[static_cast<std::size_t>((look.along - bottom) / height) * grid.columns + static_cast<std::size_t>((look.across - grid.low) / grid.width)];
    cell.dark += look.dark;
    cell.step += look.step;
    ++cell.count;
  }
  return grid;
}

}  // namespace

GreyPicture::GreyPicture(const RgbdFrame& frame) : width_(frame.camera.width), height_(frame.camera.height) {
  for (const auto& c : frame.color) value_.push_back(static_cast<float>((299 * c[0] + 587 * c[1] + 114 * c[2]) / 1000.0));
}

double GreyPicture::at(const Vec2& p) const {
  const auto value = [&](int x, int y) { return value_[static_cast<std::size_t>(std::clamp(y, 0, height_ - 1)) * width_ + std::clamp(x, 0, width_ - 1)]; };
  const int x = static_cast<int>(std::floor(p.x())), y = static_cast<int>(std::floor(p.y()));
  const double u = p.x() - x, v = p.y() - y;
  return (1 - v) * ((1 - u) * value(x, y) + u * value(x + 1, y)) + v * ((1 - u) * value(x, y + 1) + u * value(x + 1, y + 1));
}

SeamLines seam_lines(const GreyPicture& picture, const Camera& camera, const Observation& seen, const Directions& directions, std::span<const int> points, int across, int along) {
  const Looks looks = looks_at(picture, camera, seen, directions, points, across, along);
  SeamLines lines;
  if (looks.at.empty()) return lines;
  const Grid grid = grid_of(looks);
  lines.low = grid.low;
  lines.width = grid.width;
  lines.rows.assign(grid.columns, 0);
  lines.dark.assign(grid.columns, 0.0);
  lines.step = {lines.dark, lines.dark};
  for (int c = 0; c < grid.columns; ++c) {
    for (int r = 0; r < grid.rows; ++r) {
      if (!grid.has(r, c - kBesideLine, c - kOnLine - 1) || !grid.has(r, c + kOnLine + 1, c + kBesideLine) || !grid.has(r, c - kOnLine, c + kOnLine)) continue;
      double dark = 0, down = 0, up = 0;
      for (int k = std::max(c - kOnLine, 0); k <= std::min(c + kOnLine, grid.columns - 1); ++k) {
        const Cell& cell = grid.row(r)[k];
        if (cell.count == 0) continue;
        dark = std::max(dark, cell.dark / cell.count);
        up = std::max(up, cell.step / cell.count);
        down = std::max(down, -cell.step / cell.count);
      }
      ++lines.rows[c];
      lines.dark[c] += dark > looks.contrast;
      lines.step[0][c] += down > looks.contrast;
      lines.step[1][c] += up > looks.contrast;
    }
    for (std::vector<double>* share : {&lines.dark, &lines.step[0], &lines.step[1]}) (*share)[c] /= std::max(lines.rows[c], 1);
  }
  for (std::size_t m = 0; m < lines.usual.size(); ++m) lines.usual[m] = std::clamp(quantile(m == 0 ? lines.dark : lines.step[m - 1], kUsual), kLeastUsual, 1.0 - kLeastUsual);
  return lines;
}

}  // namespace unseen::cuboids
