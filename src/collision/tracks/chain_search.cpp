// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/chain_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "collision/shot_problem.h"
#include "collision/solve/linear_flights.h"
#include "collision/tracks/flight_cost.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr std::size_t kMost = 900;  // sightings

/// Sightings of a flight.
struct Range {
  std::size_t begin, end;
};

/// Whether the sizes of a body say that it comes nearer on one side of a meeting and goes away on the other. What rises from a floor below the camera falls
/// back to it: there the halves of its flights by the meeting tell, if they say that it went away and then came nearer, as at no top of a flight.
bool returns(const Shot& shot, const ShotCamera& camera, Tracks tracks, const Tracks::Meeting& meeting) {
  constexpr double kClear = 3.0;  // σ
  FlightSpan &before = tracks.spans[static_cast<std::size_t>(meeting.before[0])], &after = tracks.spans[static_cast<std::size_t>(meeting.after[0])];
  const auto turns = [&](bool from_away) {
    const Problem problem = problem_of(shot, Options{}, camera, {solid_of(shot.bodies[0], shot.name), solid_of(shot.bodies[1], shot.name)}, tracks, meeting);
    if (problem.trends.size() != 2) return false;
    const SizeTrend &one = problem.trends[0], &other = problem.trends[1];
    if (from_away ? one.change < 0.0 || other.change > 0.0 : one.change * other.change >= 0.0) return false;
    return std::min(std::abs(one.change) / one.sigma, std::abs(other.change) / other.sigma) > kClear;
  };
  if (turns(false)) return true;
  before.begin = (before.begin + before.end) / 2;
  after.end = (after.begin + after.end) / 2;
  return turns(true);
}

/// Flights that follow each other within `step` sightings meet where both explain theirs best.
void settle_ends(const Flights& flights, const std::vector<Candidate>& seen, std::size_t step, double fps, std::vector<Range>& spans, Context& context) {
  for (std::size_t k = 0; k + 1 < spans.size(); ++k) {
    Range &before = spans[k], &after = spans[k + 1];
    if (after.begin - before.end > step) continue;
    context.check();
    std::optional<double> least;
    std::size_t best = before.end;
    for (std::size_t end = before.end - step; end <= std::min(after.begin + step, after.end); ++end) {
      const std::optional<double> first = flights.cost({seen}, before.begin, end, std::nullopt, fps), second = flights.cost({seen}, end, after.end, std::nullopt, fps);
      if (first && second && (!least || *first + *second < *least)) least = *first + *second, best = end;
    }
    if (least) before.end = after.begin = best;
  }
}

struct Chain {
  std::vector<Range> flights;
  double cost = std::numeric_limits<double>::infinity();  ///< ½ χ², of what belongs to no flight too
};

/// The fewest flights that explain the sightings of a body; one may belong to none. Ends are multiples of `step` first.
Chain fewest_flights(const Flights& flights, const std::vector<Candidate>& seen, double fps, Context& context) {
  constexpr std::size_t kEnds = 60;       // each pair of them is tried as the ends of a flight
  constexpr double kAnotherFlight = 12.0;  // ½ χ² that it must explain
  const std::size_t step = (seen.size() + kEnds - 1) / kEnds, count = (seen.size() + step - 1) / step;
  const auto end_of = [&](std::size_t k) { return std::min(k * step, seen.size()); };
  // least cost of what is before the k-th end, and at which end its last flight begins
  std::vector<double> least(count + 1, 0.0);
  std::vector<std::size_t> from(count + 1, 0);
  std::vector<char> flown(count + 1, 0);
  for (std::size_t j = 1; j <= count; ++j) {
    context.check();
    least[j] = least[j - 1] + kMostMisfit * static_cast<double>(end_of(j) - end_of(j - 1));
    from[j] = j - 1;
    for (std::size_t i = 0; i < j; ++i) {
      if (end_of(i) + kFewestSeen > end_of(j)) continue;
      const std::optional<double> cost = flights.cost({seen}, end_of(i), end_of(j), std::nullopt, fps);
      if (!cost || least[i] + *cost + kAnotherFlight >= least[j]) continue;
      least[j] = least[i] + *cost + kAnotherFlight;
      from[j] = i;
      flown[j] = 1;
    }
  }
  std::vector<Range> spans;
  for (std::size_t j = count; j > 0; j = from[j])
    if (flown[j]) spans.insert(spans.begin(), {end_of(from[j]), end_of(j)});
  if (step > 1) settle_ends(flights, seen, step, fps, spans, context);
  return {spans, least[count]};
}

/// The same, and down with it.
Chain settled_chain(Flights& flights, const std::vector<Candidate>& seen, double fps, Context& context) {
  constexpr int kRounds = 3;
  constexpr double kLess = 0.5;  // ½ χ² that a round must gain
  Chain best;
  for (int round = 0; round < kRounds; ++round) {
    Chain now = fewest_flights(flights, seen, fps, context);
    const auto in_flight = [&]() -> std::optional<double> {
      double sum = 0.0;
      for (const Range& r : now.flights) {
        const std::optional<double> cost = flights.cost({seen}, r.begin, r.end, std::nullopt, fps);
        if (!cost) return std::nullopt;
        sum += *cost;
      }
      return sum;
    };
    Flights turned = flights;
    const std::optional<double> level = in_flight();
    if (!level) break;
    now.cost += flights.settle_down(in_flight).value_or(*level) - *level;
    if (round > 0 && now.cost > best.cost - kLess) {
      flights = turned;
      break;
    }
    best = now;
  }
  return best;
}

/// Other guesses of down: as one flight of all sightings says (a wrong one bends flights, which an impact would explain), and as in cameras that look down.
std::vector<Flights> other_ways_down(const Flights& level, const Shot& shot, const std::vector<Candidate>& seen, double fps) {
  const bool steep = !level.knows_down() && shot.gravity > 0.0;
  std::vector<Flights> ways(steep ? 3 : 1, level);
  ways[0].settle_down([&] { return ways[0].cost({seen}, 0, seen.size(), std::nullopt, fps); });
  if (steep) {
    ways[1].set_down(Vec3(0, 1, 1).normalized());
    ways[2].set_down(Vec3::UnitZ());
  }
  return ways;
}

/// What lies, rolls or is held moves straight in the picture, as a flight of a few frames seems to.
void leave_out_what_does_not_fall(const Shot& shot, const ShotCamera& camera, const Flights& flights, const std::vector<Candidate>& seen, double noise, double fps,
                                  std::vector<Range>& spans) {
  constexpr double kFalls = 8.0;  // ½ χ² that gravity must explain
  if (shot.gravity == 0.0) return;
  Shot weightless = shot;
  weightless.gravity = 0.0;
  const Flights straight(weightless, camera, noise);
  std::erase_if(spans, [&](const Range& r) {
    const std::optional<double> falling = flights.cost({seen}, r.begin, r.end, std::nullopt, fps), line = straight.cost({seen}, r.begin, r.end, std::nullopt, fps);
    return !falling || (line && *line < *falling + kFalls);
  });
}

}  // namespace

std::optional<Tracks> search_chain(const Shot& shot, const ShotCamera& camera, std::vector<Candidate> seen, int body, double fps, double noise, Context& context) {
  if (seen.size() < 2 * kFewestSeen || seen.size() > kMost) return std::nullopt;
  for (Candidate& c : seen) c.body = body;
  Flights flights(shot, camera, noise);
  std::vector<Flights> others = other_ways_down(flights, shot, seen, fps);
  Chain chain = settled_chain(flights, seen, fps, context);
  for (Flights& way : others)
    if (Chain other = settled_chain(way, seen, fps, context); other.cost < chain.cost) chain = std::move(other), flights = way;
  std::vector<Range>& spans = chain.flights;
  leave_out_what_does_not_fall(shot, camera, flights, seen, noise, fps, spans);
  Tracks tracks;
  tracks.noise = noise;
  for (const auto& [begin, end] : spans) add_flight(seen, begin, end, body, fps, tracks);
  std::vector<double> steps;
  for (std::size_t i = 1; i < seen.size(); ++i) steps.push_back(seen[i].u - seen[i - 1].u);
  constexpr double kLongestGap = 4.0;  // frames, or steps of what was seen in fewer
  const double longest = kLongestGap * std::max(1.0, median(steps));
  for (std::size_t k = 0; k + 1 < spans.size(); ++k) {
    const double end = seen[spans[k].end - 1].u, begin = seen[spans[k + 1].begin].u;
    if (begin - end > longest) continue;
    tracks.meetings.push_back({0.5 * (begin + end) / fps, {static_cast<int>(k)}, {static_cast<int>(k) + 1}});
  }
  if (tracks.meetings.empty()) return std::nullopt;
  tracks.collisions_seen = static_cast<int>(tracks.meetings.size());
  return tracks;
}

std::optional<Tracks> search_return(const Shot& shot, const ShotCamera& camera, const std::vector<Candidate>& seen, int body, double fps, double noise,
                                    Context& context) {
  std::optional<Tracks> tracks = search_chain(shot, camera, seen, body, fps, std::hypot(noise, kLopsided * typical_diameter(seen)), context);
  if (!tracks) return std::nullopt;
  std::erase_if(tracks->meetings, [&](const Tracks::Meeting& meeting) { return !returns(shot, camera, *tracks, meeting); });
  tracks->noise = noise;
  tracks->collisions_seen = static_cast<int>(tracks->meetings.size());
  return tracks->meetings.empty() ? std::nullopt : tracks;
}

}  // namespace unseen::collision
