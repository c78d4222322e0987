// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "interactions/evaluate/evaluate_parts.h"

namespace unseen::interactions {
namespace {

/// Joints that are measured: the pelvis is the origin of `local`, and no detector sees a neck.
bool measured(int joint) { return joint != pelvis && joint != neck; }

std::vector<PersonFrame>::const_iterator first_from(const Person& person, int frame) {
  return std::lower_bound(person.frames.begin(), person.frames.end(), frame, [](const PersonFrame& f, int n) { return f.frame < n; });
}

/// Diagonal of the rectangle on the ground, along the axes, of all true joints.
double ground_diagonal(const Recording& truth) {
  Vec2 low = Vec2::Constant(INFINITY), high = -low;
  for (const auto& person : truth.people)
    for (const RecordedFrame& f : person) {
      low = low.cwiseMin(f.pose.topRows<2>().rowwise().minCoeff());
      high = high.cwiseMax(f.pose.topRows<2>().rowwise().maxCoeff());
    }
  return (high - low).norm();
}

/// Sums over frames; each frame counts once, however many joints of it are measured.
struct Sum {
  int frames = 0;
  double local = 0, world = 0;

  void add(const PerJoint& local_errors, const PerJoint& world_errors, const std::array<bool, kJoints>& which) {
    int joints = 0;
    double l = 0, w = 0;
    for (int j = 0; j < kJoints; ++j)
      if (which[static_cast<std::size_t>(j)] && measured(j)) ++joints, l += local_errors[j], w += world_errors[j];
    if (joints == 0) return;
    ++frames;
    local += l / joints;
    world += w / joints;
  }
  std::optional<PoseScore> mean(double diagonal, int interpolated) const {
    if (frames == 0) return std::nullopt;
    return PoseScore{frames, interpolated, local / frames, diagonal > 0.0 ? world / frames / diagonal : 0.0};
  }
};

}  // namespace

const PersonFrame* frame_at(const Person& person, int frame) {
  const auto at = first_from(person, frame);
  return at != person.frames.end() && at->frame == frame ? &*at : nullptr;
}

Pose pose_at(const Person& person, int frame) {
  const auto after = first_from(person, frame);
  if (after == person.frames.end()) return person.frames.back().pose;
  if (after->frame == frame || after == person.frames.begin()) return after->pose;
  const PersonFrame& before = *(after - 1);
  const double t = static_cast<double>(frame - before.frame) / static_cast<double>(after->frame - before.frame);
  return (1.0 - t) * before.pose + t * after->pose;
}

void score_poses(const std::vector<Person>& found, const Recording& truth, const std::vector<int>& match, Evaluation& e) {
  const double diagonal = ground_diagonal(truth);
  Sum occluded, all;
  int occluded_between = 0, all_between = 0;
  std::array<bool, kJoints> every;
  every.fill(true);
  for (std::size_t p = 0; p < truth.people.size(); ++p) {
    if (match[p] < 0) continue;
    const Person& person = found[static_cast<std::size_t>(match[p])];
    for (const RecordedFrame& f : truth.people[p]) {
      const Pose pose = pose_at(person, f.frame);
      const Pose off = pose - f.pose, off_local = off.colwise() - off.col(pelvis);
      const PerJoint world = off.colwise().norm().transpose().array(), local = off_local.colwise().norm().transpose().array();
      const int before = occluded.frames;
      occluded.add(local, world, f.occluded);
      all.add(local, world, every);
      if (frame_at(person, f.frame)) continue;
      ++all_between;
      occluded_between += occluded.frames - before;
    }
  }
  e.occluded = occluded.mean(diagonal, occluded_between);
  e.all = all.mean(diagonal, all_between);
}

}  // namespace unseen::interactions
