// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/search/hypotheses.h"

#include <algorithm>
#include <cmath>

namespace unseen::cuboids {
namespace {

constexpr double kFacesUp = 0.7;  // cosine: such a face can carry, or be carried
constexpr double kRoomBeside = 2.5;  // tolerances: a face with less room ends where it was seen to, and grows beside nothing

/// Everything that the proposals of one scene share.
struct Proposer {
  const Problem& problem;
  const Rooms& rooms;
  std::vector<ConvexSolid> solids;
  std::vector<std::vector<int>> above;  ///< a body: those that rest on it or stand over it, directly
  std::vector<Hypothesis> found;

  const OrientedBox& box(int body) const { return problem.cuboid(body).initial; }
  double room(int body, int face) const { return rooms[body - problem.supports_count()][face]; }
  double tolerance(int a, int b) const { return problem.pair_tolerance(std::min(a, b), std::max(a, b)); }

  std::optional<double> reach_of(int mover, const OrientedBox& from, int face, int to) const {
    return problem.is_support(to) ? reach(from, face, problem.supports[to])
                                  : reach(from, face, solids[to - problem.supports_count()], tolerance(mover, to));
  }
  void add(int a, int b, ContactKind kind, std::vector<FaceMove> moves) {
    found.push_back({std::min(a, b), std::max(a, b), kind, std::move(moves)});
  }
};

/// The face of a box that looks up (or down) most; none if it is too slanted to carry.
std::optional<int> level_face(const OrientedBox& box, double sign) {
  for (int face = 0; face < 6; ++face)
    if (sign * face_normal(box, face).z() > kFacesUp) return face;
  return std::nullopt;
}

double top(const OrientedBox& box) {
  return box.center.z() + (box.axes.row(2).transpose().cwiseAbs().cwiseProduct(box.half_size)).sum();
}
double bottom(const OrientedBox& box) { return 2.0 * box.center.z() - top(box); }

/// Moves of one face that make a touch b.
void propose_direct(Proposer& p, int a, int b, std::vector<FaceMove>& candidates) {
  for (int face = 0; face < 6; ++face) {
    if (p.room(a, face) <= 0.0) continue;
    const auto length = p.reach_of(a, p.box(a), face, b);
    if (!length || *length <= 0.0 || *length > p.room(a, face) + p.tolerance(a, b)) continue;  // a touch needs no more
    candidates.push_back({a, face, *length});
  }
}

double far_end(const OrientedBox& box, const Vec3& direction) {
  return direction.dot(box.center) + (box.axes.transpose() * direction).cwiseAbs().dot(box.half_size);
}

/// A body with all that stands on it.
struct Load {
  Vec3 center = Vec3::Zero();  ///< of mass
  std::vector<int> bodies;
};
Load load_of(const Proposer& p, int body) {
  Load load;
  load.bodies = {body};
  for (std::size_t i = 0; i < load.bodies.size(); ++i)
    for (const int next : p.above[load.bodies[i]])
      if (std::find(load.bodies.begin(), load.bodies.end(), next) == load.bodies.end()) load.bodies.push_back(next);
  double mass = 0.0;
  for (const int i : load.bodies) {
    const double m = p.problem.cuboid(i).density * p.box(i).volume();
    load.center += m * p.box(i).center;
    mass += m;
  }
  load.center /= mass;
  return load;
}

/// How far beyond a centre of mass an edge must lie for the body to bear the push.
double lever(const Proposer& p, const Vec3& center, double floor) {
  return p.problem.push * std::max(0.0, center.z() - floor);
}

/// Places along its normal to which a face of a carrier moves to bear another body just so, to reach under its centre of
/// mass, under that of all its load, and under the far ends of both.
std::vector<double> ends_under(const Proposer& p, const OrientedBox& carrier, int face, int upper, double overlap) {
  const Vec3 direction = face_normal(carrier, face);
  const OrientedBox& box = p.box(upper);
  const Load load = load_of(p, upper);
  const double floor = top(carrier);
  double end = far_end(box, direction);
  for (const int i : load.bodies) end = std::max(end, far_end(p.box(i), direction));
  return {-far_end(box, -direction) + overlap, direction.dot(box.center) + lever(p, box.center, floor),
          direction.dot(load.center) + lever(p, load.center, floor), far_end(box, direction), end};
}

/// The same for the upper body: over the near end, the middle and the far end of its carrier, and to where its own foot
/// bears its load (its weight grows along: half of the growth goes with it).
std::vector<double> ends_over(const Proposer& p, int upper, int face, int lower, double overlap) {
  const OrientedBox& box = p.box(upper);
  const Vec3 direction = face_normal(box, face);
  const Load load = load_of(p, upper);
  const double now = far_end(box, direction);
  const double foot = direction.dot(load.center) + lever(p, load.center, bottom(box)) - now;
  std::vector<double> ends = {now + foot, now + 2.0 * foot};
  if (p.problem.is_support(lower)) return ends;
  const OrientedBox& carrier = p.box(lower);
  ends.insert(ends.end(), {-far_end(carrier, -direction) + overlap, direction.dot(carrier.center), far_end(carrier, direction)});
  return ends;
}

/// `mover` grows sideways so that `upper` comes to rest on `lower` (one of them is the mover), or rests more surely; the
/// gap that is left between them closes downward, or upward.
void propose_sideways(Proposer& p, int lower, int upper, int mover) {
  const double overlap = p.tolerance(lower, upper);
  const bool support = p.problem.is_support(lower);
  const auto down = level_face(p.box(upper), -1.0);
  std::optional<int> up;
  if (!support) up = level_face(p.box(lower), 1.0);
  if (!down || (!support && !up)) return;
  for (int face = 0; face < 6; ++face) {
    if (std::abs(face_normal(p.box(mover), face).z()) > 1.0 - kFacesUp || p.room(mover, face) <= 0.0) continue;
    std::vector<double> ends = mover == lower ? ends_under(p, p.box(lower), face, upper, overlap) : ends_over(p, upper, face, lower, overlap);
    std::sort(ends.begin(), ends.end());
    double last = 0.0;
    for (const double end : ends) {
      const double length = end - far_end(p.box(mover), face_normal(p.box(mover), face));
      if (length < last + 0.5 * overlap || length > p.room(mover, face)) continue;
      last = length;
      const OrientedBox grown = extended(p.box(mover), face, length);
      const auto gap = mover == upper ? p.reach_of(upper, grown, *down, lower) : reach(p.box(upper), *down, solid_of(grown), overlap);
      if (!gap) continue;
      const FaceMove sideways = {mover, face, length};
      if (*gap <= overlap) {
        p.add(lower, upper, ContactKind::touching, {sideways});
        continue;
      }
      if (*gap <= p.room(upper, *down)) p.add(lower, upper, ContactKind::touching, {sideways, {upper, *down, *gap}});
      if (up && *gap <= p.room(lower, *up)) p.add(lower, upper, ContactKind::touching, {sideways, {lower, *up, *gap}});
    }
  }
}

/// `mover` grows along one face until it lies beside `other`, which another of its faces then touches.
void propose_beside(Proposer& p, int mover, int other) {
  const double overlap = p.tolerance(mover, other);
  for (int face = 0; face < 6; ++face) {
    if (p.room(mover, face) <= kRoomBeside * p.problem.tolerance[mover - p.problem.supports_count()]) continue;
    const Vec3 direction = face_normal(p.box(mover), face);
    const OrientedBox& box = p.box(other);
    const double start = far_end(p.box(mover), direction);
    double last = 0.0;
    for (const double end : {-far_end(box, -direction) + 2.0 * overlap, far_end(box, direction)}) {
      const double length = end - start;
      if (length < last + overlap || length > p.room(mover, face)) continue;
      last = length;
      const auto meet = interface_of(solid_of(extended(p.box(mover), face, length)), p.solids[other - p.problem.supports_count()], overlap);
      if (!meet || meet->gap < -overlap || std::abs(meet->normal.dot(direction)) > kFacesUp) continue;
      p.add(mover, other, ContactKind::touching, {{mover, face, length}});
      p.add(mover, other, ContactKind::fixed, {{mover, face, length}});
    }
  }
}

/// Who stands on whom if every box came straight down to what is nearest below it.
std::vector<std::vector<int>> bodies_above(const Proposer& p) {
  std::vector<std::vector<int>> above(p.problem.bodies());
  for (int upper = p.problem.supports_count(); upper < p.problem.bodies(); ++upper) {
    const auto down = level_face(p.box(upper), -1.0);
    if (!down) continue;
    std::vector<std::pair<double, int>> below;
    for (int lower = 0; lower < p.problem.bodies(); ++lower)
      if (const auto gap = lower == upper ? std::nullopt : p.reach_of(upper, p.box(upper), *down, lower)) below.emplace_back(*gap, lower);
    std::sort(below.begin(), below.end());
    for (const auto& [gap, lower] : below)
      if (gap <= below.front().first + p.problem.tolerance[upper - p.problem.supports_count()]) above[lower].push_back(upper);
  }
  return above;
}

void propose_pair(Proposer& p, int a, int b, bool touches) {
  const bool support = p.problem.is_support(a);
  if (touches) p.add(a, b, ContactKind::fixed, {});
  std::vector<FaceMove> moves;
  if (!touches) {
    propose_direct(p, b, a, moves);
    if (!support) propose_direct(p, a, b, moves);
    for (const FaceMove& move : moves) p.add(a, b, ContactKind::touching, {move});
    const auto shortest = std::min_element(moves.begin(), moves.end(),
                                           [](const FaceMove& m, const FaceMove& n) { return m.length < n.length; });
    if (shortest != moves.end()) p.add(a, b, ContactKind::fixed, {*shortest});
  }
  if (support) return propose_sideways(p, a, b, b);
  if (!touches) {
    propose_beside(p, a, b);
    propose_beside(p, b, a);
  }
  for (const auto& [lower, upper] : {std::pair{a, b}, std::pair{b, a}}) {
    if (bottom(p.box(upper)) < top(p.box(lower)) - p.tolerance(a, b)) continue;
    propose_sideways(p, lower, upper, lower);
    propose_sideways(p, lower, upper, upper);
  }
}

}  // namespace

std::vector<Hypothesis> propose_contacts(const Problem& problem, const Rooms& rooms) {
  const Arrangement initial = arrange(problem, {});
  Proposer p{problem, rooms, initial.solids, {}, {}};
  p.above = bodies_above(p);
  std::vector<std::vector<char>> touches(problem.bodies(), std::vector<char>(problem.bodies(), 0));
  for (const Touch& touch : touching_pairs(problem, initial)) touches[touch.a][touch.b] = 1;
  for (int a = 0; a < problem.bodies(); ++a)
    for (int b = std::max(a + 1, problem.supports_count()); b < problem.bodies(); ++b)
      if (!problem.is_one_object(a, b)) propose_pair(p, a, b, touches[a][b]);
  return std::move(p.found);
}

}  // namespace unseen::cuboids
