// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <array>
#include <vector>

#include "collision/tracks/arcs.h"
#include "collision/tracks/meetings.h"

namespace unseen::collision {

/// One body's flights before and after an impact.
struct Link {
  std::size_t before = 0, after = 0;  ///< indices of arcs
  Curve curve_before, curve_after;    ///< bent nearly alike, since gravity bends both
  double end = 0, begin = 0;          ///< of the last sighting before, of the first after
  double diameter = 0;
  double unlike = 0;                  ///< σ², before and after
};

/// Two links that one impact explains.
struct Collision {
  Link a, b;
  double u = 0;  ///< frame times
  double score = 0;

  std::array<std::size_t, 4> arcs() const { return {a.before, b.before, a.after, b.after}; }
};

constexpr double kLongestGap = 0.4;  ///< s between two flights of one body, behind something that hides the impact

Link link_of(const Arc& before, const Arc& after, double noise);

/// Points of an arc that are one body alone, beside the `other`.
std::ptrdiff_t count_alone(const Arc& arc, const Link& other, const Candidates& candidates);

/// Where a link alone is nearest to closed.
Joint own_joint(const Link& link, double noise);

/// Pairs of arcs that can be one body's flights before and after an impact, `longest` frame times apart at most; their curves may end `slack` times as far apart as noise explains.
std::vector<Link> links_of(const std::vector<Arc>& arcs, double noise, double longest, double slack = 1.0);

/// The one time at which both links are nearest to closed; NaN if there is none that both allow.
double common_time(const Link& a, const Link& b, double noise);

/// Whether a region of a film is both bodies seen as one: it lies where the `other` one flies, which has no region of its own there.
bool is_both(const Candidate& region, const Link& other, const Candidates& candidates);

/// All pairs of links that make a collision of two bodies, best first. Arcs of `candidates`.
std::vector<Collision> find_collisions(const Shot& shot, const ShotCamera& camera, const Candidates& candidates, const std::vector<Arc>& arcs, double noise,
                                       double fps);

/// True if the first of the two is the second of the shot's bodies: by labels, by size, else as found.
bool swapped(const Shot& shot, const std::vector<Candidate>& first, const std::vector<Candidate>& second);

std::vector<Candidate> joined(const std::vector<Candidate>& a, const std::vector<Candidate>& b);

/// Collisions at clearly different times; on one side at least, another has flights of its own, of arcs that the first one has not `used`.
int count_collisions(const std::vector<Collision>& found, const std::vector<char>& used);

}  // namespace unseen::collision
