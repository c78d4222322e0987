// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/frames.h"

#include <algorithm>
#include <cmath>

#include "collision/solve/unknowns.h"

namespace unseen::collision {
namespace {

double time_of(const SolvedImpact& impact) { return impact.solution.fit.state.time; }

BodyState between(const SolvedImpact& one, const SolvedImpact& next, const Mat3& to_world, int o, double time) {
  const double length = time_of(next) - time_of(one), x = std::clamp((time - time_of(one)) / length, 0.0, 1.0);
  const double share = x * x * (3.0 - 2.0 * x), rate = 6.0 * x * (1.0 - x) / length;
  const BodyState a = body_at(one, to_world, o, true, time), b = body_at(next, to_world, o, false, time);
  BodyState s;
  s.p = (1.0 - share) * a.p + share * b.p;
  s.v = (1.0 - share) * a.v + share * b.v + rate * (b.p - a.p);
  s.k = (1.0 - share) * a.k + share * b.k;
  s.q = a.q.slerp(share, b.q);
  return s;
}

/// Whether the flight after one impact is the flight before the next.
bool is_one_flight(const SolvedImpact& one, const SolvedImpact& next, const Tracks& tracks, int o) {
  const std::vector<int>&after = one.meeting.after, &before = next.meeting.before;
  return time_of(one) < time_of(next) &&
         std::any_of(after.begin(), after.end(), [&](int s) { return tracks.spans[s].body == o && std::count(before.begin(), before.end(), s) > 0; });
}

/// Whether the body was seen to fly before (after) the impact, that early (late).
bool was_seen(const SolvedImpact& impact, const Tracks& tracks, int o, bool after, int frame) {
  const std::vector<int>& spans = after ? impact.meeting.after : impact.meeting.before;
  return std::any_of(spans.begin(), spans.end(), [&](int s) {
    const FlightSpan& span = tracks.spans[s];
    return span.body == o && (after ? tracks.points[span.end - 1].frame >= frame : tracks.points[span.begin].frame <= frame);
  });
}

}  // namespace

BodyState body_at(const SolvedImpact& impact, const Mat3& to_world, int o, bool after, double time) {
  const Problem& problem = impact.solution.problem;
  const State& state = impact.solution.fit.state;
  const StateT<double> s = values_of(problem, state);
  PointState<double> there{s.p[o], Vec3::Zero()};
  if (problem.flies(o, after)) there = fly<double>({s.p[o], after ? s.v_after[o] : s.v[o]}, s.down * problem.gravity, problem.resistance(o), time - s.time);
  const double mass = o == 0 ? 1.0 : s.mass_ratio;
  const Quat q = orientation_at(problem, state, o, after, time);
  BodyState body;
  body.p = to_world * there.p;
  body.v = to_world * there.v;
  body.k = to_world * Vec3(mass * (after ? s.h_after[o] : s.h[o]));
  body.q = (Quat(to_world) * q * problem.solids[o].file_to_principal).normalized();
  return body;
}

std::vector<FramePose> frame_poses(const std::vector<SolvedImpact>& impacts, const Mat3& to_world, const Tracks& tracks, const FrameClock& clock) {
  std::vector<FramePose> poses;
  for (int frame = clock.first(); frame <= clock.last(); ++frame) {
    FramePose pose;
    pose.frame = frame;
    const double time = pose.time = clock.time_at(frame);
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < impacts.size(); ++i)
      if (std::abs(time_of(impacts[i]) - time) < std::abs(time_of(impacts[nearest]) - time)) nearest = i;
    const SolvedImpact& here = impacts[nearest];
    const bool after = time > time_of(here);
    const std::size_t other = after ? nearest + 1 : nearest - 1;  // the impact on the other side, if there is one
    for (int o = 0; o < (here.solution.problem.fixed ? 1 : 2); ++o) {
      if (!was_seen(here, tracks, o, after, frame)) continue;
      pose.bodies[o] = body_at(here, to_world, o, after, time);
      if (other >= impacts.size()) continue;
      const SolvedImpact& there = impacts[other];
      const SolvedImpact &one = after ? here : there, &next = after ? there : here;
      if (!is_one_flight(one, next, tracks, o)) continue;
      if (here.check.fits == there.check.fits) pose.bodies[o] = between(one, next, to_world, o, time);
      else if (there.check.fits) pose.bodies[o] = body_at(there, to_world, o, !after, time);
    }
    if (pose.bodies[0] || pose.bodies[1]) poses.push_back(pose);
  }
  return poses;
}

}  // namespace unseen::collision
