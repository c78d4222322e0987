// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/doubts/shutter_doubt.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "collision/doubts/alternative.h"
#include "collision/doubts/restitution.h"

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
  std::vector<SolvedImpact> plain, rolled;
  double saved = 0.0;  // χ²
  for (const SolvedImpact& impact : impacts) {
    if (!impact.check.fits) continue;
    Problem& problem = plain.emplace_back(impact).solution.problem;
    plain.back().solution.fit = settle(problem, impact.solution.fit.state);
    rolled.push_back(plain.back());
    for (PointObservation& p : rolled.back().solution.problem.points) p.time += readout * p.row;
    rolled.back().solution.fit = settle(rolled.back().solution.problem, impact.solution.fit.state);
    if (!plain.back().solution.fit.usable || !rolled.back().solution.fit.usable) return;
    saved += 2.0 * (plain.back().solution.fit.cost - rolled.back().solution.fit.cost);
  }
  const double change = pooled(restitutions_of(rolled)).value - pooled(restitutions_of(plain)).value;
  const double c = std::clamp(result.restitution->value + change, 0.0, 1.0), reach = 0.5 * (result.restitution->high - result.restitution->low);
  if (std::abs(change) < std::max(kMuch, kHalf * reach) || !(saved > -kRefuted)) return;
  const double milliseconds = 1e3 * readout;
  context.warn(fmt::format("{}: camera: if its shutter rolls, as phones' do, restitution is another, {:.3f} where it takes {:.0f} ms from the first row to the last: give "
                           "\"readout\" (s), or 0", shot.name, c, milliseconds));
  const double mass_ratio = rolled.front().solution.problem.fixed ? 0.0 : rolled.front().solution.fit.state.mass_ratio;
  result.ambiguous.push_back({fmt::format("with a shutter that rolls for {:.0f} ms: c = {:.2f}", milliseconds, c), c, mass_ratio, -saved});
}

}  // namespace unseen::collision
