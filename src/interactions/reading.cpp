// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/reading.h"

#include <algorithm>
#include <cmath>

#include "interactions/saliency.h"

namespace unseen::interactions {
namespace {

constexpr double kHalf = 1.0, kStep = 0.3, kEvery = 0.2;  // s: half a window, between the poses compared, between readings
constexpr std::size_t kRefined = 80, kKept = 40;
constexpr double kTemperature = 0.002;  // m² of error over which a match loses most of its weight

void weigh(Reading& reading, const Database& database, const std::vector<double>& rarity) {
  double total = 0;
  for (const Match& match : reading.matches) {
    const double fit = std::exp(-(match.error - reading.matches.front().error) / kTemperature);
    reading.weights.push_back(fit * rarity[static_cast<std::size_t>(match.scenelet)]);
    total += reading.weights.back();
  }
  for (double& weight : reading.weights) weight /= total;
  for (std::size_t i = 0; i < reading.matches.size(); ++i) {
    const Match& match = reading.matches[i];
    reading.likelihood += reading.weights[i] * database.scenelets[static_cast<std::size_t>(match.scenelet)].highest_saliency;
    reading.pelvis += reading.weights[i] * match.placement.position.head<2>();
  }
  for (std::size_t i = 0; i < reading.matches.size(); ++i) {
    const Vec2 off = reading.matches[i].placement.position.head<2>() - reading.pelvis;
    reading.spread += reading.weights[i] * off * off.transpose();
  }
}

}  // namespace

std::vector<double> rarity_of(const Database& database) {
  std::vector<double> rarity = densities(database.scenelets);
  for (double& r : rarity) r = 1 / r;
  return rarity;
}

std::vector<Reading> read_motion(const std::vector<Sight>& sights, const Database& database, const std::vector<double>& rarity, const View& view,
                                 double fps, const Context& context) {
  std::vector<Glance> glances;
  const int every = std::max(1, static_cast<int>(std::lround(kEvery * fps)));
  for (const Sight& sight : sights)
    if (glances.empty() || sight.frame >= glances.back().center + every) glances.push_back(glance_at(sights, sight.frame, fps, kHalf, kStep));
  std::vector<std::vector<Match>> matches = match_all(glances, database, view.center(), kRefined, context);
  std::vector<Reading> readings(glances.size());
  parallel_blocks(context, glances.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Reading& reading = readings[i];
      reading.frame = glances[i].center;
      reading.glance = glances[i];
      for (Match& match : matches[i]) refine(match, glances[i], database.scenelets[static_cast<std::size_t>(match.scenelet)], view);
      std::sort(matches[i].begin(), matches[i].end(),
                [](const Match& a, const Match& b) { return a.error != b.error ? a.error < b.error : a.scenelet < b.scenelet; });
      matches[i].resize(std::min(kKept, matches[i].size()));
      reading.matches = std::move(matches[i]);
      if (!reading.matches.empty()) weigh(reading, database, rarity);
    }
  });
  std::erase_if(readings, [](const Reading& reading) { return reading.matches.empty(); });
  return readings;
}

}  // namespace unseen::interactions
