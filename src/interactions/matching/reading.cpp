// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/matching/reading.h"

#include <algorithm>
#include <cmath>

#include "interactions/matching/shadow.h"

namespace unseen::interactions {
namespace {

constexpr double kHalf = 1.0, kStep = 0.3, kEvery = 0.2;  // s: half a window, between the poses compared, between readings
constexpr std::size_t kRefined = 80, kKept = 40;
constexpr double kOcclusion = 0.5;      // of the occlusion cost to the squared distance
constexpr double kTemperature = 0.001;  // m² of error over which a match loses most of its weight

/// Mean of the occlusion cost over the glance's joints: those that are not seen should be behind the match's objects (thesis Eq. 6.3), unless somebody stands
/// in front. m²
double unexplained(const Match& match, const Glance& glance, const Scenelet& scenelet, const Vec3& camera) {
  std::vector<Shadow> shadows;
  for (const Object& object : scenelet.objects)
    for (const Part& part : object.parts) shadows.emplace_back(match.placement * part.box, camera);
  double cost = 0;
  int joints = 0;
  for (std::size_t i = 0; i < glance.sights.size(); ++i) {
    const auto pose = pose_at(scenelet, glance.offsets[i]);
    if (!pose) continue;
    const Pose placed = match.placement * *pose;
    for (int k = 0; k < kJoints; ++k)
      if (!glance.sights[i]->behind_others[static_cast<std::size_t>(k)])
        cost += occlusion_cost(placed.col(k), glance.sights[i]->confidence[k], shadows);
    joints += kJoints;
  }
  return joints > 0 ? cost / joints : 0;
}

/// How much a match adds to better ones: scenelets of one recording and place are one testimony, told several times.
std::vector<double> novelty(const std::vector<Match>& matches, const Database& database) {
  constexpr double kSamePlace = 0.4;  // m
  std::vector<double> novelty;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    const Scenelet& mine = database.scenelets[static_cast<std::size_t>(matches[i].scenelet)];
    int told = 1;
    for (std::size_t j = 0; j < i; ++j) {
      const Scenelet& other = database.scenelets[static_cast<std::size_t>(matches[j].scenelet)];
      told += mine.recording == other.recording && (mine.origin.position - other.origin.position).norm() < kSamePlace;
    }
    novelty.push_back(1.0 / (told * told));
  }
  return novelty;
}

void weigh(Reading& reading, const Database& database) {
  const std::vector<double> fresh = novelty(reading.matches, database);
  double total = 0;
  for (std::size_t i = 0; i < reading.matches.size(); ++i) {
    reading.weights.push_back(fresh[i] * std::exp(-(reading.matches[i].error - reading.matches.front().error) / kTemperature));
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

std::vector<Reading> read_motion(const std::vector<Sight>& sights, const Database& database, const View& view,
                                 double fps, bool occlusion, const Context& context) {
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
      for (Match& match : matches[i]) {
        const Scenelet& scenelet = database.scenelets[static_cast<std::size_t>(match.scenelet)];
        refine(match, glances[i], scenelet, view);
        if (occlusion) match.error += kOcclusion * unexplained(match, glances[i], scenelet, view.center());
      }
      std::sort(matches[i].begin(), matches[i].end(),
                [](const Match& a, const Match& b) { return a.error != b.error ? a.error < b.error : a.scenelet < b.scenelet; });
      matches[i].resize(std::min(kKept, matches[i].size()));
      reading.matches = std::move(matches[i]);
      if (!reading.matches.empty()) weigh(reading, database);
    }
  });
  std::erase_if(readings, [](const Reading& reading) { return reading.matches.empty(); });
  return readings;
}

}  // namespace unseen::interactions
