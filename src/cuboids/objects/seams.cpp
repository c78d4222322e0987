// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/seams.h"

#include <algorithm>
#include <array>
#include <map>

#include "cuboids/objects/seam_search.h"
#include "cuboids/objects/upright_box.h"
#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

using Pieces = std::vector<std::vector<int>>;

constexpr std::size_t kSamples = 800;
constexpr double kMostLeft = 0.25, kMoreLeft = 0.03;  // of the points, that boxes between the seams may leave unexplained, and more than other cuts do
constexpr double kEnd = 0.05;                         // quantile of heights, where a piece ends
constexpr double kUpon = 0.02;                        // m

std::vector<Sample> some_samples_of(const Observation& seen, std::span<const int> points, std::size_t step) {
  std::vector<Sample> samples;
  for (std::size_t k = 0; k < points.size(); k += step)
    if (const int i = points[k]; !seen.graph.normals[i].isZero()) samples.push_back({seen.points[i], seen.graph.normals[i], seen.graph.sigma[i]});
  return samples;
}

/// How much of the points boxes around pieces leave unexplained, 0 … 1.
double left_by(const Observation& seen, const Pieces& pieces) {
  double left = 0, samples = 0;
  std::size_t count = 0;
  for (const std::vector<int>& piece : pieces) count += piece.size();
  for (const std::vector<int>& piece : pieces) {
    const std::vector<Sample> some = some_samples_of(seen, piece, count / kSamples + 1);
    left += unexplained(some);
    samples += static_cast<double>(some.size());
  }
  return left / std::max(samples, 1.0);
}

/// Of each piece, whether it ends where another one begins above it.
std::vector<char> carriers(const Observation& seen, const Pieces& pieces) {
  std::vector<std::array<double, 2>> ends;
  for (const std::vector<int>& piece : pieces) {
    std::vector<double> heights;
    for (const int i : piece) heights.push_back(seen.points[i].z());
    ends.push_back({quantile(heights, kEnd), quantile(heights, 1.0 - kEnd)});
  }
  std::vector<char> carries;
  for (const auto& [low, high] : ends)
    carries.push_back(std::any_of(ends.begin(), ends.end(), [&, top = high](const auto& other) { return other[0] > top - kUpon && other[0] < top + 2.0 * kUpon; }));
  return carries;
}

struct CellOfPart {
  std::vector<int> points;
  bool carries = false;
};

/// The cells between seams across each of the three directions; one cell if any of them has less than `fewest` points.
std::vector<CellOfPart> cells_between(const PicturedPart& part, const std::array<Seams, 3>& seams, std::size_t fewest) {
  std::map<std::array<std::size_t, 3>, CellOfPart> cells;
  for (const int i : part.points) {
    const Vec3 p = part.directions(part.seen.points[i]);
    std::array<std::size_t, 3> place{};
    for (int k = 0; k < 3; ++k) place[k] = static_cast<std::size_t>(std::upper_bound(seams[k].at.begin(), seams[k].at.end(), p[k]) - seams[k].at.begin());
    CellOfPart& cell = cells[place];
    cell.points.push_back(i);
    cell.carries = part.carries || place[2] < seams[2].at.size();
  }
  std::vector<CellOfPart> out;
  for (auto& [place, cell] : cells) {
    if (cell.points.size() < fewest) return {};
    out.push_back(std::move(cell));
  }
  return out;
}

/// The pieces between the seams of a part: cut along all that show over the whole of it, or, where that leaves crumbs, across the direction in which they show
/// best; and again.
Pieces cut_at_seams(const PicturedPart& part, std::size_t fewest) {
  std::array<Seams, 3> seams;
  int best = 0;
  for (int k = 0; k < 3; ++k) {
    seams[k] = seams_across(part, k);
    if (seams[k].shown > seams[best].shown) best = k;
  }
  std::vector<CellOfPart> cells = cells_between(part, seams, fewest);
  if (cells.empty()) {
    std::array<Seams, 3> one;
    one[best] = seams[best];
    cells = cells_between(part, one, fewest);
  }
  if (cells.size() < 2) return {part.points};
  Pieces all;
  for (CellOfPart& cell : cells)
    for (std::vector<int>& smaller : cut_at_seams({part.picture, part.camera, part.seen, part.directions, std::move(cell.points), cell.carries}, fewest))
      all.push_back(std::move(smaller));
  return all;
}

}  // namespace

void find_seams(const RgbdFrame& frame, const Observation& seen, const std::vector<std::vector<int>>& parts, std::size_t fewest, Stacks& stacks, const Context& context) {
  if (frame.color.empty()) return;
  const GreyPicture picture(frame);
  int stack = *std::max_element(stacks.stack_of_piece.begin(), stacks.stack_of_piece.end()) + 1;
  const auto pieces_of = [&](const std::vector<int>& part, bool carries) -> Pieces {
    context.check();
    const std::vector<Sample> samples = some_samples_of(seen, part, part.size() / kSamples + 1);
    if (samples.empty()) return {part};
    return cut_at_seams({picture, frame.camera, seen, Directions{across_front(samples)}, part, carries}, fewest);
  };
  const auto add = [&](const std::vector<int>& piece, int of) {
    for (const int i : piece) stacks.piece_of_point[i] = static_cast<int>(stacks.stack_of_piece.size());
    stacks.stack_of_piece.push_back(of);
  };
  for (const std::vector<int>& part : parts) {
    std::map<int, std::vector<int>> by_piece;
    for (const int i : part) by_piece[stacks.piece_of_point[i]].push_back(i);
    Pieces before;
    for (auto& [piece, points] : by_piece) before.push_back(std::move(points));
    const Pieces whole = pieces_of(part, false);
    if (whole.size() > 1 && left_by(seen, whole) < std::min(kMostLeft, left_by(seen, before) + kMoreLeft)) {
      const Stacks within = find_stacks(seen, whole, context);  // what stands on what, between two seams
      for (const std::vector<int>& column : whole) {
        std::map<int, std::vector<int>> levels;
        for (const int i : column) levels[within.piece_of_point[i]].push_back(i);
        for (const auto& [level, points] : levels) add(points, stack);
      }
      ++stack;
      continue;
    }
    if (before.size() < 2) continue;
    const std::vector<char> carries = carriers(seen, before);
    for (std::size_t k = 0; k < before.size(); ++k) {
      const Pieces pieces = pieces_of(before[k], carries[k] != 0);
      const int of = stacks.stack_of_piece[stacks.piece_of_point[before[k].front()]];
      if (pieces.size() < 2 || left_by(seen, pieces) > kMostLeft) continue;
      for (const std::vector<int>& piece : pieces) add(piece, of >= 0 ? of : stack);
      if (of < 0) ++stack;
    }
  }
}

}  // namespace unseen::cuboids
