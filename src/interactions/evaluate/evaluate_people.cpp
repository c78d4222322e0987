// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <map>

#include "interactions/evaluate/assignment.h"
#include "interactions/evaluate/evaluate_parts.h"

namespace unseen::interactions {
namespace {

double pelvis_distance(const PersonFrame& found, const RecordedFrame& truth) { return (found.pose.col(pelvis) - truth.pose.col(pelvis)).norm(); }

/// What is told apart: sit, stand up, walk, reach. Who stands may walk at once; who lies sits on a bed.
std::size_t told_apart(Action action) {
  switch (action) {
    case Action::sit: case Action::lie: return 0;
    case Action::stand_up: return 1;
    case Action::walk: case Action::stand: return 2;
    case Action::reach: return 3;
  }
  return 2;
}

constexpr double kAnyDistance = 1e9;  // m, wider than any scene
constexpr int kSeenJoints = 4;       // of somebody who is seen at all

bool is_seen(const RecordedFrame& truth) { return kJoints - std::count(truth.occluded.begin(), truth.occluded.end(), true) >= kSeenJoints; }

/// How far two poses are from each other as a camera sees them: the mean over joints of the distance of unit rays.
double seen_apart(const Pose& a, const Pose& b, const Vec3& camera) {
  return ((a.colwise() - camera).colwise().normalized() - (b.colwise() - camera).colwise().normalized()).colwise().norm().mean();
}

}  // namespace

std::vector<int> match_people(const std::vector<Person>& found, const std::vector<std::vector<RecordedFrame>>& truth) {
  Eigen::MatrixXd distance(truth.size(), found.size());
  for (std::size_t t = 0; t < truth.size(); ++t)
    for (std::size_t p = 0; p < found.size(); ++p) {
      double sum = 0;
      int frames = 0;
      for (const RecordedFrame& f : truth[t])
        if (const PersonFrame* at = frame_at(found[p], f.frame)) sum += pelvis_distance(*at, f), ++frames;
      distance(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(p)) = frames > 0 ? sum / frames : INFINITY;
    }
  return assign(distance, kAnyDistance);
}

void score_actions(const std::vector<Person>& found, const Recording& truth, const std::vector<int>& match, Evaluation& e) {
  constexpr std::size_t kTold = 4;
  e.confusion.assign(kTold, std::vector<int>(kTold, 0));
  int frames = 0, right = 0;
  for (std::size_t p = 0; p < truth.people.size(); ++p) {
    if (match[p] < 0) continue;
    for (const RecordedFrame& f : truth.people[p]) {
      const PersonFrame* at = f.has_action ? frame_at(found[static_cast<std::size_t>(match[p])], f.frame) : nullptr;
      if (!at) continue;
      const std::size_t row = told_apart(f.action), column = told_apart(at->action);
      ++e.confusion[row][column];
      ++frames;
      right += row == column;
    }
  }
  e.action_accuracy = frames > 0 ? static_cast<double>(right) / frames : 0.0;
}

double identity_share(const std::vector<Person>& found, const Recording& truth, const std::vector<int>& match) {
  std::map<int, std::vector<std::pair<std::size_t, const RecordedFrame*>>> by_frame;
  for (std::size_t p = 0; p < truth.people.size(); ++p)
    for (const RecordedFrame& f : truth.people[p])
      if (is_seen(f)) by_frame[f.frame].emplace_back(p, &f);
  int right = 0, frames = 0;
  for (const auto& [frame, people] : by_frame) {
    Eigen::MatrixXd distance(people.size(), found.size());
    for (std::size_t t = 0; t < people.size(); ++t)
      for (std::size_t p = 0; p < found.size(); ++p) {
        const PersonFrame* at = frame_at(found[p], frame);
        distance(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(p)) =
            at ? seen_apart(at->pose, people[t].second->pose, truth.T_world_camera.translation) : INFINITY;
      }
    const std::vector<int> best = assign(distance, kAnyDistance);
    for (std::size_t t = 0; t < people.size(); ++t) ++frames, right += best[t] >= 0 && best[t] == match[people[t].first];
  }
  return frames > 0 ? static_cast<double>(right) / frames : 0.0;
}

}  // namespace unseen::interactions
