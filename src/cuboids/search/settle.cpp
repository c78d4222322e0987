// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "cuboids/search/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kExactly = 0.03;   // tolerances
constexpr double kNoSliding = 10.0; // friction: what settles rocks and drops
constexpr double kFarthestCorner = 3.0;  // tolerances that a corner may go
constexpr int kMostSteps = 20000;   // times bodies

/// The rigid velocity with which a group collapses, up to one factor for all.
struct Velocity {
  Vec3 center, linear, angular;
  Vec3 at(const Vec3& p) const { return linear + angular.cross(p - center); }
};

/// Empty if all is at rest.
std::vector<Velocity> collapse_of(const Structure& s) {
  const Balance b = balance(s.bodies, s.contacts);
  if (std::all_of(b.motion.begin(), b.motion.end(), [](const Vec6& m) { return m.norm() < kAtRest; })) return {};
  std::vector<Velocity> velocities;
  for (int g = 0; g < static_cast<int>(s.bodies.size()); ++g)
    velocities.push_back({s.bodies[g].center, b.velocity(g, s.bodies[g]), b.angular_velocity(g, s.bodies[g])});
  return velocities;
}

/// The time until two bodies that are apart first meet.
double time_to_contact(const Problem& exact, const std::vector<Touch>& near, const std::vector<int>& group, const std::vector<Velocity>& velocities) {
  double least = std::numeric_limits<double>::infinity();
  for (const Touch& touch : near)
    for (std::size_t i = 0; i < touch.interface.points.size(); ++i) {
      const Vec3& p = touch.interface.points[i];
      const double closing = touch.interface.normal.dot(velocities[group[touch.a]].at(p) - velocities[group[touch.b]].at(p));
      const double gap = touch.interface.gaps[i];
      if (closing > 0.0 && gap > exact.pair_tolerance(touch.a, touch.b)) least = std::min(least, gap / closing);
    }
  return least;
}

OrientedBox moved(OrientedBox box, const Velocity& v, double time) {
  const double angle = time * v.angular.norm();
  const Mat3 turn = angle > 0.0 ? Eigen::AngleAxisd(angle, v.angular.normalized()).toRotationMatrix() : Mat3(Mat3::Identity());
  box.center = v.center + turn * (box.center - v.center) + time * v.linear;
  box.axes = turn * box.axes;
  return box;
}

double farthest_corner(const ConvexSolid& from, const ConvexSolid& to) {
  double farthest = 0;
  for (std::size_t k = 0; k < from.vertices.size(); ++k) farthest = std::max(farthest, (to.vertices[k] - from.vertices[k]).norm());
  return farthest;
}

/// The time in which no corner goes farther than a tolerance.
double time_of_small_moves(const Problem& problem, const Arrangement& arrangement, const std::vector<int>& group,
                           const std::vector<Velocity>& velocities) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < arrangement.solids.size(); ++i)
    for (const Vec3& corner : arrangement.solids[i].vertices) {
      const double speed = velocities[group[problem.supports_count() + i]].at(corner).norm();
      if (speed > 0.0) least = std::min(least, problem.tolerance[i] / speed);
    }
  return least;
}

}  // namespace

Problem as_written(const Problem& problem) {
  Problem exact = problem;
  for (double& tolerance : exact.tolerance) tolerance *= kExactly;
  if (!exact.supports.empty()) exact.supports.front().outline.clear();  // the ground goes on where it was not seen
  return exact;
}

void settle(const Problem& problem, const std::vector<char>& held, Arrangement& arrangement, Context& context) {
  Problem exact = as_written(problem);
  exact.friction = kNoSliding;
  const int first = problem.supports_count();
  std::vector<char> stays = held;
  Arrangement now = arrangement;
  for (int work = 0; work < kMostSteps; work += problem.bodies()) {
    context.check();
    const Structure s = structure_of(exact, now, touching_pairs(exact, now), stays);
    const std::vector<Velocity> velocities = collapse_of(s);
    if (velocities.empty()) {
      Arrangement closed = now;
      close_contacts(exact, touching_pairs(exact, now), closed);
      if (collapse_of(structure_of(exact, closed, touching_pairs(exact, closed), stays)).empty()) now = std::move(closed);
      if (stands(problem, now, held) || !stands(problem, arrangement, held)) arrangement = std::move(now);
      return;
    }
    const double time = std::min(time_of_small_moves(problem, now, s.group, velocities),
                                 time_to_contact(exact, touching_pairs(problem, now), s.group, velocities));
    bool too_far = false;
    for (std::size_t i = 0; i < now.boxes.size(); ++i) {
      const Velocity& v = velocities[s.group[first + i]];
      if (v.linear.isZero() && v.angular.isZero()) continue;
      now.boxes[i] = moved(now.boxes[i], v, time);
      now.solids[i] = solid_of(now.boxes[i]);
      if (farthest_corner(arrangement.solids[i], now.solids[i]) < kFarthestCorner * problem.tolerance[i]) continue;
      stays[first + i] = 1;
      too_far = true;
    }
    if (too_far) now = arrangement;
  }
}

}  // namespace unseen::cuboids
