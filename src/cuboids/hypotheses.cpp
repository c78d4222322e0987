// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/hypotheses.h"

#include <algorithm>
#include <cmath>

namespace unseen::cuboids {
namespace {

constexpr double kFacesUp = 0.7;  // cosine: such a face can carry, or be carried

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

  std::optional<double> reach_of(const OrientedBox& from, int face, int to) const {
    return problem.is_support(to) ? reach(from, face, problem.supports[to])
                                  : reach(from, face, solids[to - problem.supports_count()]);
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
    const auto length = p.reach_of(p.box(a), face, b);
    if (!length || *length <= 0.0 || *length > p.room(a, face)) continue;
    candidates.push_back({a, face, *length});
  }
}

/// Lengths by which a face moves until it covers the near end, the middle or the far end of a span along its normal.
std::vector<double> spans(const OrientedBox& box, int face, const OrientedBox& other, const std::vector<Vec3>& targets,
                          double overlap) {
  const Vec3 direction = face_normal(box, face);
  const double start = direction.dot(box.center) + box.half_size[face / 2];
  const double middle = direction.dot(other.center);
  const double half = (other.axes.transpose() * direction).cwiseAbs().dot(other.half_size);
  std::vector<double> lengths = {middle - half + overlap - start, middle + half - start};
  for (const Vec3& target : targets) lengths.push_back(direction.dot(target) - start);
  std::sort(lengths.begin(), lengths.end());
  return lengths;
}

/// Centres of mass that a carrier has to reach under: of the body, and of it with all that stands on it.
std::vector<Vec3> loads_of(const Proposer& p, int body) {
  std::vector<int> load = {body};
  for (std::size_t i = 0; i < load.size(); ++i)
    for (const int next : p.above[load[i]])
      if (std::find(load.begin(), load.end(), next) == load.end()) load.push_back(next);
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (const int i : load) {
    const double m = p.problem.cuboid(i).density * p.box(i).volume();
    sum += m * p.box(i).center;
    mass += m;
  }
  return {p.box(body).center, sum / mass};
}

/// `mover` grows sideways so that `upper` comes to rest on `lower` (one of them is the mover); the gap that is left
/// between them closes downward.
void propose_sideways(Proposer& p, int lower, int upper, int mover) {
  const int other = mover == lower ? upper : lower;
  const double overlap = p.tolerance(lower, upper);
  const auto down = level_face(p.box(upper), -1.0);
  if (!down) return;
  const std::vector<Vec3> targets = mover == lower ? loads_of(p, upper) : std::vector<Vec3>{p.box(lower).center};
  for (int face = 0; face < 6; ++face) {
    if (std::abs(face_normal(p.box(mover), face).z()) > 1.0 - kFacesUp || p.room(mover, face) <= 0.0) continue;
    double last = 0.0;
    for (const double length : spans(p.box(mover), face, p.box(other), targets, overlap)) {
      if (length < last + 0.5 * overlap || length > p.room(mover, face)) continue;
      last = length;
      Extension extension{};
      extension[face] = length;
      const OrientedBox grown = extended(p.box(mover), extension);
      const OrientedBox& from = mover == upper ? grown : p.box(upper);
      const auto gap = mover == upper ? p.reach_of(from, *down, lower) : reach(from, *down, solid_of(grown));
      if (!gap) continue;
      std::vector<FaceMove> moves = {{mover, face, length}};
      if (*gap > overlap) {
        if (*gap > p.room(upper, *down)) continue;
        moves.push_back({upper, *down, *gap});
      }
      p.add(lower, upper, ContactKind::touching, std::move(moves));
    }
  }
}

void propose_pair(Proposer& p, int a, int b, bool touches) {
  const bool support = p.problem.is_support(a);
  if (touches) {
    p.add(a, b, ContactKind::fixed, {});
  }
  std::vector<FaceMove> moves;
  if (!touches) {
    propose_direct(p, b, a, moves);
    if (!support) propose_direct(p, a, b, moves);
    for (const FaceMove& move : moves) p.add(a, b, ContactKind::touching, {move});
    const auto shortest = std::min_element(moves.begin(), moves.end(),
                                           [](const FaceMove& m, const FaceMove& n) { return m.length < n.length; });
    if (shortest != moves.end()) p.add(a, b, ContactKind::fixed, {*shortest});
  }
  if (support) return;
  for (const auto& [lower, upper] : {std::pair{a, b}, std::pair{b, a}}) {
    if (bottom(p.box(upper)) < top(p.box(lower)) - p.tolerance(a, b)) continue;
    propose_sideways(p, lower, upper, lower);
    propose_sideways(p, lower, upper, upper);
  }
}

}  // namespace

std::vector<Hypothesis> propose_contacts(const Problem& problem, const Rooms& rooms) {
  const Arrangement initial = arrange(problem, {});
  Proposer p{problem, rooms, initial.solids, std::vector<std::vector<int>>(problem.bodies()), {}};
  std::vector<std::vector<char>> touches(problem.bodies(), std::vector<char>(problem.bodies(), 0));
  for (const Touch& touch : touching_pairs(problem, initial)) {
    touches[touch.a][touch.b] = 1;
    if (std::abs(touch.interface.normal.z()) < kFacesUp || problem.is_support(touch.a)) continue;
    const bool up = touch.interface.normal.z() > 0;
    p.above[up ? touch.a : touch.b].push_back(up ? touch.b : touch.a);
  }
  for (int a = 0; a < problem.bodies(); ++a)
    for (int b = std::max(a + 1, problem.supports_count()); b < problem.bodies(); ++b)
      propose_pair(p, a, b, touches[a][b]);
  return std::move(p.found);
}

}  // namespace unseen::cuboids
