// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/collision/collision.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "collision/describe.h"
#include "collision/doubts/common_bend.h"
#include "collision/doubts/common_error.h"
#include "collision/doubts/focal_doubt.h"
#include "collision/doubts/held.h"
#include "collision/remarks.h"
#include "collision/shot_problem.h"
#include "collision/sighted.h"
#include "collision/solve/drag.h"
#include "collision/solve/terms.h"
#include "collision/solve_impacts.h"
#include "collision/solve_turning.h"
#include "collision/tracks/rolling_shutter.h"
#include "unseen/core/error.h"
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

/// Why flights of sightings may not have been found, or tell little.
void warn_of_far_sightings(const Shot& shot, double fps, Context& context) {
  constexpr double kFar = 2.5;
  std::set<int> frames;
  for (const Sighting& s : shot.observations) frames.insert(s.frame);
  std::vector<double> steps;
  for (auto it = frames.begin(); it != frames.end() && std::next(it) != frames.end(); ++it) steps.push_back(*std::next(it) - *it);
  if (const double step = median(std::move(steps)); step > kFar)
    context.warn(fmt::format("{}: sightings are {:.0f} frames apart, {:.4g} a second: too few may be of one flight", shot.name, step, fps / step));
}

/// What is given and tells nothing.
void warn_of_unused(const Shot& shot, Context& context) {
  const bool both_free = std::none_of(shot.bodies.begin(), shot.bodies.end(), [](const Body& b) { return b.shape == Shape::fixed; });
  if (shot.floor && both_free) context.warn(shot.name + ": floor: not used, as both bodies move");
  if (shot.floor && shot.bodies[1].normal) context.warn(fmt::format("{}: floor: not used, as {} has a normal of its own", shot.name, shot.bodies[1].name));
  if (shot.roi && shot.video.empty()) context.warn(shot.name + ": roi: not used, as there are observations instead of a video");
  for (std::size_t o = 0; o < shot.bodies.size(); ++o)
    if (shot.bodies[o].shape == Shape::sphere &&
        std::any_of(shot.orientations.begin(), shot.orientations.end(), [&](const OrientationHint& hint) { return hint.body == static_cast<int>(o); }))
      context.warn(fmt::format("{}: orientations: those of {} are not used, as a sphere looks alike however it is turned", shot.name, shot.bodies[o].name));
}

/// "ball in frames 2 to 25 and 40 to 61": where a body was seen to fly.
std::string flights_of(const Shot& shot, const Tracks& tracks, int body) {
  std::string text;
  for (const FlightSpan& span : tracks.spans)
    if (span.body == body && span.end > span.begin)
      text += fmt::format("{} {} to {}", text.empty() ? " in frames" : " and", tracks.points[span.begin].frame, tracks.points[span.end - 1].frame);
  return shot.bodies[body].name + (text.empty() ? " nowhere" : text);
}

/// Why no impact was found.
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

/// What the film, or the sightings in its place, show.
struct Evidence {
  Footage footage;
  ShotCamera camera;
  Tracks tracks;
  double fps = 0;
};

/// Follows what moves, as a camera sees it.
Tracks follow(const Shot& shot, const Footage& footage, const ShotCamera& camera, double fps, Context& context) {
  if (!shot.video.empty()) return with_rolling_shutter(find_tracks(shot, camera, footage, context), camera, footage.turn);
  std::vector<Sighting> sightings = shot.observations;
  if (shot.frames) std::erase_if(sightings, [&](const Sighting& s) { return s.frame < (*shot.frames)[0] || s.frame > (*shot.frames)[1]; });
  return with_rolling_shutter(find_tracks(shot, camera, sightings, fps, context), camera, 0);
}

Evidence observe(const Shot& shot, Context& context, Summary& summary) {
  Evidence evidence;
  if (shot.video.empty()) {
    if (!shot.fps) throw InputError(shot.name, "fps", "nothing", "the frame rate of the observations");
    evidence.fps = *shot.fps;
  } else {
    const Stage stage(context, summary, "regions");
    evidence.footage = find_regions(shot, context);
    evidence.fps = evidence.footage.fps;
  }
  const Stage stage(context, summary, "tracks");
  evidence.camera = complete_camera(shot, evidence.footage.width, evidence.footage.height);
  check_readout(shot, evidence.footage, evidence.fps);
  evidence.tracks = follow(shot, evidence.footage, evidence.camera, evidence.fps, context);
  return evidence;
}

/// All impacts by the bodies' positions.
std::vector<SolvedImpact> solve_all_positions(const Shot& shot, const Options& options, const ShotCamera& camera, const std::array<Solid, 2>& solids, Tracks& tracks,
                                              double fps, Context& context) {
  std::vector<SolvedImpact> impacts = solve_positions(shot, options, camera, solids, tracks, fps, context);
  share_gravity(impacts);
  share_floor(impacts);
  return impacts;
}

/// The same through a camera of the focal length that these impacts tell, where it was a guess and they tell it. False where nothing changes.
bool solve_with_told_camera(const Shot& shot, const Options& options, const std::array<Solid, 2>& solids, Evidence& evidence, std::vector<SolvedImpact>& impacts, Context& context) {
  constexpr int kRounds = 6;  // at a wrong focal length the noise seems large and the vertical is off
  double step = likelier_focal_length(impacts, 1.0, context);
  if (step == 1.0) return false;
  Context quiet = context;  // the last of these solutions is the one to speak of
  quiet.on_message = nullptr;
  quiet.on_progress = nullptr;
  ShotCamera camera = evidence.camera;
  Tracks tracks;
  std::vector<SolvedImpact> told;
  const auto solve_again = [&] {
    told = solve_all_positions(shot, options, camera, solids, tracks, evidence.fps, quiet);
    return told.size() >= impacts.size();
  };
  for (int round = 0; round < kRounds && step != 1.0; ++round) {
    camera.camera.fx *= step;
    camera.camera.fy *= step;
    tracks = evidence.tracks;
    if (!solve_again()) return false;
    step = likelier_focal_length(told, camera.camera.fx / evidence.camera.camera.fx, context);
  }
  tracks = follow(shot, evidence.footage, camera, evidence.fps, quiet);
  if (!solve_again()) return false;
  evidence.camera = camera;
  evidence.tracks = std::move(tracks);
  impacts = std::move(told);
  return true;
}

/// The same with two spheres exchanged that were taken for each other, as their sizes say once gravity tells how far away each is.
void exchange_by_size(const Shot& shot, const Options& options, const std::array<Solid, 2>& solids, Evidence& evidence, std::vector<SolvedImpact>& impacts, Context& context) {
  if (evidence.tracks.told_apart || impacts.empty() || !look_exchanged(impacts.front().solution)) return;
  Context quiet = context;
  quiet.on_message = nullptr;
  quiet.on_progress = nullptr;
  Tracks tracks = evidence.tracks;
  exchange_bodies(tracks);
  std::vector<SolvedImpact> exchanged = solve_all_positions(shot, options, evidence.camera, solids, tracks, evidence.fps, quiet);
  if (exchanged.size() < impacts.size() || look_exchanged(exchanged.front().solution)) return;
  evidence.tracks = std::move(tracks);
  impacts = std::move(exchanged);
}

/// A body that was held between its flights did not collide.
void doubt_held(const Shot& shot, const Evidence& evidence, const Problem& problem, Context& context) {
  for (int body = 0; body < 2; ++body)
    if (const auto seconds = seconds_held(evidence.footage, evidence.tracks, problem, body))
      context.warn(fmt::format("{} was seen as one with something else that moves for {:.2g} s about the impact: if that held it, as a hand does, this is no bounce", shot.bodies[body].name, *seconds));
}

/// What is said to be without gravity, and bends.
void doubt_weightlessness(const Shot& shot, const Tracks& tracks, const std::vector<SolvedImpact>& impacts, Context& context) {
  if (const auto bend = common_bend(tracks, impacts))
    context.warn(fmt::format("{}: all flights bend alike, by {:.2g} m/s², though \"gravity\" is 0: something falls, what they slide on is not level, or the camera does not look straight at it", shot.name,
                             *bend));
}

void reconstruct_into(const Shot& shot, const Options& options, Context& context, Reconstruction& result) {
  Summary& summary = result.summary;
  if (shot.bodies.size() != 2) throw InputError(shot.name, "bodies", std::to_string(shot.bodies.size()), "two");
  if (shot.fps && !(*shot.fps > 0.0 && std::isfinite(*shot.fps))) throw InputError(shot.name, "fps", fmt::format("{}", *shot.fps), "frames per second, above 0");
  if (!(shot.gravity >= 0.0 && std::isfinite(shot.gravity))) throw InputError(shot.name, "gravity", fmt::format("{}", shot.gravity), "m/s², from 0");
  const std::array<Solid, 2> solids = {solid_of(shot.bodies[0], shot.name), solid_of(shot.bodies[1], shot.name)};
  check_drag(shot, options, solids);
  Evidence evidence = observe(shot, context, summary);
  Tracks& tracks = evidence.tracks;
  warn_of_footage(evidence.footage, context);
  summary.counts = {{"points", tracks.points.size()}, {"flights", tracks.spans.size()}, {"meetings", tracks.meetings.size()}};
  result.camera = evidence.camera.camera;
  result.fps = evidence.fps;
  result.T_world_camera = world_of(shot.down.value_or(Vec3::UnitY()), shot.gravity == 0.0);
  if (shot.bodies[1].shape == Shape::fixed) result.fixed = shot.bodies[1].name;
  for (const Body& body : shot.bodies) result.bodies.push_back({body.name, body.shape == Shape::fixed, Vec3::Zero(), {}, {}});

  warn_of_unused(shot, context);
  warn_of_far_orientations(shot, tracks, context);
  std::vector<SolvedImpact> impacts;
  {
    const Stage stage(context, summary, "positions");
    impacts = solve_all_positions(shot, options, evidence.camera, solids, tracks, evidence.fps, context);
    const bool told = solve_with_told_camera(shot, options, solids, evidence, impacts, context);
    exchange_by_size(shot, options, solids, evidence, impacts, context);
    warn_of_camera(evidence.camera, told, context);
    result.camera = evidence.camera.camera;
  }
  {
    const Stage stage(context, summary, "orientations");
    for (SolvedImpact& impact : impacts) solve_turning(shot, options, evidence.camera, evidence.footage, tracks, impact, context);
  }
  if (options.shared_restitution) share_restitution(impacts);
  {
    const Stage stage(context, summary, "uncertainty");
    for (SolvedImpact& impact : impacts) {
      impact.uncertain = uncertainty(impact.solution, options.resamples, options.seed, context);
      weigh_common_error(impact.solution, impact.uncertain, options.resamples, options.seed, context);
      impact.check = check_model(impact.solution, options.held_out, tracks.noise, {shot.bodies[0].name, shot.bodies[1].name});
      doubt_held(shot, evidence, impact.solution.problem, context);
    }
    doubt_weightlessness(shot, tracks, impacts, context);
  }
  if (impacts.empty()) {
    summary.status = Status::infeasible;
    context.warn(nothing_found(shot, tracks));
    result.sighted = sighted_in(evidence.footage, tracks);
    warn_of_far_sightings(shot, evidence.fps, context);
    return;
  }
  result.bodies.clear();
  describe(shot, tracks, evidence.fps, impacts, result);
  remark_on(shot, options, tracks, impacts, result, context);
  warn_of_dimmed(shot, evidence.footage, tracks, context);
  if (result.restitution) return;
  summary.status = Status::infeasible;
  warn_of_far_sightings(shot, evidence.fps, context);
}

}  // namespace

Reconstruction reconstruct(const Shot& shot, const Options& options, Context& context) {
  check_options(options);
  terms_of(options.physics, options.without);  // an unknown term is told before any work
  Reconstruction result;
  try {
    reconstruct_into(shot, options, context, result);
  } catch (const Cancelled&) {
    result.summary.status = Status::cancelled;
  }
  result.summary.warnings = context.take_warnings();
  return result;
}

}  // namespace unseen::collision
