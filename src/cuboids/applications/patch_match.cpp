// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/applications/patch_match.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr int kRadius = PatchMatch::kRadius, kSide = 2 * kRadius + 1;
constexpr int kWrongSurface = kSide * kSide * 3 * 80 * 80;  // as if every channel were off by 80
constexpr std::size_t kEnoughSources = 50;                  // of a surface, or the guide says nothing about it
constexpr double kSharpness = 20.0;  // of the votes: a mean over unlike patches blurs, and the blur then matches blur
constexpr double kRimGain = 1.3;  // how much more a vote counts a pixel nearer to the rim (γ of Wexler et al.)

/// True where a window of the radius around the pixel holds a marked pixel.
std::vector<char> spread(const std::vector<char>& marked, int width, int height, int radius) {
  std::vector<char> wide(marked.size(), 0), out(marked.size(), 0);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (marked[y * width + x])
        for (int i = std::max(0, x - radius); i <= std::min(width - 1, x + radius); ++i) wide[y * width + i] = 1;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      if (wide[y * width + x])
        for (int j = std::max(0, y - radius); j <= std::min(height - 1, y + radius); ++j) out[j * width + x] = 1;
  return out;
}

}  // namespace

std::vector<int> distance_from_rim(const HoledPicture& picture) {
  const int w = picture.width, h = picture.height, far = w + h;
  std::vector<int> out(picture.hole.size(), 0);
  const auto relax = [&](int x, int y, int dx, int dy) {
    const int i = x + dx, j = y + dy;
    if (i >= 0 && j >= 0 && i < w && j < h) out[y * w + x] = std::min(out[y * w + x], out[j * w + i] + 1);
  };
  for (int i = 0; i < w * h; ++i) out[i] = picture.hole[i] ? far : 0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x)
      for (const auto& [dx, dy] : {std::pair{-1, 0}, {-1, -1}, {0, -1}, {1, -1}}) relax(x, y, dx, dy);
  for (int y = h - 1; y >= 0; --y)
    for (int x = w - 1; x >= 0; --x)
      for (const auto& [dx, dy] : {std::pair{1, 0}, {1, 1}, {0, 1}, {-1, 1}}) relax(x, y, dx, dy);
  return out;
}

PatchMatch::PatchMatch(const HoledPicture& picture)
    : width_(picture.width), height_(picture.height), stride_(picture.width + 2 * kRadius), hole_(picture.hole), guide_(picture.guide) {
  if (guide_.empty()) guide_.assign(hole_.size(), -1);
  padded_.assign(static_cast<std::size_t>(stride_) * (height_ + 2 * kRadius) * 4, 0);
  const std::vector<char> meets_hole = spread(hole_, width_, height_, kRadius);
  is_source_.assign(hole_.size(), 0);
  int surfaces = 0;
  for (const int surface : guide_) surfaces = std::max(surfaces, surface + 1);
  sources_of_surface_.resize(static_cast<std::size_t>(surfaces));
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      const int i = y * width_ + x;
      if (meets_hole[i]) {
        targets_.push_back(i);
      } else if (x >= kRadius && y >= kRadius && x < width_ - kRadius && y < height_ - kRadius) {
        is_source_[i] = 1;
        sources_.push_back(i);
        if (guide_[i] >= 0) sources_of_surface_[guide_[i]].push_back(i);
      }
    }
  for (const int t : targets_)
    if (guide_[t] >= 0 && sources_of_surface_[guide_[t]].size() < kEnoughSources) guide_[t] = -1;
  from_rim_ = distance_from_rim(picture);
  matches_.resize(hole_.size());
  set_colors(picture.pixels);
}

void PatchMatch::set_colors(const std::vector<Color>& pixels) {
  for (int y = -kRadius; y < height_ + kRadius; ++y)
    for (int x = -kRadius; x < width_ + kRadius; ++x) {
      const Color& c = pixels[std::clamp(y, 0, height_ - 1) * width_ + std::clamp(x, 0, width_ - 1)];
      std::int16_t* to = &padded_[(static_cast<std::size_t>(y + kRadius) * stride_ + x + kRadius) * 4];
      for (int k = 0; k < 3; ++k) to[k] = c[k];
    }
  if (!targets_.empty() && matches_[targets_.front()].source >= 0) measure();
}

int PatchMatch::cost(int target, int source, int limit) const {
  int sum = guide_[target] >= 0 && guide_[source] != guide_[target] ? kWrongSurface : 0;
  const int tx = target % width_ - kRadius, ty = target / width_ - kRadius;
  const int sx = source % width_ - kRadius, sy = source / width_ - kRadius;
  for (int j = 0; j < kSide && sum < limit; ++j) {
    const std::int16_t *a = row(tx, ty + j), *b = row(sx, sy + j);
    int line = 0;
    for (int k = 0; k < 4 * kSide; ++k) {
      const std::int16_t d = static_cast<std::int16_t>(a[k] - b[k]);
      line += d * d;
    }
    sum += line;
  }
  return sum;
}

void PatchMatch::measure() {
  for (const int t : targets_) matches_[t].cost = cost(t, matches_[t].source, std::numeric_limits<int>::max());
}

int PatchMatch::any_source(int target, Random& random) const {
  const std::vector<int>& from = guide_[target] >= 0 ? sources_of_surface_[guide_[target]] : sources_;
  return from[random.index(from.size())];
}

void PatchMatch::start(Random& random) {
  for (const int t : targets_) matches_[t].source = any_source(t, random);
  measure();
}

void PatchMatch::start(const PatchMatch& half, Random& random) {
  for (const int t : targets_) {
    const int x = t % width_, y = t / width_;
    const int hx = std::min(x / 2, half.width_ - 1), hy = std::min(y / 2, half.height_ - 1);
    const Match& coarse = half.matches_[hy * half.width_ + hx];
    int source = -1;
    if (coarse.source >= 0) {
      const int sx = 2 * (coarse.source % half.width_) + x % 2, sy = 2 * (coarse.source / half.width_) + y % 2;
      if (sx < width_ && sy < height_ && is_source_[sy * width_ + sx]) source = sy * width_ + sx;
    }
    matches_[t].source = source >= 0 ? source : any_source(t, random);
  }
  measure();
}

void PatchMatch::try_source(int target, int x, int y) {
  if (x < 0 || y < 0 || x >= width_ || y >= height_) return;
  const int source = y * width_ + x;
  Match& match = matches_[target];
  if (!is_source_[source] || source == match.source) return;
  const int found = cost(target, source, match.cost);
  if (found < match.cost) match = {source, found};
}

void PatchMatch::improve(Random& random) {
  const int step = forwards_ ? 1 : -1, count = static_cast<int>(targets_.size());
  for (int n = 0; n < count; ++n) {
    const int t = targets_[forwards_ ? n : count - 1 - n];
    const int x = t % width_, y = t / width_;
    for (const auto& [dx, dy] : {std::pair{step, 0}, {0, step}}) {
      const int i = x - dx, j = y - dy;
      if (i < 0 || j < 0 || i >= width_ || j >= height_) continue;
      const int neighbour = matches_[j * width_ + i].source;
      if (neighbour >= 0) try_source(t, neighbour % width_ + dx, neighbour / width_ + dy);
    }
    for (int reach = std::max(width_, height_); reach >= 1; reach /= 2) {
      const int middle = matches_[t].source, span = 2 * reach + 1;
      const int dx = static_cast<int>(random.index(span)) - reach, dy = static_cast<int>(random.index(span)) - reach;
      try_source(t, middle % width_ + dx, middle / width_ + dy);
    }
  }
  forwards_ = !forwards_;
}

std::vector<Color> PatchMatch::vote(const std::vector<Color>& pixels) const {
  std::vector<int> costs;
  for (const int t : targets_) costs.push_back(matches_[t].cost);
  const double scale = std::max(1.0, static_cast<double>(quantile(std::move(costs), 0.75)));

  std::vector<std::array<double, 4>> sums(hole_.size(), {0, 0, 0, 0});
  for (const int t : targets_) {
    const Match& match = matches_[t];
    const double weight = std::exp(-kSharpness * match.cost / (2.0 * scale)) * std::pow(kRimGain, -std::min(from_rim_[t], 60)) + 1e-12;
    const int tx = t % width_, ty = t / width_, sx = match.source % width_, sy = match.source / width_;
    for (int j = std::max(-kRadius, -ty); j <= std::min(kRadius, height_ - 1 - ty); ++j)
      for (int i = std::max(-kRadius, -tx); i <= std::min(kRadius, width_ - 1 - tx); ++i) {
        const int pixel = (ty + j) * width_ + tx + i;
        if (!hole_[pixel]) continue;
        const std::int16_t* from = row(sx + i, sy + j);
        for (int k = 0; k < 3; ++k) sums[pixel][k] += weight * from[k];
        sums[pixel][3] += weight;
      }
  }
  std::vector<Color> out = pixels;
  for (std::size_t p = 0; p < out.size(); ++p)
    if (hole_[p])
      for (int k = 0; k < 3; ++k) out[p][k] = static_cast<std::uint8_t>(std::lround(sums[p][k] / sums[p][3]));
  return out;
}

}  // namespace unseen::cuboids
