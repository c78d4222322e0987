// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/shutter_doubt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "collision/doubts/alternative.h"
#include "collision/doubts/restitution.h"
#include "collision/tracks/rolling_shutter.h"

namespace unseen::collision {
namespace {

constexpr double kReadout = 0.015;      // s, of a phone,
constexpr double kMostOfFrame = 0.8;    // of what a frame lasts
constexpr double kMuch = 0.02, kHalf = 0.5;  // of restitution; of what its interval reaches to either side
constexpr double kRefuted = 16.0;       // χ²

}  // namespace

void doubt_shutter(const Shot& shot, const std::vector<SolvedImpact>& impacts, Reconstruction& result, Context& context) {
  if (shot.camera.readout || !result.restitution) return;
  const double readout = std::min(kReadout, kMostOfFrame / result.fps);
  std::vector<SolvedImpact> rolled = impacts;
  double saved = 0.0;  // χ²
  for (SolvedImpact& impact : rolled) {
    Problem& problem = impact.solution.problem;
    const double before = settle(problem, impact.solution.fit.state).cost;
    for (PointObservation& p : problem.points) p.time += readout * row_share(p.pixel.y(), problem.camera.height);
    impact.solution.fit = settle(problem, impact.solution.fit.state);
    if (!impact.solution.fit.usable) return;
    saved += 2.0 * (before - impact.solution.fit.cost);
  }
  const double c = std::clamp(pooled(restitutions_of(rolled)).value, 0.0, 1.0), reach = 0.5 * (result.restitution->high - result.restitution->low);
  if (std::abs(c - result.restitution->value) < std::max(kMuch, kHalf * reach) || !(saved > -kRefuted)) return;
  const double milliseconds = 1e3 * readout;
  context.warn(fmt::format("{}: camera: if its shutter rolls, as phones' do, restitution is another, {:.3f} where it takes {:.0f} ms from the first row to the last: give "
                           "\"readout\" (s), or 0", shot.name, c, milliseconds));
  const double mass_ratio = rolled.front().solution.problem.fixed ? 0.0 : rolled.front().solution.fit.state.mass_ratio;
  result.ambiguous.push_back({fmt::format("with a shutter that rolls for {:.0f} ms: c = {:.2f}", milliseconds, c), c, mass_ratio, -saved});
}

}  // namespace unseen::collision
