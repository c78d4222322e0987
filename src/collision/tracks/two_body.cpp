// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/two_body.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "collision/tracks/arcs.h"
#include "collision/tracks/heavy_body.h"
#include "collision/tracks/meetings.h"
#include "collision/tracks/pair_links.h"

namespace unseen::collision {
namespace {

constexpr double kUnlikePieces = 15.9;       // σ² between the looks of two pieces of a flight
constexpr double kSettled = 2.5;      // frame times that the impact may move when its flights are settled
constexpr std::size_t kMostArcs = 60;
constexpr double kGate = 3.5;          // σ, of points that are assigned to a flight
constexpr double kOverlap = 3.0;       // frame times that two pieces of one flight may share
constexpr double kAstray = 0.5;        // diameters that the second may begin off where the first leads
constexpr double kOneFlight = 1.2;     // times the noise, about one parabola through both
constexpr double kOddSizeOfFlight = 0.03;      // share
constexpr double kNearImpact = 0.75;   // frame times around the impact whose points are left out

/// The arc with those points of another that are outside its time.
Arc with(const Arc& arc, const Arc& other) {
  std::vector<Candidate> both = arc.points;
  for (const Candidate& c : other.points)
    if (c.u < arc.begin() || c.u > arc.end()) both.push_back(c);
  std::stable_sort(both.begin(), both.end(), [](const Candidate& a, const Candidate& b) { return a.u < b.u; });
  return arc_of(std::move(both));
}

/// How far, in σ, the nearer end of `other` is from where the arc leads; more than kGate if it cannot be the same flight.
double continues(const Arc& arc, const Arc& other, double noise) {
  constexpr double kNo = 1e9;
  const bool later = other.begin() > arc.begin();
  const double overlap = later ? arc.end() - other.begin() : other.end() - arc.begin();
  if (overlap > kOverlap || unlikeness(looks_of(arc), looks_of(other)) > kUnlikePieces) return kNo;
  const Candidate& end = later ? other.points.front() : other.points.back();
  const double away = (end.pixel - arc.curve.at(end.u)).norm(), diameter = typical_diameter(arc.points);
  if (diameter > 0.0 && away > kAstray * diameter) return kNo;
  if (with(arc, other).noise > kOneFlight * noise) return kNo;
  return away / (noise * std::sqrt(2.0 * (1.0 + arc.curve.variance_at(end.u))));
}

/// The four arcs, each with others that continue it on its side of the impact: silhouettes that merged part a flight. Marks all that
/// are `used`.
std::vector<Arc> continued(const std::vector<Arc>& arcs, const Collision& collision, double noise, std::vector<char>& used) {
  std::vector<Arc> flights;
  for (const std::size_t i : collision.arcs()) flights.push_back(arcs[i]), used[i] = 1;
  while (true) {
    double best = kGate;
    std::size_t flight = 0, piece = arcs.size();
    for (std::size_t f = 0; f < flights.size(); ++f)
      for (std::size_t i = 0; i < arcs.size(); ++i) {
        if (used[i] || (f < 2 ? arcs[i].end() > collision.u + 1.0 : arcs[i].begin() < collision.u - 1.0)) continue;
        const double off = continues(flights[f], arcs[i], noise);
        if (off < best) best = off, flight = f, piece = i;
      }
    if (piece == arcs.size()) return flights;
    flights[flight] = with(flights[flight], arcs[piece]);
    used[piece] = 1;
  }
}

/// How unlike a point of a flight a candidate is, in σ²; kGate² if it cannot be one.
double cost_of(const Candidate& c, const Arc& arc, const Candidate& look, double u, bool before, double noise) {
  constexpr double kNo = kGate * kGate;
  if (!c.whole || c.shadow || (before ? c.u > u - kNearImpact : c.u < u + kNearImpact)) return kNo;
  if (c.u < arc.begin() - 3.0 || c.u > arc.end() + 3.0) return kNo;
  const double off = (c.pixel - arc.curve.at(c.u)).squaredNorm() / (2.0 * noise * noise * (1.0 + arc.curve.variance_at(c.u)));
  return off < kNo / 2.0 ? std::min(off + unlikeness(c, look), kNo) : kNo;
}

/// The points of two flights on one side of the impact again, from all candidates there: the likeliest of each frame, none of both.
std::array<std::vector<Candidate>, 2> reassign(const Candidates& candidates, const Arc& a, const Arc& b, double u, bool before, double noise) {
  const Candidate look_a = looks_of(a), look_b = looks_of(b);
  std::array<std::vector<Candidate>, 2> points;
  for (const auto& frame : candidates) {
    std::vector<double> of_a(1, kGate * kGate), of_b(1, kGate * kGate);  // the first: not seen
    for (const Candidate& c : frame) of_a.push_back(cost_of(c, a, look_a, u, before, noise)), of_b.push_back(cost_of(c, b, look_b, u, before, noise));
    std::array<std::size_t, 2> best = {0, 0};
    for (std::size_t i = 0; i < of_a.size(); ++i)
      for (std::size_t j = 0; j < of_b.size(); ++j)
        if ((i != j || i == 0) && of_a[i] + of_b[j] < of_a[best[0]] + of_b[best[1]]) best = {i, j};
    for (std::size_t k = 0; k < 2; ++k)
      if (best[k] > 0) points[k].push_back(frame[best[k] - 1]);
  }
  for (std::size_t k = 0; k < 2; ++k) points[k] = without_odd_sizes(points[k].size() >= 3 ? points[k] : (k == 0 ? a : b).points, kOddSizeOfFlight);
  return points;
}

Curve curve_of(const std::vector<Candidate>& points) {
  CurveSums sums(points.front().u);
  for (const Candidate& c : points) sums.add(c.u, c.pixel);
  return sums.fit();
}

/// Marks arcs that run along a flight, or where it leads: pieces of the body's silhouette, where the background or a shadow parts it.
void mark_pieces(const std::vector<Arc>& arcs, const std::vector<Candidate>& flight, bool before, std::vector<char>& used) {
  const Curve curve = curve_of(flight);
  const double near = kAstray * typical_diameter(flight);
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const std::vector<Candidate>& points = arcs[i].points;
    const auto along = std::count_if(points.begin(), points.end(), [&](const Candidate& c) {
      return (before ? c.u <= flight.back().u : c.u >= flight.front().u) && (c.pixel - curve.at(c.u)).norm() < near;
    });
    if (2 * along > static_cast<std::ptrdiff_t>(points.size())) used[i] = 1;
  }
}

double noise_of(const std::vector<std::vector<Candidate>>& flights) {
  std::vector<Curve> curves;
  for (const auto& flight : flights) curves.push_back(curve_of(flight));
  return noise_about(flights, curves);
}

/// The longest flights of the two things that fly longest; no meeting.
Tracks without_collision(const Shot& shot, const std::vector<Arc>& arcs, double fps) {
  Tracks tracks;
  std::vector<std::vector<Candidate>> flights;
  for (const Arc& arc : arcs)
    if (flights.size() < 2) flights.push_back(arc.points);
  if (flights.size() == 2 && swapped(shot, flights[0], flights[1])) std::swap(flights[0], flights[1]);
  for (std::size_t i = 0; i < flights.size(); ++i) add_span(tracks, static_cast<int>(i), flights[i], fps);
  tracks.noise = noise_of(flights);
  return tracks;
}

/// Takes what is both bodies seen as one out of candidates and arcs, and marks arcs that are little else.
void drop_merged(const Collision& collision, Candidates& candidates, std::vector<Arc>& arcs, std::vector<char>& used) {
  const Candidates all = candidates;
  const auto merged = [&](const Candidate& c) { return is_both(c, collision.a, all) || is_both(c, collision.b, all); };
  for (auto& frame : candidates) std::erase_if(frame, merged);
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    std::vector<Candidate> alone = arcs[i].points;
    std::erase_if(alone, merged);
    if (alone.size() == arcs[i].points.size()) continue;
    used[i] = 2 * alone.size() < arcs[i].points.size();
    if (alone.size() >= 3) arcs[i] = arc_of(std::move(alone));
  }
}

Tracks with_collision(const Shot& shot, Candidates candidates, std::vector<Arc> arcs, const std::vector<Collision>& found, double noise, double fps) {
  const Collision& best = found.front();
  std::vector<char> used(arcs.size(), 0);
  drop_merged(best, candidates, arcs, used);
  const std::vector<Arc> whole = continued(arcs, best, noise, used);
  std::vector<std::vector<Candidate>> flights;
  for (const std::size_t i : {0, 2})
    for (std::vector<Candidate>& flight : reassign(candidates, whole[i], whole[i + 1], best.u, i < 2, noise)) flights.push_back(std::move(flight));
  if (swapped(shot, joined(flights[0], flights[2]), joined(flights[1], flights[3]))) {
    std::swap(flights[0], flights[1]);
    std::swap(flights[2], flights[3]);
  }
  for (std::size_t i = 0; i < 4; ++i) mark_pieces(arcs, flights[i], i < 2, used);
  Tracks tracks;
  for (std::size_t i = 0; i < 4; ++i) add_span(tracks, static_cast<int>(i % 2), flights[i], fps);
  tracks.noise = noise_of(flights);
  const auto link = [&](std::size_t o) { return link_of({flights[o], {}, 0}, {flights[o + 2], {}, 0}, noise); };
  double u = common_time(link(0), link(1), noise);
  if (!(std::abs(u - best.u) < kSettled)) u = best.u;
  tracks.meetings.push_back({u / fps, {0, 1}, {2, 3}});
  tracks.collisions_seen = count_collisions(found, used);
  return tracks;
}

}  // namespace

Tracks find_pair(const Shot& shot, const ShotCamera& camera, const Candidates& candidates, double fps, double least_noise, Context& context) {
  const double jitter = estimate_noise(candidates, least_noise), noise = silhouette_noise(shot, candidates, jitter, context);
  std::vector<Arc> arcs = find_arcs(candidates, noise, jitter, context);
  if (arcs.size() > kMostArcs) arcs.resize(kMostArcs);
  const std::vector<Collision> found = find_collisions(shot, camera, candidates, arcs, noise, fps);
  if (found.empty()) {
    const std::optional<HeavyHits> hits = find_heavy_hits(shot, candidates, arcs, noise, jitter, fps, context);
    return hits ? with_collision(shot, candidates, hits->arcs, hits->found, noise, fps) : without_collision(shot, arcs, fps);
  }
  return with_collision(shot, candidates, arcs, found, noise, fps);
}

}  // namespace unseen::collision
