// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/hints.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "collision/doubts/common_bend.h"
#include "collision/doubts/held.h"
#include "collision/solve_turning.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

/// Orientations of a time at which nobody saw the body tell nothing.
void warn_of_far_orientations(const Shot& shot, const Tracks& tracks, Context& context) {
  for (std::size_t k = 0; k < shot.orientations.size(); ++k) {
    const OrientationHint& hint = shot.orientations[k];
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (const TrackPoint& p : tracks.points) {
      if (p.body != hint.body) continue;
      first = std::min(first, p.time);
      last = std::max(last, p.time);
    }
    const double beyond = kBeyondFlights * (last - first);
    if (last >= first && (hint.time < first - beyond || hint.time > last + beyond))
      context.warn(fmt::format("{}: orientations[{}]: {} was not seen at {:.4g} s: left out", shot.name, k, shot.bodies[hint.body].name, hint.time));
  }
}

/// "ball in frames 2 to 25 and 40 to 61": where a body was seen to fly.
std::string flights_of(const Shot& shot, const Tracks& tracks, int body) {
  std::string text;
  for (const FlightSpan& span : tracks.spans)
    if (span.body == body && span.end > span.begin)
      text += fmt::format("{} {} to {}", text.empty() ? " in frames" : " and", tracks.points[span.begin].frame, tracks.points[span.end - 1].frame);
  return shot.bodies[body].name + (text.empty() ? " nowhere" : text);
}

}  // namespace

void warn_of_unused(const Shot& shot, const Tracks& tracks, Context& context) {
  const bool both_free = std::none_of(shot.bodies.begin(), shot.bodies.end(), [](const Body& b) { return b.shape == Shape::fixed; });
  if (shot.floor && both_free) context.warn(shot.name + ": floor: not used, as both bodies move");
  if (shot.floor && shot.bodies[1].normal) context.warn(fmt::format("{}: floor: not used, as {} has a normal of its own", shot.name, shot.bodies[1].name));
  if (shot.roi && shot.video.empty()) context.warn(shot.name + ": roi: not used, as there are observations instead of a video");
  for (std::size_t o = 0; o < shot.bodies.size(); ++o)
    if (shot.bodies[o].shape == Shape::sphere &&
        std::any_of(shot.orientations.begin(), shot.orientations.end(), [&](const OrientationHint& hint) { return hint.body == static_cast<int>(o); }))
      context.warn(fmt::format("{}: orientations: those of {} are not used, as a sphere looks alike however it is turned", shot.name, shot.bodies[o].name));
  warn_of_far_orientations(shot, tracks, context);
}

void warn_of_far_sightings(const Shot& shot, double fps, Context& context) {
  constexpr double kFar = 2.5;
  std::set<int> frames;
  for (const Sighting& s : shot.observations) frames.insert(s.frame);
  std::vector<double> steps;
  for (auto it = frames.begin(); it != frames.end() && std::next(it) != frames.end(); ++it) steps.push_back(*std::next(it) - *it);
  if (const double step = median(std::move(steps)); step > kFar)
    context.warn(fmt::format("{}: sightings are {:.0f} frames apart, {:.4g} a second: too few may be of one flight", shot.name, step, fps / step));
}

std::string nothing_found(const Shot& shot, const Tracks& tracks) {
  if (tracks.spans.empty())
    return std::string("nothing that flies freely was found") +
           (shot.video.empty() || shot.roi ? "" : "; if other things move in the picture, a \"roi\" around the flights leaves them out");
  for (int body = 0; body < 2; ++body) {
    const auto of_it = [body](const auto& seen) { return seen.body == body; };
    if (shot.bodies[body].shape != Shape::fixed && shot.video.empty() && std::none_of(shot.observations.begin(), shot.observations.end(), of_it) &&
        std::any_of(shot.observations.begin(), shot.observations.end(), [](const Sighting& s) { return s.body >= 0; }))
      return fmt::format("no collision found: {} has no sightings", shot.bodies[body].name);
  }
  if (shot.gravity == 0.0 && !shot.metres_per_pixel && std::none_of(tracks.points.begin(), tracks.points.end(), [](const TrackPoint& p) { return p.diameter > 0.0; }))
    return "no collision found: without gravity nothing tells the scale: give sightings a \"radius\", or the shot \"metres_per_pixel\"";
  if (!tracks.meetings.empty() && shot.bodies[1].shape == Shape::fixed) return fmt::format("no bounce off {} was found that its flights explain", shot.bodies[1].name);
  const bool two = shot.bodies[1].shape != Shape::fixed;
  return fmt::format("no collision found: the flights do not meet (seen to fly: {}{}{})", flights_of(shot, tracks, 0), two ? ", " + flights_of(shot, tracks, 1) : "",
                     shot.video.empty() ? "" : "; in a flight a body's outline is seen by itself");
}

void warn_of_held(const Shot& shot, const Evidence& evidence, const Problem& problem, Context& context) {
  for (int body = 0; body < 2; ++body)
    if (const auto seconds = seconds_held(evidence.footage, evidence.tracks, problem, body))
      context.warn(fmt::format("{} was seen as one with something else that moves for {:.2g} s about the impact: if that held it, as a hand does, this is no bounce", shot.bodies[body].name, *seconds));
}

void warn_of_common_bend(const Shot& shot, const Tracks& tracks, const std::vector<SolvedImpact>& impacts, Context& context) {
  if (const auto bend = common_bend(tracks, impacts))
    context.warn(fmt::format("{}: all flights bend alike, by {:.2g} m/s², though \"gravity\" is 0: something falls, what they slide on is not level, or the camera does not look straight at it", shot.name,
                             *bend));
}

}  // namespace unseen::collision
