// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "unseen/interactions/synth.h"

namespace unseen::interactions {

/// A made-up result with the take that it could come from: a simulated take's truth as if it had been found, with a window wherever somebody
/// does something else than walk or stand. Every other frame of the last person is missing for a second.
struct PageSample {
  Reconstruction result;
  Take take;
};

/// Each object's confidence where it stands.
inline EvidenceMap map_of(const std::vector<FoundObject>& objects) {
  EvidenceMap map;
  map.origin = Vec2(-4, 0);
  map.columns = map.rows = 80;
  map.probability.assign(std::size_t{3} * EvidenceMap::kTurns * 6400, 0.0f);
  for (const FoundObject& found : objects)
    for (int cell = 0; cell < 6400; ++cell)
      for (const Part& part : found.object.parts) {
        const Vec3 at(map.origin.x() + map.cell * (cell % 80 + 0.5), map.origin.y() + map.cell * (cell / 80 + 0.5), part.box.center.z());
        const auto place = static_cast<std::size_t>(found.object.superclass()) * EvidenceMap::kTurns * 6400 + static_cast<std::size_t>(cell);
        if (found.object.superclass() != Superclass::other && part.box.contains(at)) map.probability[place] = static_cast<float>(found.confidence);
      }
  return map;
}

inline PageSample page_sample(int people = 1, double seconds = 24, int seed = 4) {
  SynthOptions options;
  options.people = people;
  options.seconds = seconds;
  options.seed = seed;
  const SynthTake synth = simulate(options);
  PageSample s;
  s.take = synth.take;
  s.take.name = "take.json";
  Reconstruction& r = s.result;
  r.T_world_camera = synth.truth.T_world_camera;
  r.camera = synth.take.camera;
  r.fps = synth.truth.fps;
  r.ground = {r.T_world_camera.translation.z(), 0.05, 0.0, "feet"};
  for (const Object& object : synth.truth.objects) r.objects.push_back({object, std::max(0.3, 0.93 - 0.08 * object.id), {}});
  for (std::size_t p = 0; p < synth.truth.people.size(); ++p) {
    Person person;
    person.id = static_cast<int>(p);
    double level = 0;
    for (const RecordedFrame& f : synth.truth.people[p]) {
      const bool busy = f.action != Action::walk && f.action != Action::stand;
      level += 0.3 * ((busy ? 0.9 : 0.05) - level);
      PersonFrame frame{f.frame, f.pose, busy ? PoseSource::scenelet : PoseSource::pose, f.action, PerJoint::Constant(0.9)};
      for (int j = 0; j < kJoints; ++j)
        if (f.occluded[static_cast<std::size_t>(j)]) frame.confidence[j] = 0.2;
      const bool missing = p + 1 == synth.truth.people.size() && f.frame >= r.fps && f.frame < 2 * r.fps && f.frame % 2 == 1;
      if (!missing) {
        person.frames.push_back(frame);
        person.likelihood.push_back(level);
      }
      if (!busy) continue;
      if (r.windows.empty() || r.windows.back().person != person.id || r.windows.back().last + 1 < f.frame ||
          f.frame - r.windows.back().first > 2 * r.fps) {
        r.windows.push_back({person.id, f.frame, f.frame, "recording 3, frame 120", 0.9, 0.02, frame_of(f.pose)});
        const auto nearest = std::min_element(r.objects.begin(), r.objects.end(), [&](const FoundObject& a, const FoundObject& b) {
          const auto away = [&](const FoundObject& o) { return (o.object.center() - f.pose.col(pelvis)).head<2>().norm(); };
          return away(a) < away(b);
        });
        if (nearest != r.objects.end()) nearest->windows.push_back(static_cast<int>(r.windows.size()) - 1);
      }
      r.windows.back().last = f.frame;
      r.windows.back().likelihood = std::max(r.windows.back().likelihood, level);
    }
    r.people.push_back(std::move(person));
  }
  r.evidence = map_of(r.objects);
  r.summary.counts = {{"frames", r.people.front().frames.size()}, {"objects", r.objects.size()}};
  r.summary.seconds = {{"match", 12.0}, {"scene", 3.0}};
  return s;
}

}  // namespace unseen::interactions
