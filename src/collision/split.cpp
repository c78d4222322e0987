// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/split.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace unseen::collision {
namespace {

constexpr int kMostMoves = 3;
constexpr std::size_t kFewestLeft = 3;  // sightings of a flight
constexpr double kNear = 0.5;           // frames
constexpr double kExplainsBetter = 1.0; // −log likelihood

std::vector<TrackPoint> points_of(const Tracks& tracks, int span) {
  const auto& s = tracks.spans[static_cast<std::size_t>(span)];
  return {tracks.points.begin() + static_cast<std::ptrdiff_t>(s.begin), tracks.points.begin() + static_cast<std::ptrdiff_t>(s.end)};
}

/// The same with the meeting's sightings before `time` in the flights before it, and the others in those after; nothing if a flight is left with too few.
std::optional<Tracks> split_at(const Tracks& tracks, const Tracks::Meeting& meeting, double time) {
  std::vector<std::vector<TrackPoint>> flights;
  for (std::size_t s = 0; s < tracks.spans.size(); ++s) flights.push_back(points_of(tracks, static_cast<int>(s)));
  for (std::size_t k = 0; k < meeting.before.size(); ++k) {
    const auto b = static_cast<std::size_t>(meeting.before[k]);
    const auto of_body = std::find_if(meeting.after.begin(), meeting.after.end(), [&](int a) { return tracks.spans[static_cast<std::size_t>(a)].body == tracks.spans[b].body; });
    if (of_body == meeting.after.end()) return std::nullopt;
    auto &before = flights[b], &after = flights[static_cast<std::size_t>(*of_body)];
    std::vector<TrackPoint> all = before;
    all.insert(all.end(), after.begin(), after.end());
    const auto middle = std::stable_partition(all.begin(), all.end(), [&](const TrackPoint& p) { return p.time < time; });
    before.assign(all.begin(), middle);
    after.assign(middle, all.end());
    if (before.size() < kFewestLeft || after.size() < kFewestLeft) return std::nullopt;
  }
  Tracks result = tracks;
  result.points.clear();
  for (std::size_t s = 0; s < flights.size(); ++s) {
    result.spans[s].begin = result.points.size();
    result.points.insert(result.points.end(), flights[s].begin(), flights[s].end());
    result.spans[s].end = result.points.size();
  }
  return result;
}

/// Times of the last sighting before the meeting and of the first after it.
std::pair<double, double> around(const Tracks& tracks, const Tracks::Meeting& meeting) {
  double last = -std::numeric_limits<double>::infinity(), first = -last;
  for (const int span : meeting.before) last = std::max(last, points_of(tracks, span).back().time);
  for (const int span : meeting.after) first = std::min(first, points_of(tracks, span).front().time);
  return {last, first};
}

}  // namespace

void settle_split(const std::function<Solution(const Tracks&)>& solve, const Tracks::Meeting& meeting, double frame_time, Tracks& tracks, Solution& solution) {
  if (meeting.before.size() != meeting.after.size()) return;
  for (int move = 0; move < kMostMoves && solution.fit.usable; ++move) {
    const auto [last, first] = around(tracks, meeting);
    const double time = solution.fit.state.time, near = kNear * frame_time, between = 0.25 * frame_time;
    std::vector<double> splits;
    if (last > time - near) splits.push_back(last - between);
    if (first < time + near) splits.push_back(first + between);
    std::optional<std::pair<Tracks, Solution>> better;
    for (const double split : splits) {
      std::optional<Tracks> other = split_at(tracks, meeting, split);
      if (!other) continue;
      Solution solved = solve(*other);
      if (solved.fit.usable && solved.score < (better ? better->second.score : solution.score - kExplainsBetter)) better.emplace(std::move(*other), std::move(solved));
    }
    if (!better) return;
    tracks = std::move(better->first);
    solution = std::move(better->second);
  }
}

}  // namespace unseen::collision
