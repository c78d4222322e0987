// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/chain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "collision/tracks/chain_search.h"
#include "collision/tracks/meetings.h"
#include "collision/tracks/movers.h"
#include "collision/tracks/one_flight.h"
#include "collision/tracks/spans.h"
#include "collision/tracks/time_gaps.h"

namespace unseen::collision {
namespace {

constexpr double kAbsent = 9.0;        // σ², of a frame without the body
constexpr double kFlown = 6.0;         // σ² that being on a flight is worth
constexpr double kFar = 1.5;           // times the largest step within flights
constexpr double kFarCost = 9.0;       // σ², of a step that long
constexpr int kBackFrames = 12;        // that the body may be out of sight in a track, at least
constexpr double kGapFrames = 4.5;     // frame times between two flights that meet, at most, and
constexpr double kGapSeconds = 0.4;
constexpr double kBitten = 0.1;       // share: a part of a ball is not seen

/// One candidate a frame, or none: least unlike the body, in steps that it can take, on its flights where there are some (Viterbi).
std::vector<Candidate> follow(const Candidates& candidates, const std::vector<Arc>& arcs, double noise, double fps) {
  const std::size_t back = std::max(kBackFrames, static_cast<int>(kGapSeconds * fps));
  const Candidate look = looks_of(*std::max_element(arcs.begin(), arcs.end(), [](const Arc& a, const Arc& b) { return a.points.size() < b.points.size(); }));
  double far = 4.0 * noise + 0.5 * look.diameter;
  for (const Arc& arc : arcs)
    for (std::size_t i = 1; i < arc.points.size(); ++i)
      far = std::max(far, (arc.points[i].pixel - arc.points[i - 1].pixel).norm() / (arc.points[i].frame - arc.points[i - 1].frame));
  far *= kFar;
  struct Node {
    const Candidate* candidate;
    double cost, own;
    int from;
  };
  std::vector<Node> nodes;
  std::vector<std::size_t> first_of;  // node of each frame
  std::vector<int> filled;            // frames with candidates before each frame
  for (std::size_t k = 0; k < candidates.size(); ++k) {
    first_of.push_back(nodes.size());
    filled.push_back(k == 0 ? 0 : filled.back() + (candidates[k - 1].empty() ? 0 : 1));
    for (const Candidate& c : candidates[k]) {
      if (!c.whole || c.shadow) continue;
      const bool flown = std::any_of(arcs.begin(), arcs.end(), [&](const Arc& arc) {
        return std::any_of(arc.points.begin(), arc.points.end(), [&](const Candidate& p) { return p.frame == c.frame && p.pixel == c.pixel; });
      });
      const double own = unlikeness(c, look) - (flown ? kFlown : 0.0);
      if (own > kAbsent) continue;
      Node node{&c, kAbsent * filled[k] + own, own, -1};
      for (std::size_t i = k >= back ? first_of[k - back] : 0; i < first_of[k]; ++i) {
        const Candidate& p = *nodes[i].candidate;
        const double step = (c.pixel - p.pixel).norm() / ((c.frame - p.frame) * far);
        const double cost = nodes[i].cost + kAbsent * (filled[k] - filled[p.frame] - 1) + own + (step > 1.0 ? 4.0 * kFarCost : kFarCost * step * step);
        if (cost < node.cost) {
          node.cost = cost;
          node.from = static_cast<int>(i);
        }
      }
      nodes.push_back(node);
    }
  }
  int best = -1;
  double least = 1e300;
  const int all = filled.empty() ? 0 : filled.back() + 1;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double cost = nodes[i].cost + kAbsent * (all - filled[nodes[i].candidate->frame] - 1);
    if (cost < least) {
      least = cost;
      best = static_cast<int>(i);
    }
  }
  std::vector<Candidate> track;
  for (int i = best; i >= 0; i = nodes[i].from) track.push_back(*nodes[i].candidate);
  std::reverse(track.begin(), track.end());
  return track;
}

void warn_of(const TimeGaps& gaps, const std::vector<Candidate>& track, const Shot& shot, Context& context) {
  std::string places;
  for (const auto& gap : gaps.gaps) {
    const auto at = std::find_if(track.begin(), track.end(), [&](const Candidate& c) { return c.frame == gap.after; });
    places += fmt::format("{}{}", places.empty() ? "" : ", ", at == track.end() ? gap.after : at->file_frame());
  }
  if (gaps.period)
    context.warn(fmt::format("{}: one frame in {} was dropped (seen after frames {}): the clip was thinned to a lower rate; times are "
                             "corrected, the clip's duration is kept", shot.name, *gaps.period + 1, places));
  else
    context.warn(fmt::format("{}: frames are missing after frame {}, where a body in flight moves as far as in several; times are corrected",
                             shot.name, places));
}

/// Puts lost frames back into the times of a track.
void correct_times(std::vector<Candidate>& track, double noise, const Shot& shot, Context& context) {
  TimeGaps gaps = find_time_gaps(track, noise, {});
  std::vector<Candidate> spaced = track;
  const TimeGaps plain{gaps.gaps, {}};
  for (Candidate& c : spaced) c.u = plain.corrected(c.frame, c.u);
  if (const auto gravity = shared_gravity(split_into_flights(spaced, noise, {}, context), spaced, noise)) gaps = find_time_gaps(track, noise, gravity);
  if (gaps.gaps.empty()) return;
  warn_of(gaps, track, shot, context);
  for (Candidate& c : track) c.u = gaps.corrected(c.frame, c.u);
}

/// Flights and where they meet, in a track whose times are right.
struct Flown {
  Tracks tracks;
  std::vector<Candidate> track;
  std::vector<Stretch> flights;  ///< a span

  std::vector<Candidate> points(std::size_t first, std::size_t last) const { return {track.begin() + flights[first].begin, track.begin() + flights[last].end}; }
};

/// Flights of a track that are parabolas of the picture, and where they meet.
Flown flights_in_picture(const Shot& shot, const std::vector<Candidate>& seen, int body, double noise, double fps, Context& context) {
  Flown flown;
  flown.track = seen;
  auto& [tracks, track, flights] = flown;
  correct_times(track, noise, shot, context);
  std::optional<ImageGravity> gravity;
  if (shot.gravity > 0.0) {
    gravity = shared_gravity(split_into_flights(track, noise, {}, context), track, noise);
    if (!gravity) return flown;
  } else {
    gravity = ImageGravity{Vec2::Zero(), 0.02 * noise};
  }
  flights = split_into_flights(track, noise, gravity, context);
  std::vector<std::vector<Candidate>> points;
  std::vector<Curve> curves;
  for (Stretch& flight : flights) {
    trim(track, noise, flight);
    points.emplace_back(track.begin() + flight.begin, track.begin() + flight.end);
    curves.push_back(flight.curve);
    add_span(tracks, body, points.back(), fps);
  }
  tracks.noise = noise_about(points, curves);
  const double diameter = typical_diameter(track), allowed = std::max(kGapFrames, kGapSeconds * fps);
  for (std::size_t i = 0; i + 1 < flights.size(); ++i) {
    const double end = points[i].back().u, begin = points[i + 1].front().u;
    if (begin - end > allowed) continue;
    const Curve before = curve_near_end(points[i], noise), after = curve_near_begin(points[i + 1], noise);
    const Joint joint = join(before, end, after, begin, std::max(noise, tracks.noise), diameter);
    if (joint.apart > joint.tolerance || !joint.sudden || !rebounds(before, after, joint)) continue;
    tracks.meetings.push_back({joint.u / fps, {static_cast<int>(i)}, {static_cast<int>(i + 1)}});
  }
  tracks.collisions_seen = static_cast<int>(tracks.meetings.size());
  return flown;
}

/// The same with what lies between two meetings parted anew where a ball turns back along the view ray, as no parabola of the picture shows.
Tracks with_returns(const Shot& shot, const ShotCamera& camera, const Flown& flown, int body, double fps, double noise, Context& context) {
  Tracks tracks;
  std::size_t first = 0;  // flight of those between two meetings
  for (std::size_t meeting = 0; meeting <= flown.tracks.meetings.size(); ++meeting) {
    const bool ends = meeting == flown.tracks.meetings.size();
    const std::size_t last = ends ? flown.flights.size() - 1 : static_cast<std::size_t>(flown.tracks.meetings[meeting].before[0]);
    const auto offset = tracks.points.size();
    const auto spans = static_cast<int>(tracks.spans.size());
    if (const auto parted = search_return(shot, camera, flown.points(first, last), body, fps, noise, context)) {
      tracks.points.insert(tracks.points.end(), parted->points.begin(), parted->points.end());
      for (const FlightSpan& span : parted->spans) tracks.spans.push_back({span.body, span.begin + offset, span.end + offset});
      for (const Tracks::Meeting& m : parted->meetings) tracks.meetings.push_back({m.time, {m.before[0] + spans}, {m.after[0] + spans}});
    } else {
      for (std::size_t i = first, end; i <= last; i = end) {  // what the picture's parabolas part may be one flight in space
        end = i + 1;
        while (end <= last && is_one_flight(flown.points(i, end), std::max(noise, flown.tracks.noise))) ++end;
        add_span(tracks, body, flown.points(i, end - 1), fps);
      }
    }
    const auto next = static_cast<int>(tracks.spans.size());
    if (!ends) tracks.meetings.push_back({flown.tracks.meetings[meeting].time, {next - 1}, {next}});
    first = last + 1;
  }
  tracks.noise = flown.tracks.noise;
  tracks.collisions_seen = static_cast<int>(tracks.meetings.size());
  return tracks;
}

/// Flights of the thing that has these arcs; none if it does not fly.
Tracks flights_of(const Shot& shot, const ShotCamera& camera, const Candidates& candidates, const std::vector<Arc>& arcs, int body, double fps, double noise, Context& context) {
  std::vector<Candidate> track = follow(candidates, arcs, noise, fps);
  if (!shot.video.empty() && shot.bodies[static_cast<std::size_t>(body)].shape == Shape::sphere) track = without_odd_sizes(track, kBitten);
  const Flown flown = flights_in_picture(shot, track, body, noise, fps, context);
  if (!flown.tracks.meetings.empty()) return with_returns(shot, camera, flown, body, fps, noise, context);
  if (shot.video.empty()) return flown.tracks;
  return search_return(shot, camera, track, body, fps, noise, context).value_or(flown.tracks);
}

}  // namespace

Tracks find_chain(const Shot& shot, const ShotCamera& camera, const Candidates& candidates, int body, double fps, double least_noise, Context& context) {
  const double jitter = estimate_noise(candidates, least_noise), noise = silhouette_noise(shot, candidates, jitter, context);
  for (const std::vector<Arc>& arcs : arcs_by_mover(find_arcs(candidates, noise, jitter, context), noise))
    if (Tracks tracks = flights_of(shot, camera, candidates, arcs, body, fps, noise, context); !tracks.spans.empty()) return tracks;
  return {};
}

}  // namespace unseen::collision
