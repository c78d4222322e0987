// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/search/collapse.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace unseen::cuboids {
namespace {

constexpr double kResists = 1e-7;  // power of a unit contact force per unit of speed, below which it counts as none

double speed(const Twist& t, const Vec3& center, double size) {
  return t.at(center).norm() + size * t.angular.norm();
}

/// True if a force in the friction cone about `normal` can do negative work; `speeds` of the two tell what is rounding.
bool resists(const Twist& a, const Twist& b, const Vec3& point, const Vec3& normal, double friction, double speeds) {
  const Vec3 velocity = b.at(point) - a.at(point);
  const double along = velocity.dot(normal);
  const double across = (velocity - along * normal).norm();
  return along - friction * across < -kResists * speeds;
}

bool resists(const Twist& a, const Twist& b, const Vec3& point, const Vec3& normal, double friction) {
  return resists(a, b, point, normal, friction, a.at(point).norm() + b.at(point).norm());
}

bool same_motion(const Twist& a, const Twist& b) {
  const double scale = std::max({a.linear.norm(), b.linear.norm(), a.angular.norm(), b.angular.norm()});
  return (a.linear - b.linear).norm() + (a.angular - b.angular).norm() <= kResists * scale;
}

bool any_resists(const Collapse& c, const Problem& problem, const Arrangement& arrangement,
                 const std::vector<Touch>& touches, const std::vector<char>& held) {
  const auto motion = [&](int body) { return problem.is_support(body) || held[body] ? Twist{} : c.motion[body]; };
  const auto speed_of = [&](int body) {  // not of the point that touches: about that the body may turn
    if (motion(body).is_zero()) return 0.0;
    const OrientedBox& box = arrangement.boxes[body - problem.supports_count()];
    return speed(c.motion[body], box.center, box.half_size.norm());
  };
  for (const auto& [a, b] : arrangement.fixed)
    if (!same_motion(motion(a), motion(b))) return true;
  for (const Touch& touch : touches) {
    const Twist a = motion(touch.a), b = motion(touch.b);
    if (a.is_zero() && b.is_zero()) continue;
    const double friction = measured_friction(touch.interface.normal, problem.friction);
    for (const Vec3& point : touch.interface.points)
      if (resists(a, b, point, touch.interface.normal, friction, speed_of(touch.a) + speed_of(touch.b))) return true;
  }
  return false;
}

/// The part of a collapse that moves some bodies only.
Collapse restricted(const Collapse& c, const std::vector<int>& bodies) {
  Collapse out;
  out.gravity = c.gravity;
  out.motion.resize(c.motion.size());
  for (const int body : bodies) out.motion[body] = c.motion[body];
  return out;
}

/// Moving bodies that touch or are fixed, together.
std::vector<std::vector<int>> moving_groups(const Collapse& c, const Arrangement& arrangement,
                                            const std::vector<Touch>& touches) {
  std::vector<int> parent(c.motion.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int i) {
    while (parent[i] != i) i = parent[i];
    return i;
  };
  const auto join = [&](int a, int b) {
    if (!c.motion[a].is_zero() && !c.motion[b].is_zero()) parent[std::max(root(a), root(b))] = std::min(root(a), root(b));
  };
  for (const Touch& touch : touches) join(touch.a, touch.b);
  for (const auto& [a, b] : arrangement.fixed) join(a, b);
  std::vector<std::vector<int>> groups(c.motion.size());
  for (std::size_t i = 0; i < c.motion.size(); ++i)
    if (!c.motion[i].is_zero()) groups[root(static_cast<int>(i))].push_back(static_cast<int>(i));
  std::erase_if(groups, [](const auto& g) { return g.empty(); });
  return groups;
}

}  // namespace

double proven_residual(const Collapse& c, const Problem& problem, const Arrangement& arrangement,
                       const std::vector<Touch>& touches, const std::vector<char>& held) {
  if (any_resists(c, problem, arrangement, touches, held)) return 0.0;
  // Power of gravity over the largest power that unbalanced forces and torques of relative size 1 could have. A group
  // of fixed bodies is judged as a whole, which is never less than the sum over its members.
  double power = 0.0, most = 0.0;
  for (int i = problem.supports_count(); i < problem.bodies(); ++i) {
    if (held[i] || c.motion[i].is_zero()) continue;
    const OrientedBox& box = arrangement.boxes[i - problem.supports_count()];
    const double weight = problem.cuboid(i).density * box.volume();
    power += weight * c.motion[i].at(box.center).dot(c.gravity);
    most += weight * speed(c.motion[i], box.center, box.half_size.norm());
  }
  return most > 0.0 ? std::max(0.0, power / most) : 0.0;
}

Collapse motion_left(const Balance& balance, const Vec3& gravity, const Structure& structure, const Problem& problem) {
  Collapse whole;
  whole.gravity = gravity;
  whole.motion.resize(problem.bodies());
  double fastest = 0.0;
  for (const Vec6& v : balance.motion) fastest = std::max(fastest, v.norm());
  for (int i = problem.supports_count(); i < problem.bodies(); ++i) {
    const int g = structure.group[i];
    const Body& body = structure.bodies[g];
    if (body.is_static || balance.motion[g].norm() < 1e-6 * fastest) continue;
    Twist& t = whole.motion[i];
    t.angular = balance.angular_velocity(g, body);
    t.linear = balance.velocity(g, body) - t.angular.cross(body.center);
  }
  return whole;
}

std::vector<Collapse> collapses_of(const Collapse& whole, const Problem& problem, const Arrangement& arrangement,
                                   const std::vector<Touch>& touches, const std::vector<char>& held) {
  const auto proves = [&](const Collapse& c) {
    return proven_residual(c, problem, arrangement, touches, held) >= problem.stable_residual;
  };
  std::vector<Collapse> out;
  for (const std::vector<int>& group : moving_groups(whole, arrangement, touches)) {
    const std::size_t before = out.size();
    for (const int body : group) {
      const Collapse alone = restricted(whole, {body});
      if (group.size() > 1 && proves(alone)) out.push_back(alone);
    }
    if (out.size() > before) continue;
    const Collapse together = restricted(whole, group);
    if (proves(together)) out.push_back(together);
  }
  if (out.empty() && proves(whole)) out.push_back(whole);
  return out;
}

namespace {

/// Whether the weights of extensions alone could turn the collapse into one that gravity does not drive.
bool weight_may_help(const Collapse& c, const Problem& problem, const Arrangement& arrangement, const Arrangement& largest,
                     const std::vector<char>& held) {
  double power = 0.0, most = 0.0;
  for (int i = problem.supports_count(); i < problem.bodies(); ++i) {
    if (held[i] || c.motion[i].is_zero()) continue;
    const int k = i - problem.supports_count();
    const double density = problem.cuboid(i).density;
    const OrientedBox &now = arrangement.boxes[k], &full = largest.boxes[k];
    power += density * now.volume() * c.motion[i].at(now.center).dot(c.gravity);
    const double added = density * (full.volume() - now.volume());
    double lowest = 0.0;  // power of the added weight where it hinders most
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 p = full.center + full.axes * Vec3((corner & 1 ? 1 : -1) * full.half_size.x(), (corner & 2 ? 1 : -1) * full.half_size.y(),
                                                    (corner & 4 ? 1 : -1) * full.half_size.z());
      lowest = std::min(lowest, c.motion[i].at(p).dot(c.gravity));
    }
    power += added * lowest;
    most += density * full.volume() * (speed(c.motion[i], now.center, full.half_size.norm()) +
                                       c.motion[i].angular.norm() * (full.center - now.center).norm());
  }
  return power < problem.stable_residual * most;
}

/// True if a contact between a region of a body's box and another body, with the given normal (from the body to the
/// other; without sign if `both`), could do negative work somewhere in the region.
bool region_resists(const OrientedBox& region, const Twist& mine, const Twist& others, const Vec3& normal, bool both,
                    double friction) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p = region.center + region.axes * Vec3((corner & 1 ? 1 : -1) * region.half_size.x(), (corner & 2 ? 1 : -1) * region.half_size.y(),
                                                      (corner & 4 ? 1 : -1) * region.half_size.z());
    if (resists(mine, others, p, normal, friction) || (both && resists(mine, others, p, -normal, friction))) return true;
  }
  return false;
}

/// The part of `box` between two places along one of its axes.
OrientedBox slice(const OrientedBox& box, int axis, double low, double high) {
  OrientedBox out = box;
  const double middle = box.axes.col(axis).dot(box.center);
  out.center += (0.5 * (low + high) - middle) * box.axes.col(axis);
  out.half_size[axis] = 0.5 * (high - low);
  return out;
}

double low_end(const OrientedBox& box, int axis) { return box.axes.col(axis).dot(box.center) - box.half_size[axis]; }
double high_end(const OrientedBox& box, int axis) { return box.axes.col(axis).dot(box.center) + box.half_size[axis]; }

/// Whether the contacts that a move may bring, with whatever else is moved, can resist: at the moved face, or beside it
/// where another face stays but the box has become wider.
bool move_may_help(const FaceMove& move, int other, const Problem& problem, const Arrangement& arrangement,
                   const Arrangement& largest, const Twist& mine, const Twist& others) {
  const int k = move.body - problem.supports_count(), axis = move.face / 2;
  const double tolerance = problem.pair_tolerance(std::min(other, move.body), std::max(other, move.body));
  const OrientedBox &start = problem.cuboids[k].initial, &now = arrangement.boxes[k], &full = largest.boxes[k];
  const auto meets = [&](const OrientedBox& region) {
    return problem.is_support(other) ? interface_of(problem.supports[other], solid_of(region), tolerance).has_value()
                                     : interface_of(solid_of(region), largest.solids[other - problem.supports_count()], tolerance).has_value();
  };
  const bool positive = move.face % 2 == 1;
  const double from = positive ? high_end(start, axis) : low_end(start, axis);
  const double to = positive ? from + move.length : from - move.length;
  const Vec3 outward = face_normal(start, move.face);
  const OrientedBox end = slice(full, axis, to - 0.5 * tolerance, to + 0.5 * tolerance);
  if (meets(end) && region_resists(end, mine, others, outward, false, measured_friction(outward, problem.friction)))
    return true;
  const OrientedBox grown = slice(full, axis, std::min(from, to), std::max(from, to));
  for (int side = 0; side < 3; ++side) {
    if (side == axis) continue;
    const Vec3 normal = start.axes.col(side);
    const OrientedBox beside = slice(grown, side, low_end(now, side), high_end(now, side));
    if (meets(beside) && region_resists(beside, mine, others, normal, true, measured_friction(normal, problem.friction)))
      return true;
  }
  return false;
}

}  // namespace

std::vector<int> remedies(const Collapse& c, const Problem& problem, const Arrangement& arrangement,
                          const Arrangement& largest, const std::vector<char>& held, const std::vector<char>& closed) {
  const auto motion = [&](int body) { return problem.is_support(body) || held[body] ? Twist{} : c.motion[body]; };
  const bool weight = weight_may_help(c, problem, arrangement, largest, held);
  const auto helps = [&](const Hypothesis& h) {
    if (h.kind == ContactKind::fixed && !same_motion(motion(h.a), motion(h.b))) return true;
    for (const FaceMove& move : h.moves) {
      if (weight && !motion(move.body).is_zero()) return true;
      for (int other = 0; other < problem.bodies(); ++other)
        if (other != move.body && !same_motion(motion(other), motion(move.body)) &&
            move_may_help(move, other, problem, arrangement, largest, motion(move.body), motion(other)))
          return true;
    }
    return false;
  };
  std::vector<int> out;
  for (std::size_t h = 0; h < problem.hypotheses.size(); ++h)
    if (!closed[h] && helps(problem.hypotheses[h])) out.push_back(static_cast<int>(h));
  return out;
}

}  // namespace unseen::cuboids
