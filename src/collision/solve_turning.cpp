// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve_turning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "collision/orientations/centering.h"
#include "collision/solve/rotation.h"
#include "collision/solve/unknowns.h"

namespace unseen::collision {
namespace {

constexpr int kKept = 3;     // rotations of a flight that are looked at
constexpr int kCombined = 8;  // combinations of them that are solved
constexpr int kRounds = 2;            // of rotations and distances
constexpr double kKnownDistance = 0.02;  // of itself: outlines allow for half of it
constexpr double kHopeless = 150.0;  // χ² above the best one's

/// Given orientations within the flights that meet in this impact, or little before and after what was seen of them.
std::vector<OrientationObservation> given(const Shot& shot, const Problem& problem) {
  std::vector<OrientationObservation> all;
  for (const OrientationHint& hint : shot.orientations) {
    if (shot.bodies[hint.body].shape == Shape::fixed || problem.solids[hint.body].is_sphere()) continue;
    const PointObservation* nearest = nullptr;  // tells the side
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (const PointObservation& p : problem.points) {
      if (p.body != hint.body) continue;
      first = std::min(first, p.time);
      last = std::max(last, p.time);
      if (!nearest || std::abs(p.time - hint.time) < std::abs(nearest->time - hint.time)) nearest = &p;
    }
    const double beyond = kBeyondFlights * (last - first);
    if (!nearest || hint.time < first - beyond || hint.time > last + beyond) continue;
    all.push_back({hint.body, nearest->after, hint.time, (hint.q * problem.solids[hint.body].file_to_principal.conjugate()).normalized()});
  }
  return all;
}

/// The centres of all track points by this impact's solution, in camera coordinates.
std::vector<Vec3> centers_of(const SolvedImpact& impact, const Tracks& tracks) {
  const StateT<double> s = values_of(impact.solution.problem, impact.solution.fit.state);
  std::vector<Vec3> centers;
  for (const TrackPoint& p : tracks.points) centers.push_back(position_at<double>(impact.solution.problem, s, p.body, p.time > s.time, p.time));
  return centers;
}

/// One rotation for each flight that has any, and what they cost together.
struct Combination {
  std::vector<const Spin*> spins;
  double cost = 0;
};

/// Combinations of the flights' rotations, the best first.
std::vector<Combination> combinations(const std::vector<std::vector<Spin>>& spins, const Tracks::Meeting& meeting) {
  std::vector<Combination> all = {{}};
  for (const std::vector<int>* spans : {&meeting.before, &meeting.after})
    for (const int span : *spans) {
      if (spins[span].empty()) continue;
      std::vector<Combination> longer;
      for (const Combination& c : all)
        for (const Spin& spin : spins[span]) {
          longer.push_back(c);
          longer.back().spins.push_back(&spin);
          longer.back().cost += spin.cost - spins[span].front().cost;
        }
      all = std::move(longer);
    }
  std::stable_sort(all.begin(), all.end(), [](const Combination& a, const Combination& b) { return a.cost < b.cost; });
  if (all.size() > kCombined) all.resize(kCombined);
  std::erase_if(all, [least = all.front().cost](const Combination& c) { return c.cost > least + kHopeless; });
  return all;
}

/// Where the bodies are by an impact's solution, turned as the film's rotations have it.
PoseOf poses_of(const SolvedImpact& impact, const Combination& combination, const Tracks& tracks) {
  return [&](const PointObservation& point, Vec3& center, Quat& q) {
    const Problem& problem = impact.solution.problem;
    center = position_at<double>(problem, values_of(problem, impact.solution.fit.state), point.body, point.after, point.time);
    const Solid& solid = problem.solids[static_cast<std::size_t>(point.body)];
    q = Quat::Identity();
    if (solid.is_sphere()) return true;
    const std::vector<int>& spans = point.after ? impact.meeting.after : impact.meeting.before;
    for (const Spin* spin : combination.spins) {
      if (tracks.spans[spin->span].body != point.body || std::find(spans.begin(), spans.end(), spin->span) == spans.end()) continue;
      q = spin->q * solid.file_to_principal.conjugate();
      const Vec3 h = q * solid.mass.inertia.cwiseProduct(q.conjugate() * spin->omega);
      q = turned(q, h, solid.mass.inertia, point.time - spin->time);
      return true;
    }
    return false;
  };
}

/// Where the bodies are and how they are turned by a solution.
PoseOf poses_of(const Solution& solution) {
  return [&](const PointObservation& point, Vec3& center, Quat& q) {
    const Problem& problem = solution.problem;
    center = position_at<double>(problem, values_of(problem, solution.fit.state), point.body, point.after, point.time);
    q = orientation_at(problem, solution.fit.state, point.body, point.after, point.time);
    return problem.solids[static_cast<std::size_t>(point.body)].is_sphere() || problem.turns(point.body);
  };
}

/// Solves again with centres that the solution's own orientations give.
void center_again(const std::vector<PointObservation>& seen, const std::array<FigureMaker, 2>& makers, Solution& solution) {
  Solution next = solution;
  next.problem.points = centered(seen, solution.problem, makers, poses_of(solution));
  next.fit = settle(next.problem, solution.fit.state);
  if (next.fit.usable) solution = std::move(next);
}

Problem with_orientations(Problem problem, const Combination& combination, const Tracks& tracks, const Tracks::Meeting& meeting) {
  double squares = 0.0;
  problem.scattered = false;
  for (const Spin* spin : combination.spins)
    for (const Orientation& o : spin->orientations) {
      const bool after = std::find(meeting.after.begin(), meeting.after.end(), spin->span) != meeting.after.end();
      problem.orientations.push_back({tracks.spans[spin->span].body, after, o.time,
                                      (o.q * problem.solids[o.body].file_to_principal.conjugate()).normalized()});
      squares += o.sigma * o.sigma;
    }
  problem.orientation_sigma = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(1, problem.orientations.size())));
  return problem;
}

/// χ² of a solution by the noise that was expected, which all combinations share, instead of the noise that its own residuals have.
double comparable_cost(const Solution& solution, const Problem& expected) {
  const auto squares = [&](const std::string& term, double count, double noise) {
    const auto it = solution.fit.terms.find(term);
    return it == solution.fit.terms.end() ? 0.0 : count * std::pow(noise * it->second, 2);
  };
  double sum = 0.0;
  for (const auto& [term, value] : solution.fit.terms)
    if (term != "points" && term != "orientation") sum += squares(term, 1.0, 1.0);
  return sum + squares("points", 2.0 * static_cast<double>(expected.points.size()), solution.problem.pixel_sigma / expected.pixel_sigma) +
         squares("orientation", 3.0 * static_cast<double>(expected.orientations.size()), solution.problem.orientation_sigma / expected.orientation_sigma);
}

/// The impact as centres and distances have it that outlines tell if the bodies are turned like this; nothing if it cannot be solved.
std::optional<SolvedImpact> centered_impact(const SolvedImpact& impact, const Combination& combination, const Tracks& tracks, const std::array<FigureMaker, 2>& makers) {
  Problem problem = impact.solution.problem;
  problem.points = centered(problem.points, problem, makers, poses_of(impact, combination, tracks));
  SolvedImpact next = impact;
  next.solution.fit = settle(problem, impact.solution.fit.state);
  return next.solution.fit.usable ? std::optional(next) : std::nullopt;
}

/// The largest share by which distances differ.
double farthest_apart(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(b[i].z() / a[i].z() - 1.0));
  return most;
}

/// Solves with the film's rotations; those that the impact cannot join cost more than those that it can.
Solution solve_with(const std::vector<std::vector<Spin>>& spins, const SolvedImpact& impact, const Tracks& tracks,
                    const std::array<FigureMaker, 2>& makers, int starts, Context& context) {
  Solution best;
  double best_cost = 0.0;
  std::vector<std::pair<double, Solution>> solved;
  for (const Combination& combination : combinations(spins, impact.meeting)) {
    if (combination.spins.empty()) break;
    Problem problem = with_orientations(impact.solution.problem, combination, tracks, impact.meeting);
    problem.points = centered(problem.points, problem, makers, poses_of(impact, combination, tracks));
    Solution solution = best_fit(problem, impact.solution.fit.state.time, starts, context);
    const double cost = 0.5 * (combination.cost + comparable_cost(solution, problem));
    if (solution.fit.usable) solved.emplace_back(cost, std::move(solution));
  }
  for (auto& [cost, solution] : solved)
    if (!best.fit.usable || cost < best_cost) best_cost = cost, best = solution;
  const auto value = [](const Solution& s) { return restitution<double>(s.problem, s.fit.state, values_of(s.problem, s.fit.state)); };
  for (const auto& [cost, solution] : solved) {
    constexpr double kAlike = 3.0, kOther = 0.05;
    if (cost > best_cost + kAlike || cost == best_cost) continue;
    const double c = value(solution), m = solution.fit.state.mass_ratio;
    if (std::abs(c - value(best)) < kOther && std::abs(m / best.fit.state.mass_ratio - 1.0) < kOther) continue;
    best.others.push_back({"another turning that the film allows", c, m, 2.0 * (cost - best_cost)});
  }
  return best;
}

}  // namespace

void solve_turning(const Shot& shot, const Options& options, const ShotCamera& camera, const Footage& footage, const Tracks& tracks,
                   SolvedImpact& impact, Context& context) {
  const auto& solids = impact.solution.problem.solids;
  const auto may_turn = [&](int o) { return shot.bodies[o].shape != Shape::fixed && solids[o].known_shape && !solids[o].is_sphere(); };
  if (!impact.solution.problem.terms.orientation || (!may_turn(0) && !may_turn(1))) return;
  Solution solution;
  Problem problem = impact.solution.problem;
  problem.orientations = given(shot, problem);
  const std::vector<PointObservation> seen = problem.points;
  const std::array<FigureMaker, 2> makers = {FigureMaker(shot.bodies[0], shot.name), FigureMaker(shot.bodies[1], shot.name)};
  if (!problem.orientations.empty()) {
    solution = best_fit(problem, impact.solution.fit.state.time, options.starts, context);
  } else if (!footage.regions.empty()) {
    constexpr int kStarts = 4;  // the film's rotations leave no turns open
    const auto spins_at = [&](const SolvedImpact& at) { return find_spins(shot, camera, footage, tracks, centers_of(at, tracks), kKept, context); };
    SolvedImpact now = impact;
    std::vector<std::vector<Spin>> spins = spins_at(now);
    for (int round = 0; round < kRounds; ++round) {  // at a wrong distance outlines have another size, and seem to be turned
      const std::vector<Combination> best = combinations(spins, now.meeting);
      if (best.front().spins.empty()) break;
      const std::optional<SolvedImpact> next = centered_impact(now, best.front(), tracks, makers);
      if (!next || farthest_apart(centers_of(now, tracks), centers_of(*next, tracks)) < kKnownDistance) break;
      now = *next;
      spins = spins_at(now);
    }
    solution = solve_with(spins, now, tracks, makers, kStarts, context);
  }
  if (solution.fit.usable && !footage.regions.empty()) center_again(seen, makers, solution);
  if (solution.fit.usable) impact.solution = std::move(solution);
}

}  // namespace unseen::collision
