// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/best_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "collision/shot_problem.h"
#include "collision/solve/noise.h"
#include "collision/solve/spin_starts.h"
#include "collision/solve/starts.h"
#include "collision/solve/unknowns.h"

namespace unseen::collision {
namespace {

constexpr double kAlike = 3.0;           // ½ χ² by which another solution may be worse and still explains the data alike
constexpr double kOtherValue = 0.05;     // of restitution, or as a share of the mass ratio: less is no other solution

constexpr double kAnglesMet = 14.0;      // by as many unknowns of the turning, however large their noise: of many ways to turn some meet others by chance
constexpr double kFewestAngles = 4.0;    // that count all the same

/// A solution with its own noise.
struct Candidate {
  Problem problem;
  Fit fit;
  double score = 0;  ///< −log likelihood: ½ χ² alone would favour whoever has the larger noise
};

/// Whether some body may have turned whole times between the orientations of a flight.
bool leaves_turns_open(const Problem& problem) {
  for (const int body : {0, 1})
    for (const bool after : {false, true})
      if (open_turns(problem, body, after).open) return true;
  return false;
}

double score_of(const Problem& problem, const Fit& fit) {
  const double pixels = 2.0 * static_cast<double>(problem.points.size());
  double angles = 3.0 * static_cast<double>(problem.orientations.size());
  if (leaves_turns_open(problem)) angles = std::max(kFewestAngles, angles - kAnglesMet);
  return fit.cost + pixels * log_noise(problem.pixel_sigma, problem.noise_power) + angles * std::log(problem.orientation_sigma);
}

/// What a candidate says of the impact.
struct Values {
  double c, m;

  bool are_near(const Values& other, double tolerance) const { return std::abs(other.c - c) < tolerance && std::abs(other.m / m - 1.0) < tolerance; }
};

Values values(const Candidate& x) { return {restitution<double>(x.problem, x.fit.state, values_of(x.problem, x.fit.state)), x.fit.state.mass_ratio}; }

/// Most candidates come to the same few solutions; each is followed but once. The best come first.
void merge(std::vector<Candidate>& candidates) {
  constexpr double kScore = 1e-3, kValue = 1e-3;  // by which the same solution is off where descents end
  std::vector<Candidate> apart;
  std::vector<Values> known;
  for (Candidate& candidate : candidates) {
    const Values here = values(candidate);
    const Vec3& impulse = candidate.fit.state.impulse;
    bool is_known = false;
    for (std::size_t i = apart.size(); i-- > 0 && !is_known && candidate.score - apart[i].score < kScore;)
      is_known = known[i].are_near(here, kValue) && (apart[i].fit.state.impulse - impulse).norm() < kValue * impulse.norm();
    if (is_known) continue;
    apart.push_back(std::move(candidate));
    known.push_back(here);
  }
  candidates = std::move(apart);
}

std::vector<Alternative> alternatives(const std::vector<Candidate>& candidates) {
  std::vector<Alternative> others;
  std::vector<Values> known = {values(candidates.front())};
  for (const Candidate& candidate : candidates) {
    const double excess = candidate.score - candidates.front().score;
    if (excess > kAlike) break;
    const Values here = values(candidate);
    if (std::any_of(known.begin(), known.end(), [&](const Values& k) { return here.are_near(k, kOtherValue); })) continue;
    known.push_back(here);
    const auto [c, m] = here;
    const char* what = !candidate.problem.orientations.empty() ? "other turning" : candidate.problem.fixed ? "another vertical" : "the other one in front";
    others.push_back({fmt::format("{} explains the data alike: c = {:.2f}", what, c) + (candidate.problem.fixed ? "" : fmt::format(", mass ratio {:.2f}", m)), c, m, 2.0 * excess});
  }
  return others;
}

/// Runs `step` on each; those that fail or end far above the best are left out.
template <class Step>
void advance(std::vector<Candidate>& candidates, double worse, Context& context, const Step& step) {
  parallel_blocks(context, candidates.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Candidate& c = candidates[i];
      c.fit = step(c);
      c.score = score_of(c.problem, c.fit);
    }
  });
  context.check();
  std::erase_if(candidates, [](const Candidate& c) { return !c.fit.usable; });
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.score < b.score; });
  if (!candidates.empty()) std::erase_if(candidates, [limit = candidates.front().score + worse](const Candidate& c) { return c.score > limit; });
}

/// Orientations may be much better or worse than expected: starts for each. The camera may look up or down, if nothing tells, which of a bounce
/// is as likely as another impact.
std::vector<Candidate> first_candidates(const Problem& problem, double time, int starts) {
  constexpr double kNoises[] = {1.0, 0.15, 4.0};  // times what was expected
  constexpr double kPitches[] = {-0.25, 0.25};    // rad
  std::vector<Candidate> candidates;
  if (problem.fixed && problem.gravity > 0.0 && problem.down_sigma >= kDownSigma)
    for (const double pitch : kPitches) {
      Problem pitched = problem;
      pitched.down = Eigen::AngleAxisd(pitch, Vec3::UnitX()) * problem.down;
      for (State& state : start_states(pitched, time, starts)) {
        candidates.push_back({problem, {}, 0.0});
        candidates.back().fit.state = std::move(state);
      }
    }
  for (const double noise : kNoises) {
    Problem guess = problem;
    guess.orientation_sigma *= noise;
    for (State& state : start_states(guess, time, starts)) {
      candidates.push_back({guess, {}, 0.0});
      candidates.back().fit.state = std::move(state);
    }
    if (problem.orientations.empty() || !problem.scattered) break;
  }
  return candidates;
}

}  // namespace

Solution best_fit(const Problem& problem, double time, int starts, Context& context) {
  constexpr double kHopeless = 40.0, kPoor = 40.0, kUnlikely = 30.0;  // above the best: as found, with touching shapes, with their own noise
  constexpr double kFarOff = 300.0;
  constexpr std::size_t kTried = 16;
  constexpr int kMoreWays = 2;  // times as many starts, and as many tried, where whole turns are open
  constexpr int kNoiseRounds = 3;
  const int ways = leaves_turns_open(problem) ? kMoreWays : 1;
  const std::size_t tried = kTried * static_cast<std::size_t>(ways);
  std::vector<Candidate> candidates = first_candidates(problem, time, ways * starts);
  if (problem.touches()) {
    advance(candidates, kFarOff, context, [](const Candidate& c) { return try_out(c.problem, c.fit.state); });
    if (candidates.size() > tried) candidates.resize(tried);
  } else {
    advance(candidates, kHopeless, context, [](const Candidate& c) { return approach(c.problem, c.fit.state); });
  }
  advance(candidates, kPoor, context, [](const Candidate& c) { return settle(c.problem, c.fit.state); });
  for (int round = 0; round < kNoiseRounds; ++round) {
    merge(candidates);
    advance(candidates, kUnlikely, context, [&](Candidate& c) {
      estimate_noise(problem, c.problem, c.fit.state);
      return settle(c.problem, c.fit.state);
    });
  }
  if (candidates.empty()) return {problem, {}, {}, 0.0};
  const Candidate& best = candidates.front();
  return {best.problem, best.fit, alternatives(candidates), best.score};
}

}  // namespace unseen::collision
