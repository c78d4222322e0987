// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/turning.h"

#include <algorithm>

namespace unseen::collision {
namespace {

/// Given orientations within the flights that meet in this impact.
std::vector<OrientationObservation> given(const Shot& shot, const Problem& problem) {
  std::vector<OrientationObservation> all;
  for (const OrientationHint& hint : shot.orientations) {
    if (shot.bodies[hint.body].shape == Shape::fixed || problem.solids[hint.body].is_sphere()) continue;
    // the side that has the nearest sighting
    const PointObservation* nearest = nullptr;
    for (const PointObservation& p : problem.points)
      if (p.body == hint.body && (!nearest || std::abs(p.time - hint.time) < std::abs(nearest->time - hint.time))) nearest = &p;
    if (!nearest) continue;
    all.push_back({hint.body, nearest->after, hint.time, (hint.q * problem.solids[hint.body].file_to_principal.conjugate()).normalized()});
  }
  return all;
}

}  // namespace

void solve_turning(const Shot& shot, const Options& options, const ShotCamera&, const Footage&, const Tracks&, SolvedImpact& impact, Context& context) {
  Problem problem = impact.solution.problem;
  problem.orientations = given(shot, problem);
  if (problem.orientations.empty()) return;
  Solution solution = best_fit(problem, impact.solution.fit.state.time, options.starts, context);
  if (solution.fit.usable) impact.solution = std::move(solution);
}

}  // namespace unseen::collision
