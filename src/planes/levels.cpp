// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/levels.h"

#include <algorithm>

namespace unseen::planes {
namespace {

constexpr std::size_t kMostLookedAt = 100'000;  // points
constexpr double kApart = 0.02, kNarrow = 0.5;  // of the least step: what lies nearer shares a value; how wide such a value may be
constexpr double kPeak = 4.0;                   // times as many points as on other values nearby are a level …
constexpr double kOnLevels = 0.4;               // … if levels hold this share of the points; some sensors fill in what lies between,
constexpr std::size_t kFewestLevels = 10;       // and there are so many: fewer are floors and walls,
constexpr double kFewestOnLevel = 10;           // with so many points each;
constexpr double kMostOnLevel = 0.05;           // one that holds more than this share of the points is a floor and counts no more

/// Points that share a value.
struct Value {
  double low, high;
  double count = 0;
};

std::vector<Value> values_of(const std::vector<double>& sorted, double apart) {
  std::vector<Value> values;
  for (const double x : sorted) {
    if (values.empty() || x - values.back().high > apart) values.push_back({x, x});
    values.back().high = x;
    ++values.back().count;
  }
  return values;
}

}  // namespace

double Levels::step_at(const Vec3& p) const {
  const auto above = std::lower_bound(at.begin(), at.end(), axis.dot(p));
  const auto i = std::clamp<std::ptrdiff_t>(above - at.begin(), 1, static_cast<std::ptrdiff_t>(at.size()) - 1);
  return at[static_cast<std::size_t>(i)] - at[static_cast<std::size_t>(i - 1)];
}

std::optional<Levels> find_levels(const std::vector<Vec3>& points, const Vec3& axis, double least) {
  const std::size_t every = points.size() / kMostLookedAt + 1;
  std::vector<double> along;
  for (std::size_t i = 0; i < points.size(); i += every) along.push_back(axis.dot(points[i]));
  std::sort(along.begin(), along.end());
  const std::vector<Value> values = values_of(along, kApart * least);
  Levels levels{axis, {}};
  const double most = kMostOnLevel * static_cast<double>(along.size());
  double on_levels = 0, beside = 0;
  double nearby = 0;  // points on values that are no more than the least step away
  std::size_t first = 0, end = 0;
  for (const Value& v : values) {
    while (end < values.size() && values[end].low - v.high <= least) nearby += values[end++].count;
    while (v.low - values[first].high > least) nearby -= values[first++].count;
    const double others = static_cast<double>(end - first) - 1;
    if (v.count < kFewestOnLevel || v.high - v.low > kNarrow * least || v.count * others < kPeak * (nearby - v.count)) {
      beside += v.count;
      continue;
    }
    levels.at.push_back(0.5 * (v.low + v.high));
    on_levels += std::min(v.count, most);
  }
  if (levels.at.size() < kFewestLevels || on_levels < kOnLevels * (on_levels + beside)) return std::nullopt;
  return levels;
}

}  // namespace unseen::planes
