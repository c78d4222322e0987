// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/matching/evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "interactions/database/footprint.h"

namespace unseen::interactions {
namespace {

constexpr int kSuper = 3;
constexpr double kCell = 0.1, kMargin = 2.5;  ///< m; farther from everybody's way nothing is looked at
constexpr double kSteps = 0.15;               ///< m that a walker takes to either side
constexpr int kMostCells = 400;               ///< a side
constexpr double kSquare = 0.8;               ///< sides in this ratio do not tell a front

EvidenceMap empty_map(std::span<const Vec2> places) {
  Vec2 low = Vec2::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec2& p : places) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  EvidenceMap map;
  map.origin = low - Vec2::Constant(kMargin);
  const Vec2 extent = high - low + Vec2::Constant(2 * kMargin);
  map.cell = std::max(kCell, extent.maxCoeff() / kMostCells);
  map.columns = std::max(1, static_cast<int>(std::ceil(extent.x() / map.cell)));
  map.rows = std::max(1, static_cast<int>(std::ceil(extent.y() / map.cell)));
  map.probability.assign(static_cast<std::size_t>(kSuper) * EvidenceMap::kTurns * static_cast<std::size_t>(map.rows * map.columns), 0.0f);
  return map;
}

Vec2 center(const EvidenceMap& map, int row, int column) { return map.origin + map.cell * Vec2(column + 0.5, row + 0.5); }

int turn_of(const Vec2& front) {
  const double turns = std::atan2(-front.x(), front.y()) / (2 * kPi) * EvidenceMap::kTurns;
  return (static_cast<int>(std::lround(turns)) + EvidenceMap::kTurns) % EvidenceMap::kTurns;
}

std::vector<int> turns_of(const Object& object) {
  const Part* largest = nullptr;
  for (const Part& part : object.parts) {
    const Vec2 away = (object.center() - part.box.center).head<2>();
    if (part.name.substr(0, part.name.find('-')) == "back" && away.norm() > 0.05) return {turn_of(away)};
    if (!largest || part.box.volume() > largest->box.volume()) largest = &part;
  }
  const Vec3& half = largest->box.half_size;
  const bool wide = half[0] >= half[1];
  const int turn = turn_of(largest->box.axes.col(wide ? 1 : 0).head<2>()), half_turn = EvidenceMap::kTurns / 2, quarter = half_turn / 2;
  std::vector<int> turns = {turn, (turn + half_turn) % EvidenceMap::kTurns};
  if (half.head<2>().minCoeff() < kSquare * half.head<2>().maxCoeff()) return turns;
  for (const int more : {quarter, half_turn + quarter}) turns.push_back((turn + more) % EvidenceMap::kTurns);
  return turns;
}

bool contains(const Polygon& polygon, const Vec2& p) { return distance(p, p, polygon) == 0; }

/// The cells of the ground whose centres a footprint covers.
std::vector<std::size_t> cells_of(const EvidenceMap& map, const std::vector<Polygon>& pieces) {
  std::vector<std::size_t> cells;
  for (const Polygon& piece : pieces) {
    Vec2 low = piece.front(), high = low;
    for (const Vec2& p : piece) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    const Vec2 from = ((low - map.origin) / map.cell).array().floor().max(0.0), to = (high - map.origin) / map.cell;
    for (int row = static_cast<int>(std::min<double>(from.y(), map.rows)); row < map.rows && row <= to.y(); ++row)
      for (int column = static_cast<int>(std::min<double>(from.x(), map.columns)); column < map.columns && column <= to.x(); ++column)
        if (contains(piece, center(map, row, column))) cells.push_back(static_cast<std::size_t>(row * map.columns + column));
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  return cells;
}

/// The weight of a moment's votes at each place of the map that any of them covers.
std::map<std::size_t, double> weights(const EvidenceMap& map, const std::vector<const Evidence*>& votes) {
  const auto ground = static_cast<std::size_t>(map.rows * map.columns);
  std::map<std::size_t, double> weight;
  for (const Evidence* vote : votes) {
    std::vector<std::size_t> places;
    for (const Object& object : vote->objects) {
      if (object.superclass() == Superclass::other || object.parts.empty()) continue;
      const std::vector<std::size_t> cells = cells_of(map, footprint(object));
      for (const int turn : turns_of(object))
        for (const std::size_t cell : cells)
          places.push_back((static_cast<std::size_t>(object.superclass()) * EvidenceMap::kTurns + static_cast<std::size_t>(turn)) * ground + cell);
    }
    std::sort(places.begin(), places.end());  // one vote counts once, though two of its objects be there
    places.erase(std::unique(places.begin(), places.end()), places.end());
    for (const std::size_t place : places) weight[place] += vote->weight;
  }
  return weight;
}

}  // namespace

EvidenceMap gather(std::span<const Evidence> votes, std::span<const Vec2> walked, int at_least) {
  std::map<int, std::vector<const Evidence*>> moments;
  std::vector<Vec2> places(walked.begin(), walked.end());
  for (const Evidence& vote : votes) {
    moments[vote.moment].push_back(&vote);
    if (walked.empty())
      for (const Object& object : vote.objects) places.emplace_back(object.center().head<2>());
  }
  if (places.empty()) return {};
  EvidenceMap map = empty_map(places);
  std::map<std::size_t, std::vector<double>> shares;
  for (const auto& [moment, cast] : moments) {
    double total = 0;
    for (const Evidence* vote : cast) total += vote->weight;
    if (!(total > 0)) continue;
    for (const auto& [place, weight] : weights(map, cast)) shares[place].push_back(weight / total);
  }
  const auto ground = static_cast<std::size_t>(map.rows * map.columns);
  std::vector<double> free(ground, 1.0);
  for (std::size_t cell = 0; cell < ground; ++cell) {
    const Vec2 at = center(map, static_cast<int>(cell) / map.columns, static_cast<int>(cell) % map.columns);
    for (const Vec2& p : walked)
      if ((p - at).squaredNorm() <= kSteps * kSteps) free[cell] *= std::exp(-1.0);
  }
  const auto most = static_cast<std::size_t>(std::max(at_least, 1));
  for (auto& [place, share] : shares) {
    std::sort(share.begin(), share.end(), std::greater<>());
    double sum = 0;
    for (std::size_t i = 0; i < std::min(most, share.size()); ++i) sum += share[i];
    map.probability[place] = static_cast<float>(std::clamp(sum / static_cast<double>(most), 0.0, 1.0) * free[place % ground]);
  }
  return map;
}

}  // namespace unseen::interactions
