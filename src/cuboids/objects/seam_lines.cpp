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
constexpr double kShortest = 0.2;     // pixels a step, of a direction that runs away from the camera

/// A point of a side: where it is, and what the picture shows there across a line.
struct Look {
  double across = 0, along = 0;  ///< m
  double dark = 0, step = 0;     ///< of 255: than what is on either side, and between both sides
};

/// m: where most of some values lie that scatter by `sigma`, then where most of the others do, until few are left.
std::vector<double> levels_of_most(std::vector<double> values, double sigma) {
  std::sort(values.begin(), values.end());
  const auto fewest = static_cast<std::size_t>(kFewLeft * static_cast<double>(values.size()));
  std::vector<double> levels;
  while (values.size() > fewest) {
    std::size_t best = 0, from = 0, low = 0;
    for (std::size_t high = 0; high < values.size(); ++high) {
      while (values[high] - values[low] > 2.0 * kOnLevel * sigma) ++low;
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
  const RigidTransform T_camera_world = seen.T_world_camera.inverse();
  const std::array<Vec3, 3> axes{Vec3(directions.along.x(), directions.along.y(), 0), Vec3(-directions.along.y(), directions.along.x(), 0), Vec3::UnitZ()};
  // Places are those where the rays meet the planes of the side: the noise of the depth would bend the lines.
  const int out = 3 - across - along;
  const Vec3& eye = seen.T_world_camera.translation;
  const double eye_out = directions(eye)[out];
  std::vector<double> outs;
  double spread = 0;
  for (const int i : points) {
    outs.push_back(directions(seen.points[i])[out]);
    spread += seen.graph.sigma[i] / static_cast<double>(points.size());
  }
  const std::vector<double> levels = levels_of_most(outs, spread);
  std::vector<Look> looks;
  std::vector<double> width, height, noise;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const int i = points[n];
    const auto level = std::find_if(levels.begin(), levels.end(), [&](double l) { return std::abs(outs[n] - l) < kOnLevel * spread; });
    if (level == levels.end() || std::abs(outs[n] - eye_out) < kOnLevel * spread) continue;
    const Vec3 p = eye + (*level - eye_out) / (outs[n] - eye_out) * (seen.points[i] - eye);
    const double spacing = seen.graph.spacing[i];
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
    looks.push_back({q[across], q[along], dark, step});
  }
  SeamLines lines;
  if (looks.empty()) return lines;
  const double sigma = median(std::move(noise)) / (0.6745 * std::sqrt(6.0)), contrast = std::max(kLeastContrast, kContrastNoise * sigma);
  const auto [left, right] = std::minmax_element(looks.begin(), looks.end(), [](const Look& a, const Look& b) { return a.across < b.across; });
  const auto [first, last] = std::minmax_element(looks.begin(), looks.end(), [](const Look& a, const Look& b) { return a.along < b.along; });
  const double low = left->across, bottom = first->along;
  lines.low = low;
  lines.width = std::max(median(std::move(width)), (right->across - low) / kMostPlaces);
  const double row_height = std::max(kRowPixels * median(std::move(height)), (last->along - bottom) / kMostPlaces);
  const int columns = static_cast<int>((right->across - low) / lines.width) + 1, rows = static_cast<int>((last->along - bottom) / row_height) + 1;
  std::vector<Cell> cells(static_cast<std::size_t>(columns) * rows);
  for (const Look& look : looks) {
    Cell& cell = cells[static_cast<std::size_t>((look.along - bottom) / row_height) * columns + static_cast<std::size_t>((look.across - low) / lines.width)];
    cell.dark += look.dark;
    cell.step += look.step;
    ++cell.count;
  }
  lines.rows.assign(columns, 0);
  lines.dark.assign(columns, 0.0);
  lines.step = {lines.dark, lines.dark};
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r < rows; ++r) {
      const Cell* row = &cells[static_cast<std::size_t>(r) * columns];
      const auto seen_in = [&](int from, int to) {
        for (int k = std::max(from, 0); k <= std::min(to, columns - 1); ++k)
          if (row[k].count > 0) return true;
        return false;
      };
      if (!seen_in(c - kBesideLine, c - kOnLine - 1) || !seen_in(c + kOnLine + 1, c + kBesideLine) || !seen_in(c - kOnLine, c + kOnLine)) continue;
      double dark = 0, down = 0, up = 0;
      for (int k = std::max(c - kOnLine, 0); k <= std::min(c + kOnLine, columns - 1); ++k)
        if (const Cell& cell = row[k]; cell.count > 0) dark = std::max(dark, cell.dark / cell.count), up = std::max(up, cell.step / cell.count), down = std::max(down, -cell.step / cell.count);
      ++lines.rows[c];
      lines.dark[c] += dark > contrast;
      lines.step[0][c] += down > contrast;
      lines.step[1][c] += up > contrast;
    }
    for (std::vector<double>* share : {&lines.dark, &lines.step[0], &lines.step[1]}) (*share)[c] /= std::max(lines.rows[c], 1);
  }
  for (std::size_t m = 0; m < lines.usual.size(); ++m) lines.usual[m] = std::max(quantile(m == 0 ? lines.dark : lines.step[m - 1], kUsual), kLeastUsual);
  return lines;
}

}  // namespace unseen::cuboids
