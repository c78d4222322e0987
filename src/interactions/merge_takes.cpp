// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/merge_takes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "interactions/identities.h"
#include "unseen/core/error.h"

namespace unseen::interactions {
namespace {

bool same(const Camera& a, const Camera& b) {
  const auto near = [](double x, double y) { return std::abs(x - y) <= 1e-3 * std::max(1.0, std::abs(x)); };
  return near(a.fx, b.fx) && near(a.fy, b.fy) && near(a.cx, b.cx) && near(a.cy, b.cy) && a.width == b.width && a.height == b.height;
}

void check(const Take& take, const Take& first) {
  if (take.detections.empty()) throw InputError(take.name, "joints", "nobody in any frame", "at least one person detected");
  if (!same(take.camera, first.camera)) throw InputError(take.name, "camera", "another one", fmt::format("the camera of {}: takes of one room", first.name));
  if (take.fps != first.fps) throw InputError(take.name, "fps", fmt::format("{:g}", take.fps), fmt::format("{:g} as in {}", first.fps, first.name));
}

}  // namespace

Take merge_takes(const std::vector<Take>& takes) {
  if (takes.empty()) throw InputError("takes", "", "none", "at least one");
  constexpr double kPause = 10;  // s between two takes
  Take all = takes.front();
  all.detections.clear();
  all.people = 0;
  int start = 0;
  for (const Take& take : takes) {
    check(take, takes.front());
    const std::vector<int> persons = identify(take);
    int last = start;
    for (std::size_t i = 0; i < take.detections.size(); ++i) {
      if (persons[i] < 0) continue;
      Detection detection = take.detections[i];
      detection.person = all.people + persons[i];
      detection.frame += start;
      last = std::max(last, detection.frame);
      all.detections.push_back(std::move(detection));
    }
    all.people += take.people;
    start = last + static_cast<int>(kPause * take.fps);
    if (&take != &takes.front()) all.remarks.insert(all.remarks.end(), take.remarks.begin(), take.remarks.end());
  }
  return all;
}

}  // namespace unseen::interactions
