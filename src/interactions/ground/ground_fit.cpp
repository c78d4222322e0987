// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/ground/ground_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace unseen::interactions {
namespace {

constexpr std::size_t kScenelets = 1000, kGlances = 80;  // enough to tell; spread evenly

/// Evenly spread scenelets.
Database thinned(const Database& database) {
  Database few;
  few.recordings = database.recordings;
  const std::size_t count = std::min(kScenelets, database.scenelets.size());
  for (std::size_t i = 0; i < count; ++i) few.scenelets.push_back(database.scenelets[i * database.scenelets.size() / count]);
  return few;
}

class Misfit {
 public:
  Misfit(const Take& take, const Database& database, const GroundStart& feet, const Context& context)
      : take_(take), database_(thinned(database)), feet_(feet), context_(context) {}

  /// Mean error of the best matches, m², and what feet say.
  double operator()(const Ground& ground) const {
    constexpr double kHalf = 1.0, kStep = 0.3;  // s
    constexpr std::size_t kTried = 6;
    const View view = view_of(take_.camera, ground);
    std::vector<std::vector<Sight>> people;
    for (int person = 0; person < take_.people; ++person) people.push_back(sights_of(take_, person, view));
    std::vector<Glance> glances;
    std::size_t total = 0;
    for (const auto& sights : people) total += sights.size();
    const std::size_t stride = std::max<std::size_t>(1, total / kGlances);
    for (const auto& sights : people)
      for (std::size_t i = stride / 2; i < sights.size(); i += stride) glances.push_back(glance_at(sights, sights[i].frame, take_.fps, kHalf, kStep));
    std::vector<std::vector<Match>> matches = match_all(glances, database_, view.center(), kTried, context_);
    std::vector<double> errors(glances.size(), kWorst);
    parallel_blocks(context_, glances.size(), 4, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        for (Match& match : matches[i]) {
          refine(match, glances[i], database_.scenelets[static_cast<std::size_t>(match.scenelet)], view);
          errors[i] = std::min(errors[i], match.error);
        }
    });
    double sum = 0;
    for (const double error : errors) sum += error;
    const Vec2 off(ground.camera_height - feet_.ground.camera_height, std::tan(ground.pitch) - std::tan(feet_.ground.pitch));
    return sum / std::max<double>(1, static_cast<double>(errors.size())) + kFeet * off.dot(feet_.information * off);
  }

 private:
  static constexpr double kWorst = 0.08, kFeet = 1e-4;  // m²: of a match that there is none of; of a squared deviation of what feet say
  const Take& take_;
  Database database_;
  const GroundStart& feet_;
  const Context& context_;
};

}  // namespace

Ground fit_ground(const Take& take, const Database& database, const GroundStart& start, const Context& context) {
  const bool fixed_height = take.camera_height.has_value(), fixed_pitch = take.up.has_value();
  if ((fixed_height && fixed_pitch) || database.scenelets.empty()) return start.ground;
  const Misfit misfit(take, database, start, context);
  std::map<std::pair<long, long>, double> known;
  const auto value = [&](const Ground& g) {
    const auto [entry, fresh] = known.try_emplace({std::lround(1e4 * g.camera_height), std::lround(1e4 * g.pitch)}, 0.0);
    if (fresh) entry->second = misfit(g);
    return entry->second;
  };
  // Height and pitch make up for each other along a valley, so a step of height takes the pitch along that keeps the floor where people are.
  constexpr double kUsualDepth = 4.0;  // m
  Ground best = start.ground;
  double least = value(best);
  for (double step = 0.32; step > 0.015; step *= 0.5) {
    for (bool better = true; better;) {
      better = false;
      context.check();
      const double tilt = step / kUsualDepth;
      for (const auto& [rise, turn] : {std::pair{step, tilt}, {-step, -tilt}, {0.0, 0.5 * tilt}, {0.0, -0.5 * tilt}, {step, 0.0}, {-step, 0.0}}) {
        if ((fixed_height && rise != 0) || (fixed_pitch && turn != 0)) continue;
        Ground tried = best;
        if (!fixed_height) tried.camera_height = std::clamp(best.camera_height + rise, 0.2, 4.0);
        if (!fixed_pitch) tried.pitch = std::clamp(best.pitch + turn, -0.5, 1.0);
        const double error = value(tried);
        if (!(error < least)) continue;
        least = error;
        best = tried;
        better = true;
      }
    }
  }
  return best;
}

}  // namespace unseen::interactions
