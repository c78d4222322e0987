// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/flight_search.h"

#include <algorithm>
#include <cmath>

#include "collision/linear_flights.h"
#include "collision/median.h"
#include "collision/shot_problem.h"

namespace unseen::collision {
namespace {

constexpr std::size_t kFewest = 4;       // sightings of a flight
constexpr std::size_t kFewestOfPair = 3;  // the same where both bodies change at one time
constexpr double kExplained = 2.0;   // ½ χ² a sighting, 1 in the mean

/// A body's sightings in order of time; empty if a frame has two.
std::vector<Candidate> sightings_of(const Candidates& candidates, int body) {
  std::vector<Candidate> all;
  for (const auto& frame : candidates)
    for (const Candidate& c : frame) {
      if (c.body >= 0 && c.body != body) continue;
      if (!all.empty() && all.back().frame == c.frame) return {};
      all.push_back(c);
    }
  return all;
}

/// Noise of the centres from their third differences, which no flight has.
double noise_of(const std::vector<std::vector<Candidate>>& bodies, double least) {
  std::vector<double> off;
  for (const auto& seen : bodies)
    for (std::size_t i = 3; i < seen.size(); ++i) {
      if (seen[i].frame - seen[i - 3].frame != 3) continue;
      const Vec2 d = seen[i].pixel - 3.0 * seen[i - 1].pixel + 3.0 * seen[i - 2].pixel - seen[i - 3].pixel;
      off.insert(off.end(), {std::abs(d.x()), std::abs(d.y())});
    }
  constexpr double kOfThirdDifferences = 4.4721;  // √20
  return off.empty() ? least : std::max(least, 1.4826 * median(off) / kOfThirdDifferences);
}

TrackPoint point_of(const Candidate& c, int body, double fps) { return {body, c.frame, c.u / fps, c.pixel, c.diameter, c.region}; }

/// Flights in space through some of the sightings.
class Flights {
 public:
  Flights(const Shot& shot, const ShotCamera& camera, double noise) : shot_(shot), camera_(camera), given_(shot.down) {
    if (!given_) shot_.down = Vec3::UnitY();
    tracks_.noise = noise;
    for (std::size_t o = 0; o < 2; ++o) solids_[o] = solid_of(shot.bodies[o], shot.name);
  }

  /// Takes down as flights that change at `u` explain all sightings best, if it is not known; without `u` nothing changes.
  std::optional<double> settle_down(const std::vector<std::vector<Candidate>>& bodies, std::size_t count, std::optional<double> u, double fps) {
    constexpr int kRounds = 12;
    std::optional<double> least = cost(bodies, 0, count, u, fps);
    if (given_ || shot_.gravity == 0.0) return least;
    double step = 0.1;  // rad
    for (int round = 0; least && round < kRounds; ++round) {
      const Vec3 down = *shot_.down, e1 = any_orthogonal(down), e2 = down.cross(e1);
      Vec3 best = down;
      for (const Vec3& side : {e1, e2, Vec3(-e1), Vec3(-e2)}) {
        shot_.down = (down + step * side).normalized();
        const std::optional<double> next = cost(bodies, 0, count, u, fps);
        if (next && *next < *least) least = next, best = *shot_.down;
      }
      if (best == down) step *= 0.5;
      shot_.down = best;
    }
    return least;
  }

  /// ½ χ² (robust) of sightings `[begin, end)` of each body about flights that change at `u`; without `u` nothing changes.
  std::optional<double> cost(const std::vector<std::vector<Candidate>>& bodies, std::size_t begin, std::size_t end, std::optional<double> u, double fps) {
    Tracks tracks;
    tracks.noise = tracks_.noise;
    Tracks::Meeting meeting{u ? *u / fps : bodies[0][begin].u / fps, {}, {}};
    for (const auto& seen : bodies) {
      const int body = seen.front().body >= 0 ? seen.front().body : 0;
      const std::size_t last = std::min(end, seen.size());
      std::size_t split = last;
      if (u) split = static_cast<std::size_t>(std::lower_bound(seen.begin(), seen.end(), *u, [](const Candidate& c, double t) { return c.u < t; }) - seen.begin());
      const std::size_t fewest = bodies.size() == 2 ? kFewestOfPair : kFewest;
      if (split < begin + fewest || (u && last < split + fewest)) return std::nullopt;
      for (const auto& [from, to] : {std::pair{begin, split}, std::pair{split, last}}) {
        if (from == to) continue;
        const std::size_t first = tracks.points.size();
        for (std::size_t i = from; i < to; ++i) tracks.points.push_back(point_of(seen[i], body, fps));
        (from == begin ? meeting.before : meeting.after).push_back(static_cast<int>(tracks.spans.size()));
        tracks.spans.push_back({body, first, tracks.points.size()});
      }
    }
    const Problem problem = problem_of(shot_, Options{}, camera_, solids_, tracks, meeting);
    double sum = given_ ? 0.0 : 0.5 * std::pow(line_angle(*shot_.down, Vec3::UnitY()) / kDownSigma, 2);
    std::vector<Vec3> impulses;
    for (const auto& seen : bodies) {
      const int body = seen.front().body >= 0 ? seen.front().body : 0;
      const std::optional<LinearFlight> flight = linear_flight(problem, body, meeting.time);
      if (!flight) return std::nullopt;
      sum += misfit(problem, *flight, body, meeting.time);
      impulses.push_back(flight->v_after - flight->v_before);
    }
    constexpr double kOpposed = 5.0;  // momentum goes from one body to the other
    if (u && bodies.size() == 2) sum += kOpposed * (1.0 + impulses[0].normalized().dot(impulses[1].normalized()));
    return sum;
  }

 private:
  Shot shot_;
  const ShotCamera& camera_;
  bool given_;  ///< down, by the shot
  std::array<Solid, 2> solids_;
  Tracks tracks_;
};

/// An impact, by its frame time, and what flights that change there cost.
struct Turn {
  double u, cost;
};

/// The impact between flights that explains all sightings best, at any frame time: first in steps of a small part of the shot, then in finer ones.
std::optional<Turn> best_turn(Flights& flights, const std::vector<std::vector<Candidate>>& bodies, std::size_t count, double fps, Context& context) {
  constexpr double kFinest = 0.25;   // frames
  constexpr double kCoarsest = 150;  // steps in the shot
  constexpr double kFiner = 4;
  std::optional<Turn> best;
  double from = bodies[0].front().u, to = bodies[0].back().u, step = std::max(kFinest, (to - from) / kCoarsest);
  while (true) {
    for (double u = from; u < to; u += step) {
      context.check();
      const std::optional<double> cost = flights.cost(bodies, 0, count, u, fps);
      if (cost && (!best || *cost < best->cost)) best = Turn{u, *cost};
    }
    if (!best || step == kFinest) return best;
    from = std::max(from, best->u - step);
    to = std::min(to, best->u + step);
    step = std::max(kFinest, step / kFiner);
  }
}

/// The same, and down with it.
std::optional<Turn> find_turn(Flights flights, const std::vector<std::vector<Candidate>>& bodies, std::size_t count, double fps, Context& context) {
  constexpr int kRounds = 4;
  constexpr double kLess = 0.5;  // ½ χ² that a round must gain
  std::optional<Turn> best;
  for (int round = 0; round < kRounds; ++round) {
    std::optional<Turn> now = best_turn(flights, bodies, count, fps, context);
    if (!now) break;
    if (const auto settled = flights.settle_down(bodies, count, now->u, fps)) now->cost = *settled;
    if (best && now->cost > best->cost - kLess) break;
    best = now;
  }
  return best;
}

void add_span(const std::vector<Candidate>& seen, std::size_t begin, std::size_t end, int body, double fps, Tracks& tracks) {
  const std::size_t first = tracks.points.size();
  for (std::size_t i = begin; i < end; ++i) tracks.points.push_back(point_of(seen[i], body, fps));
  tracks.spans.push_back({body, first, tracks.points.size()});
}

}  // namespace

std::optional<Tracks> search_pair(const Shot& shot, const ShotCamera& camera, const Candidates& candidates, double fps, double least_noise, Context& context) {
  constexpr double kSignificant = 12.0;  // ½ χ² that an impact must explain
  for (const auto& frame : candidates)
    if (std::any_of(frame.begin(), frame.end(), [](const Candidate& c) { return c.body < 0; })) return std::nullopt;
  const std::vector<std::vector<Candidate>> bodies = {sightings_of(candidates, 0), sightings_of(candidates, 1)};
  if (bodies[0].size() < kFewestOfPair + kFewest || bodies[1].size() < kFewestOfPair + kFewest) return std::nullopt;
  const std::size_t count = std::max(bodies[0].size(), bodies[1].size());
  const Flights level(shot, camera, noise_of(bodies, least_noise));
  Flights still = level;  // a wrong down bends flights, which an impact would explain
  const std::optional<double> none = still.settle_down(bodies, count, std::nullopt, fps);
  std::optional<Turn> turn = find_turn(level, bodies, count, fps, context);
  if (const auto other = find_turn(still, bodies, count, fps, context); other && (!turn || other->cost < turn->cost)) turn = other;
  if (!turn || turn->cost > kExplained * static_cast<double>(bodies[0].size() + bodies[1].size()) || (none && *none < turn->cost + kSignificant)) return std::nullopt;
  Tracks tracks;
  tracks.noise = noise_of(bodies, least_noise);
  Tracks::Meeting meeting{turn->u / fps, {}, {}};
  for (int body = 0; body < 2; ++body) {
    const auto& seen = bodies[static_cast<std::size_t>(body)];
    const auto split = static_cast<std::size_t>(std::lower_bound(seen.begin(), seen.end(), turn->u, [](const Candidate& c, double t) { return c.u < t; }) - seen.begin());
    meeting.before.push_back(static_cast<int>(tracks.spans.size()));
    add_span(seen, 0, split, body, fps, tracks);
    meeting.after.push_back(static_cast<int>(tracks.spans.size()));
    add_span(seen, split, seen.size(), body, fps, tracks);
  }
  tracks.meetings = {meeting};
  tracks.collisions_seen = 1;
  return tracks;
}

std::optional<Tracks> search_chain(const Shot& shot, const ShotCamera& camera, const Candidates& candidates, int body, double fps, double least_noise,
                                   Context& context) {
  constexpr std::size_t kMost = 60;       // sightings: each pair of them is tried as the ends of a flight
  constexpr double kAnotherFlight = 8.0;  // ½ χ² that it must explain
  std::vector<Candidate> seen = sightings_of(candidates, body);
  if (seen.size() < 2 * kFewest || seen.size() > kMost) return std::nullopt;
  for (Candidate& c : seen) c.body = body;
  const double noise = noise_of({seen}, least_noise);
  Flights flights(shot, camera, noise);
  // least cost of the first j sightings, and where its last flight begins; a sighting may belong to none
  std::vector<double> least(seen.size() + 1, 0.0);
  std::vector<std::size_t> from(seen.size() + 1, 0);
  for (std::size_t j = 1; j <= seen.size(); ++j) {
    context.check();
    least[j] = least[j - 1] + kMostMisfit;
    from[j] = j - 1;
    for (std::size_t i = 0; i + kFewest <= j; ++i) {
      const std::optional<double> cost = flights.cost({seen}, i, j, std::nullopt, fps);
      if (!cost || least[i] + *cost + kAnotherFlight >= least[j]) continue;
      least[j] = least[i] + *cost + kAnotherFlight;
      from[j] = i;
    }
  }
  std::vector<std::pair<std::size_t, std::size_t>> spans;
  for (std::size_t j = seen.size(); j > 0; j = from[j])
    if (from[j] + kFewest <= j) spans.insert(spans.begin(), {from[j], j});
  Tracks tracks;
  tracks.noise = noise;
  for (const auto& [begin, end] : spans) add_span(seen, begin, end, body, fps, tracks);
  for (std::size_t k = 0; k + 1 < spans.size(); ++k) {
    constexpr double kLongestGap = 4.0;  // frames
    const double end = seen[spans[k].second - 1].u, begin = seen[spans[k + 1].first].u;
    if (begin - end > kLongestGap) continue;
    tracks.meetings.push_back({0.5 * (begin + end) / fps, {static_cast<int>(k)}, {static_cast<int>(k) + 1}});
  }
  if (tracks.meetings.empty()) return std::nullopt;
  tracks.collisions_seen = static_cast<int>(tracks.meetings.size());
  return tracks;
}

}  // namespace unseen::collision
