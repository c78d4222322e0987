// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/cut_apart.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

namespace unseen::cuboids {
namespace {

constexpr double kFewestPiecePoints = 80.0;
constexpr double kLeastSaving = 1.0 / 3.0;  // of the free space within the hull
constexpr double kPrice = 0.02;             // of a hull: free space that one more piece must save
constexpr int kFirstCuts = 16, kFinerCuts = 4;
constexpr std::size_t kTried = 4;  // of the best cuts of clumps, until one parts the points as well

/// Groups of connected members among 0 … count − 1 that lie on the same side (1 or 2) each; sides are spent.
template <typename Neighbours>
std::vector<std::vector<int>> connected(std::span<const int> members, std::vector<signed char>& side, const Neighbours& neighbours) {
  std::vector<std::vector<int>> groups;
  for (const int start : members) {
    if (side[start] == 0) continue;
    const signed char own = side[start];
    std::vector<int>& group = groups.emplace_back(1, start);
    side[start] = 0;
    for (std::size_t k = 0; k < group.size(); ++k)
      for (const int j : neighbours(group[k]))
        if (side[j] == own) side[j] = 0, group.push_back(j);
  }
  return groups;
}

/// Connected pieces on either side of a plane.
std::vector<Piece> cut_at(const Observation& seen, const Interior& interior, const std::vector<int>& points, const Plane& plane,
                          std::vector<signed char>& side) {
  for (const int i : points) side[i] = plane.signed_distance(seen.points[i]) < 0.0 ? 1 : 2;
  return pieces_of_sides(seen, interior, points, side);
}

/// Free space that a cut of clumps leaves within the pieces' hulls, and the price of these; infinite for what is no cut.
double left_by_cut(const Interior& interior, const Clumps& clumps, const Piece& whole, const Plane& plane) {
  std::vector<int> all(clumps.centers.size());
  std::iota(all.begin(), all.end(), 0);
  std::vector<signed char> side;
  for (const Vec3& center : clumps.centers) side.push_back(plane.signed_distance(center) < 0.0 ? 1 : 2);
  int pieces = 0, kept = 0;
  double left = 0;
  for (const std::vector<int>& group : connected(all, side, [&](int k) -> const std::vector<int>& { return clumps.neighbours[k]; })) {
    int count = 0;
    Hull hull;
    for (const int k : group) count += clumps.counts[k], hull.add(clumps.hulls[k]);
    if (count < fewest_points(whole.points.size())) continue;
    ++pieces;
    kept += count;
    left += hollow_of(interior, hull).free + kPrice * whole.hollow.within;
  }
  return pieces < 2 || kept < kKept * static_cast<double>(whole.points.size()) ? std::numeric_limits<double>::infinity() : left;
}

/// The cuts that leave the least free space within the pieces' hulls: across one of the axes, or along what is seen of a face; the best first.
std::vector<Plane> best_cuts(const Observation& seen, const Interior& interior, const std::vector<Plane>& planes, const Piece& whole) {
  const Clumps clumps = clumps_of(seen, interior, whole.points);
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const int i : whole.points) {
    const Vec3 p = interior.axes.transpose() * seen.points[i];
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  std::vector<std::pair<double, Plane>> cuts;
  const auto attempt = [&](const Plane& plane) {
    if (const double left = left_by_cut(interior, clumps, whole, plane); std::isfinite(left)) cuts.emplace_back(left, plane);
  };
  const auto sort = [&] { std::stable_sort(cuts.begin(), cuts.end(), [](const auto& a, const auto& b) { return a.first < b.first; }); };
  for (const Plane& plane : planes) attempt(plane);
  for (int axis = 0; axis < 3; ++axis)
    for (int k = 1; k < kFirstCuts; ++k) attempt({interior.axes.col(axis), low[axis] + (high[axis] - low[axis]) * k / kFirstCuts});
  if (cuts.empty()) return {};
  sort();
  const Plane middle = cuts.front().second;
  const double step = (interior.axes.transpose() * middle.normal).cwiseAbs().dot(high - low) / kFirstCuts / kFinerCuts;
  for (int k = -kFinerCuts + 1; k < kFinerCuts; ++k)
    if (k != 0) attempt({middle.normal, middle.offset + step * k});
  sort();
  std::vector<Plane> best;
  for (std::size_t k = 0; k < std::min(cuts.size(), kTried); ++k) best.push_back(cuts[k].second);
  return best;
}

double free_of(const std::vector<Piece>& pieces) {
  return std::accumulate(pieces.begin(), pieces.end(), 0.0, [](double sum, const Piece& piece) { return sum + piece.hollow.free; });
}

/// Pieces that one hull may hold as well are one again.
void join_pieces(const Observation& seen, const Interior& interior, std::vector<Piece>& pieces) {
  std::vector<int> owner(seen.points.size(), -1);
  for (bool again = true; again;) {
    again = false;
    std::fill(owner.begin(), owner.end(), -1);
    for (std::size_t k = 0; k < pieces.size(); ++k)
      for (const int i : pieces[k].points) owner[i] = static_cast<int>(k);
    std::set<std::pair<int, int>> neighbours;
    for (std::size_t k = 0; k < pieces.size(); ++k)
      for (const int i : pieces[k].points)
        for (const int j : seen.graph.neighbours(i))
          if (owner[j] > static_cast<int>(k)) neighbours.insert({static_cast<int>(k), owner[j]});
    for (const auto& [a, b] : neighbours) {
      std::vector<int> points = pieces[a].points;
      points.insert(points.end(), pieces[b].points.begin(), pieces[b].points.end());
      std::sort(points.begin(), points.end());
      Piece both = piece_of(seen, interior, std::move(points));
      if (both.hollow.free > pieces[a].hollow.free + pieces[b].hollow.free + kPrice * both.hollow.within) continue;
      pieces[a] = std::move(both);
      pieces.erase(pieces.begin() + b);
      again = true;
      break;
    }
  }
}

}  // namespace

double fewest_points(std::size_t all) { return std::max(kFewestPiecePoints, kSmallestPiece * static_cast<double>(all)); }

std::vector<Piece> pieces_of_sides(const Observation& seen, const Interior& interior, const std::vector<int>& points, std::vector<signed char>& side) {
  std::vector<Piece> pieces;
  for (std::vector<int>& group : connected(points, side, [&](int i) { return seen.graph.neighbours(i); })) {
    if (static_cast<double>(group.size()) < fewest_points(points.size())) continue;
    std::sort(group.begin(), group.end());
    pieces.push_back(piece_of(seen, interior, std::move(group)));
  }
  return pieces;
}

bool saves(const Piece& whole, const std::vector<Piece>& cut) { return cut.size() > 1 && free_of(cut) <= (1.0 - kLeastSaving) * whole.hollow.free; }

std::vector<Piece> cut_apart(const Observation& seen, const Interior& interior, const std::vector<Plane>& planes, const Piece& whole, double hollow,
                             Context& context) {
  std::vector<signed char> side(seen.points.size(), 0);
  std::vector<Piece> open{whole}, done;
  while (!open.empty()) {
    context.check();
    Piece piece = std::move(open.back());
    open.pop_back();
    const bool hollow_enough = piece.hollow.share() > hollow;
    std::vector<Piece> parts;
    for (const Plane& plane : hollow_enough ? best_cuts(seen, interior, planes, piece) : std::vector<Plane>()) {
      std::vector<Piece> cut = cut_at(seen, interior, piece.points, plane, side);
      if (!saves(piece, cut)) continue;
      parts = std::move(cut);
      break;
    }
    if (parts.empty()) done.push_back(std::move(piece));
    else open.insert(open.end(), std::make_move_iterator(parts.begin()), std::make_move_iterator(parts.end()));
  }
  join_pieces(seen, interior, done);
  return done;
}

}  // namespace unseen::cuboids
