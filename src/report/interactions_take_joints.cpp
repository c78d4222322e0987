// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "io/text.h"
#include "report/i3db_parts.h"
#include "report/interactions_take_parts.h"
#include "unseen/core/error.h"
#include "unseen/core/quantile.h"

namespace unseen::report {

using namespace interactions;

namespace {

constexpr std::array<std::array<Joint, 3>, 3> kBetween = {{{pelvis, left_hip, right_hip}, {thorax, left_shoulder, right_shoulder}, {neck, thorax, head}}};

/// Along the bones from the head down to an ankle, m: the same in all postures.
double stature_of(const Pose& pose) {
  constexpr std::array<Joint, 7> kDown = {head, neck, thorax, pelvis, right_hip, right_knee, right_ankle};
  double length = 0;
  for (std::size_t i = 1; i < kDown.size(); ++i) length += (pose.col(kDown[i]) - pose.col(kDown[i - 1])).norm();
  return length;
}

/// Throws InputError if the poses cannot be metres; those of no size say nothing.
void check_statures(const std::filesystem::path& file, const std::vector<Detection>& detections) {
  constexpr double kSmallest = 0.3, kTallest = 3.0;  // m
  std::vector<double> statures;
  for (const Detection& d : detections)
    if (const double stature = d.local ? stature_of(*d.local) : 0.0; stature > 0.0) statures.push_back(stature);
  if (statures.empty()) return;
  const double usual = median(std::move(statures));
  if (usual < kSmallest || usual > kTallest)
    throw InputError(file.string(), "frames", fmt::format("people {:.4g} m tall", usual), fmt::format("{} to {} m: is the unit metres?", kSmallest, kTallest));
}

}  // namespace

Detection detection_of(int frame, std::span<const double> keypoints, const JointMap& map) {
  Detection d;
  d.frame = frame;
  for (int j = 0; j < kJoints; ++j) {
    const int from = map[static_cast<std::size_t>(j)];
    if (from < 0) continue;
    const std::size_t at = 3 * static_cast<std::size_t>(from);
    d.confidence[j] = std::clamp(keypoints[at + 2], 0.0, 1.0);
    if (d.confidence[j] > 0.0) d.pixels.col(j) = Vec2(keypoints[at], keypoints[at + 1]);
  }
  make_from_neighbours(d);
  return d;
}

void make_from_neighbours(Detection& d) {
  for (const auto& [joint, a, b] : kBetween) {
    if (d.confidence[joint] > 0.0) continue;
    d.confidence[joint] = std::min(d.confidence[a], d.confidence[b]);
    if (d.confidence[joint] > 0.0) d.pixels.col(joint) = 0.5 * (d.pixels.col(a) + d.pixels.col(b));
  }
}

void make_from_neighbours(Pose& pose) {
  for (const auto& [joint, a, b] : kBetween) pose.col(joint) = 0.5 * (pose.col(a) + pose.col(b));
}

Pose root_centred(const Pose& pose) { return pose.colwise() - pose.col(pelvis); }

int last_number(const std::string& text) {
  const std::size_t end = text.find_last_of("0123456789");
  if (end == std::string::npos) return -1;
  const std::size_t before = text.find_last_not_of("0123456789", end);
  const std::size_t begin = before == std::string::npos ? 0 : before + 1;
  std::size_t number = 0;
  if (!io::to_count(std::string_view(text).substr(begin, end + 1 - begin), number) || number >= kMostFrames) return -1;
  return static_cast<int>(number);
}

void read_lifted(const std::filesystem::path& file, std::vector<Detection>& detections) {
  const nlohmann::json parsed = parse_joint_file(file, "initial 3D poses");
  std::map<int, std::vector<Detection*>> by_frame;
  for (Detection& d : detections) by_frame[d.frame].push_back(&d);
  for (const JsonField& frame : JsonField(parsed, file.string())["frames"].list(kMostFrames)) {
    const auto at = by_frame.find(frame["frame"].index(kMostFrames));
    const auto people = frame["people"].list(kMostDetections);
    const std::size_t there = at == by_frame.end() ? 0 : at->second.size();
    if (people.size() != there) frame["people"].fail(fmt::format("{}, as the joints have in this frame", there));
    for (std::size_t p = 0; p < people.size(); ++p) {
      if (people[p].is_null()) continue;
      const auto joints = people[p].list(kJoints);
      if (joints.size() != kJoints) people[p].fail(fmt::format("{} joints", kJoints));
      Pose pose;
      for (std::size_t j = 0; j < kJoints; ++j) pose.col(static_cast<Eigen::Index>(j)) = joints[j].vector();
      at->second[p]->local = root_centred(pose);
    }
  }
  check_statures(file, detections);
}

}  // namespace unseen::report
