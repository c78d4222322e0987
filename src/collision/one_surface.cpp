// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/one_surface.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "collision/doubts/vertical.h"
#include "collision/solve/best_fit.h"
#include "collision/solve/estimates.h"

namespace unseen::collision {
namespace {

constexpr double kElsewhere = 60.0 * kPi / 180.0;  // between pushes off one surface there is less, with friction and noise

bool fits(Solution solution, const Options& options, double noise) {
  add_covariance(solution.problem, solution.fit);
  return check_model(solution, options.held_out, noise).fits;
}

/// The impact as one off whatever it was.
Solution off_anything(const SolvedImpact& impact, Context& context) {
  Problem problem = impact.solution.problem;
  problem.fixed_normal.reset();
  problem.fixed_offset.reset();
  problem.level = problem.plumb = false;
  return best_fit(problem, impact.meeting.time, 1, context);
}

Vec3 push_of(const SolvedImpact& impact) { return impact.solution.fit.state.impulse; }

/// The push that most others are near to; the first of several.
Vec3 usual_push(const std::vector<SolvedImpact>& impacts) {
  const auto near = [&](const SolvedImpact& one) {
    return std::count_if(impacts.begin(), impacts.end(), [&](const SolvedImpact& other) { return angle_between(push_of(one), push_of(other)) < kElsewhere; });
  };
  return push_of(*std::max_element(impacts.begin(), impacts.end(), [&](const SolvedImpact& a, const SolvedImpact& b) { return near(a) < near(b); }));
}

std::string left_out(const SolvedImpact& impact, double fps, double off) {
  return fmt::format("the impact at frame {:.1f} is left out: it pushed {:.0f}° away from ", impact.solution.fit.state.time * fps, degrees(off));
}

}  // namespace

bool is_off_something_else(const Shot& shot, const Options& options, double noise, double fps, const SolvedImpact& impact, Context& context) {
  const Problem& problem = impact.solution.problem;
  if (!problem.fixed_normal || !impact.solution.fit.usable || fits(impact.solution, options, noise)) return false;
  const SolvedImpact own{impact.meeting, off_anything(impact, context), {}, {}};
  if (!own.solution.fit.usable) return false;
  const double off = angle_between(push_of(own), *problem.fixed_normal);
  if (off < kElsewhere || !fits(own.solution, options, noise)) return false;
  context.warn(left_out(own, fps, off) + "the normal of " + shot.bodies[1].name);
  return true;
}

void keep_one_surface(const Shot& shot, const Options& options, double noise, double fps, std::vector<SolvedImpact>& impacts, Context& context) {
  const auto loose = [](const SolvedImpact& impact) { return impact.solution.problem.fixed && !impact.solution.problem.fixed_normal; };
  if (!std::all_of(impacts.begin(), impacts.end(), loose) || impacts.empty()) return;
  const Vec3 usual = usual_push(impacts);
  std::erase_if(impacts, [&](const SolvedImpact& impact) {
    const double off = angle_between(push_of(impact), usual);
    if (off < kElsewhere || !fits(impact.solution, options, noise)) return false;
    context.warn(left_out(impact, fps, off) + fmt::format("where the others did; give the \"normal\" of {} if that one is meant", shot.bodies[1].name));
    return true;
  });
}

}  // namespace unseen::collision
