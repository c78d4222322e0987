// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/flight_cost.h"

#include <algorithm>
#include <cmath>

#include "collision/shot_problem.h"
#include "collision/solve/linear_flights.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

TrackPoint point_of(const Candidate& c, int body, double fps) { return {body, c.file_frame(), c.u / fps, c.pixel, c.diameter, c.region}; }

}  // namespace

double sighting_noise(const std::vector<std::vector<Candidate>>& bodies, double least) {
  constexpr int kFarthest = 6;         // frames that four in a row may take
  constexpr double kQuarter = 0.3186;  // σ that a quarter of normal noise is below
  constexpr double kMuchLess = 0.4;    // the rest then has sightings that are simply wrong, of which one in four is enough
  std::vector<double> off;
  for (const auto& seen : bodies)
    for (std::size_t i = 3; i < seen.size(); ++i) {
      if (seen[i].frame - seen[i - 3].frame > kFarthest) continue;
      const Vec2 d = off_any_flight({&seen[i - 3], &seen[i - 2], &seen[i - 1], &seen[i]});
      off.insert(off.end(), {std::abs(d.x()), std::abs(d.y())});
    }
  const double usual = 1.4826 * median(off), smooth = quantile(off, 0.25) / kQuarter;
  return std::max(least, smooth < kMuchLess * usual ? smooth : usual);
}

void add_flight(const std::vector<Candidate>& seen, std::size_t begin, std::size_t end, int body, double fps, Tracks& tracks) {
  const std::size_t first = tracks.points.size();
  for (std::size_t i = begin; i < end; ++i) tracks.points.push_back(point_of(seen[i], body, fps));
  tracks.spans.push_back({body, first, tracks.points.size()});
}

Flights::Flights(const Shot& shot, const ShotCamera& camera, double noise) : shot_(shot), camera_(camera), noise_(noise) {
  const std::optional<GivenDown> down = given_down(shot);
  given_ = down.has_value();
  shot_.down = down ? down->down : Vec3::UnitY();
  for (std::size_t o = 0; o < 2; ++o) solids_[o] = solid_of(shot.bodies[o], shot.name);
}

double Flights::cost_of_down() const { return given_ ? 0.0 : 0.5 * std::pow(line_angle(*shot_.down, Vec3::UnitY()) / kDownSigma, 2); }

std::optional<double> Flights::settle_down(const std::function<std::optional<double>()>& cost) {
  constexpr int kRounds = 12;
  const auto whole = [&]() -> std::optional<double> {
    const std::optional<double> seen = cost();
    return seen ? std::optional(*seen + cost_of_down()) : std::nullopt;
  };
  std::optional<double> least = whole();
  if (given_ || shot_.gravity == 0.0) return least;
  double step = 0.1;  // rad
  for (int round = 0; least && round < kRounds; ++round) {
    const Vec3 down = *shot_.down, e1 = any_orthogonal(down), e2 = down.cross(e1);
    Vec3 best = down;
    for (const Vec3& side : {e1, e2, Vec3(-e1), Vec3(-e2)}) {
      shot_.down = (down + step * side).normalized();
      const std::optional<double> next = whole();
      if (next && *next < *least) least = next, best = *shot_.down;
    }
    if (best == down) step *= 0.5;
    shot_.down = best;
  }
  return least;
}

std::optional<double> Flights::cost(const std::vector<std::vector<Candidate>>& bodies, std::size_t begin, std::size_t end, std::optional<double> u, double fps) const {
  if (!u && begin >= bodies[0].size()) return std::nullopt;
  Tracks tracks;
  tracks.noise = noise_;
  Tracks::Meeting meeting{u ? *u / fps : bodies[0][begin].u / fps, {}, {}};
  for (const auto& seen : bodies) {
    const int body = seen.front().body >= 0 ? seen.front().body : 0;
    const std::size_t last = std::min(end, seen.size());
    std::size_t split = last;
    if (u) split = static_cast<std::size_t>(std::lower_bound(seen.begin(), seen.end(), *u, [](const Candidate& c, double t) { return c.u < t; }) - seen.begin());
    const std::size_t fewest = bodies.size() == 2 ? kFewestSeenOfPair : kFewestSeen;
    if (split < begin + fewest || (u && last < split + fewest)) return std::nullopt;
    for (const auto& [from, to] : {std::pair{begin, split}, std::pair{split, last}}) {
      if (from == to) continue;
      (from == begin ? meeting.before : meeting.after).push_back(static_cast<int>(tracks.spans.size()));
      add_flight(seen, from, to, body, fps, tracks);
    }
  }
  const Problem problem = problem_of(shot_, Options{}, camera_, solids_, tracks, meeting);
  double sum = 0.0;
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

}  // namespace unseen::collision
