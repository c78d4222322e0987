// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "interactions/sample_files.h"
#include "unseen/core/random.h"
#include "unseen/report/interactions_result.h"

namespace unseen::interactions::test {

/// A made-up result with two of everything, and numbers that no short decimal is.
inline Reconstruction sample_result() {
  Random random(3);
  Reconstruction r;
  r.T_world_camera = {Eigen::AngleAxisd(1.3, random.direction()).toRotationMatrix(), Vec3(0, 0, random.uniform())};
  r.camera = {1500 + random.uniform(), 1501 + random.uniform(), 960, 540, 1920, 1080};
  r.fps = 10 + random.uniform();
  r.ground = {1.4 + random.uniform(), random.uniform(), -random.uniform(), "feet"};
  for (int i = 0; i < 2; ++i) {
    Object object = {i == 0 ? 4 : 1, i == 0 ? "couch" : "shelf", {}};
    for (const char* name : {"seat", "back", "arm-1"})
      object.parts.push_back({name, {random.direction(), Eigen::AngleAxisd(random.uniform(), random.direction()).toRotationMatrix(), Vec3(random.uniform(), random.uniform(), 1)}});
    r.objects.push_back({object, random.uniform(), {1, 0}});
    Person person;
    person.id = 7 - i;
    for (int f = 0; f < 3; ++f) {
      PersonFrame frame;
      frame.frame = 5 * f + i;
      for (int j = 0; j < kJoints; ++j) frame.pose.col(j) = random.direction(), frame.confidence[j] = random.uniform();
      frame.source = f == 1 ? PoseSource::scenelet : PoseSource::pose;
      frame.action = static_cast<Action>((i * 3 + f) % 6);
      person.frames.push_back(frame);
      person.likelihood.push_back(random.uniform());
    }
    r.people.push_back(person);
    r.windows.push_back({7 - i, 2, 20 + i, "attic:" + std::to_string(i), random.uniform(), 100 * random.uniform(), {random.direction(), random.uniform()}});
  }
  r.evidence.origin = Vec2(random.uniform(), random.uniform());
  r.evidence.columns = 40, r.evidence.rows = 30;
  r.evidence.probability.assign(3 * 16 * 40 * 30, 0.5F);
  r.summary.warnings = {"the joints are odd"};
  return r;
}

inline std::string result_text(const Reconstruction& r) { return report::interactions_json(r, {"take.json", ""}, OptionTable()); }

}  // namespace unseen::interactions::test
