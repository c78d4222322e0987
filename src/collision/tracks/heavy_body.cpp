// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/heavy_body.h"

#include <algorithm>
#include <cmath>

namespace unseen::collision {
namespace {

constexpr std::size_t kMostPushes = 6;  // that are looked at, the best
constexpr double kAtPush = 0.75;        // frame times around it whose points are left out
constexpr double kTouchingBalls = 0.6, kTouchingOthers = 0.85;  // of the sum of the diameters that the centres may be apart
constexpr double kLeastApart = 0.15;    // of that sum: nearer together, the direction to the other tells nothing
constexpr double kAway = 0.6;           // cosine between the push and the direction away from the heavy body
constexpr double kSeenChange = 5.0;     // σ: a change of the heavy body's velocity that large is seen, and
constexpr double kAgainst = -0.3;       // its cosine to the push
constexpr double kLighter = 0.5;        // of the light body's change, that of the heavy one is less
constexpr double kUnlikeSides = 6.0;    // σ² between the looks of the heavy body before and after
constexpr std::ptrdiff_t kFewestOfSide = 4;  // points that are one body alone

/// A body that something pushes.
struct Push {
  Link link;
  Joint joint;
};

/// Changes of velocity that are no noise, those between the longest arcs first.
std::vector<Push> pushes_of(const std::vector<Arc>& arcs, double noise, double fps) {
  std::vector<Push> pushes;
  for (const Link& link : links_of(arcs, noise, kLongestGap * fps))
    if (const Joint joint = own_joint(link, noise); joint.sudden) pushes.push_back({link, joint});
  const auto shorter = [&](const Push& p) { return std::min(arcs[p.link.before].points.size(), arcs[p.link.after].points.size()); };
  std::stable_sort(pushes.begin(), pushes.end(), [&](const Push& a, const Push& b) { return shorter(a) > shorter(b); });
  if (pushes.size() > kMostPushes) pushes.resize(kMostPushes);
  return pushes;
}

/// Arcs of what is seen before, or after, frame time `u`.
std::vector<Arc> arcs_beside(Candidates candidates, double u, bool before, double noise, double jitter, Context& context) {
  for (auto& frame : candidates) std::erase_if(frame, [&](const Candidate& c) { return before ? c.u > u - kAtPush : c.u < u + kAtPush; });
  return find_arcs(candidates, noise, jitter, context);
}

/// Whether the heavy body is where it can have pushed the other, away from itself, and shows no more of it than it can. `touching`: share of the sum of the diameters.
bool can_push(const Push& push, const Link& heavy, double touching, double noise) {
  const double u = push.joint.u, reach = push.link.diameter + heavy.diameter;
  const Joint joint = joint_at(u, heavy.curve_before, heavy.curve_after, noise, heavy.diameter);
  if (push.link.diameter <= 0.0 || heavy.diameter <= 0.0 || joint.apart > joint.tolerance) return false;
  const auto place = [u](const Link& link) { return Vec2(0.5 * (link.curve_before.at(u) + link.curve_after.at(u))); };
  const Vec2 from = place(push.link) - place(heavy), change = push.joint.change;
  if (from.norm() > touching * reach + 4.0 * noise) return false;
  if (from.norm() > kLeastApart * reach && from.dot(change) < kAway * from.norm() * change.norm()) return false;
  if (joint.change.norm() > kLighter * change.norm()) return false;
  const double sigma = noise * std::sqrt(heavy.curve_before.velocity_variance_at(u) + heavy.curve_after.velocity_variance_at(u));
  return joint.change.norm() < kSeenChange * sigma || joint.change.dot(change) < kAgainst * joint.change.norm() * change.norm();
}

}  // namespace

std::optional<HeavyHits> find_heavy_hits(const Shot& shot, const Candidates& candidates, const std::vector<Arc>& arcs, double noise, double jitter, double fps,
                                         Context& context) {
  const bool balls = shot.bodies[0].shape == Shape::sphere && shot.bodies[1].shape == Shape::sphere;
  for (const Push& push : pushes_of(arcs, noise, fps)) {
    const double u = push.joint.u;
    const bool beside = std::any_of(arcs.begin(), arcs.end(), [&](const Arc& arc) { return arc.begin() < u - kAtPush && arc.end() > u + kAtPush; });
    if (!beside) continue;
    HeavyHits hits{{arcs[push.link.before], arcs[push.link.after]}, {}};
    Push light = push;
    light.link.before = 0, light.link.after = 1;
    const auto add = [&](bool before) {
      std::vector<Arc> some = arcs_beside(candidates, u, before, noise, jitter, context);
      hits.arcs.insert(hits.arcs.end(), some.begin(), some.end());
      return hits.arcs.size();
    };
    const std::size_t middle = add(true), end = add(false);
    for (std::size_t i = 2; i < middle; ++i)
      for (std::size_t j = middle; j < end; ++j) {
        Link heavy = link_of(hits.arcs[i], hits.arcs[j], noise);
        heavy.before = i, heavy.after = j;
        heavy.unlike = unlikeness(looks_of(hits.arcs[i]), looks_of(hits.arcs[j]));
        if (heavy.unlike > kUnlikeSides || !can_push(light, heavy, balls ? kTouchingBalls : kTouchingOthers, noise)) continue;
        Collision hit{light.link, heavy, u, 0.0};
        bool alone = true;
        for (const std::size_t k : hit.arcs()) {
          const std::ptrdiff_t points = count_alone(hits.arcs[k], k < 2 ? heavy : light.link, candidates);
          alone = alone && points >= kFewestOfSide;
          hit.score += static_cast<double>(points);
        }
        if (alone) hits.found.push_back(hit);
      }
    if (hits.found.empty()) continue;
    std::stable_sort(hits.found.begin(), hits.found.end(), [](const Collision& x, const Collision& y) { return x.score > y.score; });
    return hits;
  }
  return std::nullopt;
}

}  // namespace unseen::collision
