// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve_impacts.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "collision/doubts/restitution.h"
#include "collision/doubts/vertical.h"
#include "collision/one_surface.h"
#include "collision/shot_problem.h"
#include "collision/solve/drag.h"
#include "collision/solve/estimates.h"
#include "collision/solve/slowing.h"
#include "collision/solve/unknowns.h"
#include "collision/split.h"

namespace unseen::collision {
namespace {

constexpr double kFromFloor = 0.35; // rad: an impulse that is this near to the vertical comes from a floor, and
constexpr double kWall = 0.35;      // rad: one that is this near to level from a wall

/// Floors are level, and walls plumb, as far as the shot does not say where down is.
void add_floor_or_wall(Problem& problem, const State& state) {
  if (!problem.fixed || problem.gravity == 0.0) return;
  const Vec3 up = -state.down;
  if (!problem.fixed_normal) problem.level = line_angle(up, state.impulse) <= kFromFloor && state.impulse.dot(up) > 0.0;
  problem.plumb = problem.down_sigma >= kDownSigma && std::abs(line_angle(up, problem.fixed_normal.value_or(state.impulse)) - 0.5 * kPi) <= kWall;
}

void settle_again(SolvedImpact& impact) {
  const Fit fit = settle(impact.solution.problem, impact.solution.fit.state);
  if (fit.usable) impact.solution.fit = fit;
}

/// Whether the second impact ends the flight that the first begins.
bool share_flight(const SolvedImpact& first, const SolvedImpact& second) { return first.meeting.after == second.meeting.before; }

/// Share of the impacts' sightings that are not another's too: a flight between two impacts counts for both.
double distinct_share(const std::vector<SolvedImpact>& impacts) {
  std::set<std::pair<int, int>> distinct;
  std::size_t count = 0;
  for (const SolvedImpact& impact : impacts) {
    for (const PointObservation& p : impact.solution.problem.points) distinct.insert({p.body, p.frame});
    count += impact.solution.problem.points.size();
  }
  return static_cast<double>(distinct.size()) / static_cast<double>(std::max<std::size_t>(1, count));
}

}  // namespace

std::vector<SolvedImpact> solve_positions(const Shot& shot, const Options& options, const ShotCamera& camera, const std::array<Solid, 2>& solids,
                                          Tracks& tracks, double fps, Context& context) {
  constexpr int kStarts = 4;  // which of two balls is in front at the impact may be open
  std::vector<SolvedImpact> impacts;
  for (const Tracks::Meeting& meeting : std::vector(tracks.meetings)) {
    SolvedImpact impact;
    impact.meeting = meeting;
    const auto solve = [&](const Tracks& seen) { return best_fit(problem_of(shot, options, camera, solids, seen, meeting), meeting.time, kStarts, context); };
    impact.solution = solve(tracks);
    if (is_off_something_else(shot, options, tracks.noise, fps, impact, context)) continue;
    settle_split(solve, impact.meeting, 1.0 / fps, tracks, impact.solution);
    if (!impact.solution.fit.usable) continue;
    add_floor_or_wall(impact.solution.problem, impact.solution.fit.state);
    if (impact.solution.problem.level || impact.solution.problem.plumb) settle_again(impact);
    impacts.push_back(std::move(impact));
    context.progress(static_cast<double>(impacts.size()) / static_cast<double>(tracks.meetings.size()));
  }
  keep_one_surface(shot, options, tracks.noise, fps, impacts, context);
  if (shot.gravity == 0.0 && options.drag == "off" && !impacts.empty()) impacts = slowed_by_table(std::move(impacts));
  if (options.drag == "estimate" && !impacts.empty()) {
    impacts = with_drag(impacts, best_drag(impacts));
    std::erase_if(impacts, [](const SolvedImpact& impact) { return !impact.solution.fit.usable; });
  }
  return impacts;
}

void share_gravity(std::vector<SolvedImpact>& impacts) {
  constexpr double kSurest = 0.003, kFilmed = 0.03;  // rad: regions are lopsided, which bends flights as another gravity would
  if (impacts.size() < 2 || impacts.front().solution.problem.gravity == 0.0) return;
  std::vector<Vertical> seen;
  for (SolvedImpact& impact : impacts) {
    add_covariance(impact.solution.problem, impact.solution.fit);
    seen.push_back(seen_vertical(impact.solution.problem, impact.solution.fit));
  }
  const double share = distinct_share(impacts);
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    Problem& problem = impacts[i].solution.problem;
    Vertical known = expected_vertical(problem);
    for (std::size_t j = 0; j < impacts.size(); ++j)
      if (j != i) known.add(seen[j], share);
    const auto [down, sigma] = likeliest(known, impacts[i].solution.fit.state.down);
    problem.down = down;
    problem.down_sigma = std::max(problem.filmed ? kFilmed : kSurest, sigma);
    settle_again(impacts[i]);
  }
}

void share_floor(std::vector<SolvedImpact>& impacts) {
  constexpr int kRounds = 2;
  const auto one_floor = [](const SolvedImpact& impact) {
    const Problem& p = impact.solution.problem;
    return p.fixed && (p.level || p.fixed_normal) && p.solids[0].is_sphere();
  };
  for (int round = 0; round < kRounds; ++round) {
    for (std::size_t k = 0; k < impacts.size(); ++k) {
      impacts[k].solution.problem.other_contacts.clear();
      for (const std::size_t other : {k - 1, k + 1})
        if (other < impacts.size() && one_floor(impacts[k]) && one_floor(impacts[other]) && share_flight(impacts[std::min(k, other)], impacts[std::max(k, other)]))
          impacts[k].solution.problem.other_contacts.push_back({other > k, impacts[other].solution.fit.state.time});
    }
    for (SolvedImpact& impact : impacts)
      if (!impact.solution.problem.other_contacts.empty()) settle_again(impact);
  }
}

void share_restitution(std::vector<SolvedImpact>& impacts) {
  if (impacts.size() < 2) return;
  std::vector<Estimate> each;
  for (SolvedImpact& impact : impacts) {
    add_covariance(impact.solution.problem, impact.solution.fit);
    each.push_back(restitution_of(impact.solution.problem, impact.solution.fit));
  }
  for (SolvedImpact& impact : impacts) {
    impact.solution.problem.restitution = std::clamp(pooled(each).value, 0.0, 1.0);
    settle_again(impact);
  }
}

}  // namespace unseen::collision
