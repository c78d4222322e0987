// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/meeting_in_space.h"

#include <algorithm>
#include <limits>

#include "collision/shot_problem.h"
#include "collision/solve/linear_flights.h"

namespace unseen::collision {
namespace {

constexpr std::size_t kMostPoints = 40;  // of a flight: more tell the time no better
constexpr double kStep = 0.5;            // frame times
constexpr double kTilt = 0.1;            // rad

void add_flight(const Arc& arc, int body, double fps, Tracks& tracks) {
  const std::size_t first = tracks.points.size(), count = std::min(kMostPoints, arc.points.size());
  for (std::size_t i = 0; i < count; ++i) {
    const Candidate& c = arc.points[(2 * i + 1) * arc.points.size() / (2 * count)];
    tracks.points.push_back({body, c.file_frame(), c.u / fps, c.pixel, c.diameter, c.region});
  }
  tracks.spans.push_back({body, first, tracks.points.size()});
}

/// At one time; `misfit` is the sum over all sightings.
std::optional<SpaceMeeting> meeting_at(const Problem& problem, double u, double fps) {
  SpaceMeeting meeting;
  meeting.u = u;
  meeting.least_change = std::numeric_limits<double>::infinity();
  Vec2 change[2];
  for (int body = 0; body < 2; ++body) {
    const auto flight = linear_flight(problem, body, u / fps);
    if (!flight) return std::nullopt;
    meeting.misfit += misfit(problem, *flight, body, u / fps);
    meeting.pixels[static_cast<std::size_t>(body)] = problem.camera.project(flight->p);
    change[body] = (flight->v_after - flight->v_before).head<2>();
    const double faster = std::max({flight->v_before.head<2>().norm(), flight->v_after.head<2>().norm(), 1e-9});
    meeting.least_change = std::min(meeting.least_change, change[body].norm() / faster);
  }
  meeting.opposed = change[0].normalized().dot(change[1].normalized());
  return meeting;
}

std::optional<SpaceMeeting> best_between(const Problem& problem, double low, double high, double fps) {
  std::optional<SpaceMeeting> best;
  for (double u = low; u <= high; u += kStep) {
    const auto meeting = meeting_at(problem, u, fps);
    if (meeting && (!best || meeting->misfit < best->misfit)) best = meeting;
  }
  return best;
}

}  // namespace

std::optional<SpaceMeeting> meet_in_space(const Shot& shot, const ShotCamera& camera, const std::array<const Arc*, 4>& arcs, double low, double high,
                                          double noise, double fps) {
  Tracks tracks;
  tracks.noise = noise;
  for (std::size_t i = 0; i < 4; ++i) add_flight(*arcs[i], static_cast<int>(i % 2), fps, tracks);
  const std::array<Solid, 2> solids = {solid_of(shot.bodies[0], shot.name), solid_of(shot.bodies[1], shot.name)};
  Problem problem = problem_of(shot, Options{}, camera, solids, tracks, {low / fps, {0, 1}, {2, 3}});
  std::optional<SpaceMeeting> best = best_between(problem, low, high, fps);
  for (const double tilt : {kTilt, 0.5 * kTilt}) {  // the camera may look up or down, or lean
    if (!best || shot.down || problem.planar) break;
    const Vec3 down = problem.down, e1 = any_orthogonal(down), e2 = down.cross(e1);
    Vec3 best_down = down;
    for (const Vec3& side : {e1, e2, Vec3(-e1), Vec3(-e2)}) {
      problem.down = (down + tilt * side).normalized();
      const auto meeting = best_between(problem, low, high, fps);
      if (meeting && meeting->misfit < best->misfit) best = meeting, best_down = problem.down;
    }
    problem.down = best_down;
  }
  if (best) best->misfit /= static_cast<double>(problem.points.size());
  return best;
}

}  // namespace unseen::collision
