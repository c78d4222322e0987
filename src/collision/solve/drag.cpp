// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/solve/drag.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "collision/doubts/alternative.h"
#include "collision/doubts/restitution.h"
#include "collision/shot_problem.h"
#include "collision/solve/shared_value.h"
#include "unseen/core/error.h"

namespace unseen::collision {
namespace {

constexpr double kSphere = 0.47;     // Cd
constexpr double kMostDrag = 1.0;    // 1/m: a table-tennis ball has 0.13
constexpr double kTried = 0.1;       // 1/m: if it does not help, no drag does
constexpr double kSaved = 9.0;       // χ² that drag must save to be told of, and
constexpr double kSavedFreely = 36.0;  // where it is not known but fitted: lopsided regions bend flights a little, too
constexpr double kLeastStep = 0.005, kStep = 0.2;  // 1/m, and of the drag: what restitutions are tried with
constexpr double kRefuted = 25.0;    // χ² that known drag saves where a model without does not fit

/// The drag of both bodies if the first has `drag`: like shapes, so it goes with the cross-section over the mass.
Drag shared_out(const SolvedImpact& impact, double drag) {
  const Problem& problem = impact.solution.problem;
  if (problem.fixed || problem.solids[0].mass.extent <= 0.0) return {drag, 0.0};
  const double size = problem.solids[1].mass.extent / problem.solids[0].mass.extent;
  return {drag, drag * size * size / impact.solution.fit.state.mass_ratio};
}

/// Drag by the masses of all free bodies; nothing if one has none.
std::optional<Drag> known_drag(const Shot& shot, const SolvedImpact& impact) {
  Drag drag{};
  for (std::size_t o = 0; o < (impact.solution.problem.fixed ? 1 : 2); ++o)
    if ((drag[o] = drag_of(shot.bodies[o], impact.solution.problem.solids[o], kSphere)) <= 0.0) return std::nullopt;
  return drag;
}

/// About the best drag, by a parabola through the costs of three; nothing if drag does not help. `none`: cost without.
std::optional<Drag> likely_drag(const std::vector<SolvedImpact>& impacts, double none) {
  const auto cost = [&](double drag) { return cost_of(with_drag(impacts, shared_out(impacts.front(), drag))); };
  const double some = cost(kTried);
  if (!(some < none)) return std::nullopt;
  const double more = cost(2.0 * kTried), bend = none - 2.0 * some + more;
  const double best = bend > 0.0 ? kTried * (1.0 + 0.5 * (none - more) / bend) : kMostDrag;
  if (!(best < kMostDrag)) return std::nullopt;  // not the air
  return shared_out(impacts.front(), best);
}

/// Densities that a body may have, kg/m³, the densest first, and what has them.
struct Likely {
  std::vector<double> densities;
  std::string who;
  bool usual = false;  ///< most such have one of them
};

/// Nearly all large balls are hollow: of a basketball 83, a football 77, a volleyball 56. Others may be denser than a tennis ball.
Likely likely_densities(const Body& body, const Solid& solid) {
  constexpr double kLarge = 0.16;  // m
  if (body.shape == Shape::sphere && solid.mass.extent > kLarge) return {{85.0, 65.0}, ", as a large ball's", true};
  return {{320.0, 160.0, 80.0}, body.shape == Shape::sphere ? ", as a light ball's" : "", false};
}

/// What the air may do to the restitution of bodies whose masses nobody gave, if they may be light and it is more than the interval tells: a little is in the interval, as is
/// all of it for a large ball, and more is said.
void doubt_light_bodies(const Shot& shot, const std::vector<SolvedImpact>& impacts, double none, Reconstruction& result, Context& context) {
  constexpr double kLittle = 0.01;
  std::vector<SolvedImpact> lightest;
  if (!result.restitution || std::any_of(shot.bodies.begin(), shot.bodies.end(), [](const Body& body) { return body.mass.has_value(); })) return;
  const Likely likely = likely_densities(shot.bodies[0], impacts.front().solution.problem.solids[0]);
  bool said = false;
  for (const double density : likely.densities) {
    Shot light = shot;
    for (std::size_t o = 0; o < light.bodies.size(); ++o) light.bodies[o].mass = density * impacts.front().solution.problem.solids[o].mass.volume;
    const std::optional<Drag> drag = known_drag(light, impacts.front());
    if (!drag) return;
    const std::vector<SolvedImpact> solved = with_drag(impacts, *drag);
    if (!(2.0 * (none - cost_of(solved)) > -kSaved)) break;  // not so light
    const double c = pooled(restitutions_of(solved)).value;
    if (c >= result.restitution->low && c <= result.restitution->high) continue;
    const bool little = std::abs(c - result.restitution->value) < kLittle;
    if (little || likely.usual) lightest = solved;
    if (little || said) continue;
    context.warn(fmt::format("no mass is given, so that drag of the air is left out: c would be {:.3f} if the density were {:.0f} kg/m³{}; give \"mass\" in kg", c, density, likely.who));
    if (!likely.usual) return;
    said = true;
  }
  if (!lightest.empty()) widen_to_hold(lightest, result);
}

}  // namespace

void check_drag(const Shot& shot, const Options& options, const std::array<Solid, 2>& solids) {
  if (options.drag != "on") return;
  for (std::size_t o = 0; o < 2; ++o)
    if (shot.bodies[o].shape != Shape::fixed && drag_of(shot.bodies[o], solids[o], 1.0) <= 0.0)
      throw InputError(shot.name, "bodies", fmt::format("no mass of \"{}\"", shot.bodies[o].name), "\"mass\" in kg for drag, or drag = estimate");
}

std::vector<SolvedImpact> with_drag(std::vector<SolvedImpact> impacts, const Drag& drag) {
  for (SolvedImpact& impact : impacts) {
    impact.solution.problem.drag = drag;
    impact.solution.fit = settle(impact.solution.problem, impact.solution.fit.state);
  }
  return impacts;
}

Drag best_drag(const std::vector<SolvedImpact>& impacts) {
  return shared_out(impacts.front(), likeliest_value([&](double drag) { return with_drag(impacts, shared_out(impacts.front(), drag)); }, 0.0, kMostDrag));
}

double look_for_drag(const Shot& shot, const Options& options, const std::vector<SolvedImpact>& impacts, Reconstruction& result, Context& context) {
  const Problem& problem = impacts.front().solution.problem;
  if (problem.planar) return 0.0;
  if (options.drag == "estimate")
    add_doubt([&](double drag) { return with_drag(impacts, shared_out(impacts.front(), drag)); }, {problem.drag[0], kMostDrag, kLeastStep + kStep * problem.drag[0]}, impacts, result);
  if (options.drag != "off") return 0.0;
  const double none = cost_of(with_drag(impacts, {0.0, 0.0}));
  const std::optional<Drag> known = known_drag(shot, impacts.front()), drag = known ? known : likely_drag(impacts, none);
  std::vector<SolvedImpact> solved = drag ? with_drag(impacts, *drag) : std::vector<SolvedImpact>();
  const double saved = drag ? 2.0 * (none - cost_of(solved)) : 0.0;
  if (std::isinf(saved)) return 0.0;
  if (!(saved > (known ? kSaved : kSavedFreely))) {
    if (known && saved > -kSaved) add_alternative("with drag of the air", solved, saved, result);  // the flights cannot tell
    if (!known) doubt_light_bodies(shot, impacts, none, result, context);
    return saved;
  }
  const std::string who = problem.fixed ? shot.bodies[0].name : fmt::format("{} and {}", shot.bodies[0].name, shot.bodies[1].name);
  context.warn(fmt::format("{}: the air slows {} down: with drag the flights fit better (χ² falls by {:.0f}); {}", who, problem.fixed ? "it" : "them", saved,
                           known ? "use --drag on" : fmt::format("give the mass and use --drag on, or use --drag estimate (about {:.2f} 1/m)", (*drag)[0])));
  if (known && saved > kRefuted) result.fits = false;
  add_alternative("with drag of the air", solved, saved, result);
  return saved;
}

}  // namespace unseen::collision
