// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/people/merge_takes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "interactions/people/identities.h"
#include "interactions/people/slips.h"
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

/// What one take says of the camera's place counts for all: they are of one camera. Throws InputError where two say different things.
void add_pose(const Take& take, Take& all) {
  constexpr double kSameTurn = 2.0 * kPi / 180.0, kSameHeight = 0.05;  // m
  if (take.up && all.up && take.up->dot(*all.up) < std::cos(kSameTurn))
    throw InputError(take.name, "up", "another direction", "that of a take before it: takes of one camera");
  if (take.camera_height && all.camera_height && std::abs(*take.camera_height - *all.camera_height) > kSameHeight)
    throw InputError(take.name, "camera_height", fmt::format("{:.3g} m", *take.camera_height), fmt::format("{:.3g} m, as a take before it has: takes of one camera", *all.camera_height));
  if (!all.up) all.up = take.up;
  if (!all.camera_height) all.camera_height = take.camera_height;
}

/// What is odd about who is who.
void remark_on_people(const Take& take, const std::vector<int>& persons, std::vector<std::string>& remarks) {
  const auto nobody = static_cast<std::size_t>(std::count(persons.begin(), persons.end(), -1));
  if (10 * nobody > persons.size())
    remarks.push_back(fmt::format("{} of {} detections are taken for nobody: \"people\" is {}; set it to how many there are, or \"labels\" to whom to follow", nobody, persons.size(), take.people));
  int never = 0;
  for (int p = 0; p < take.people; ++p) never += std::find(persons.begin(), persons.end(), p) == persons.end();
  if (never > 0) remarks.push_back(fmt::format("{} of {} people are never seen", never, take.people));
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
    add_pose(take, all);
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
    if (&take != &takes.front()) {
      all.remarks.insert(all.remarks.end(), take.remarks.begin(), take.remarks.end());
      all.masks.insert(all.masks.end(), take.masks.begin(), take.masks.end());
    }
    remark_on_people(take, persons, all.remarks);
  }
  undo_slips(all);
  return all;
}

}  // namespace unseen::interactions
