// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/database/cut.h"

#include <fmt/format.h>

#include "unseen/core/error.h"

namespace unseen::interactions {
namespace {

constexpr double kLongestGap = 0.5;     ///< s
constexpr double kSmoothRadius = 0.01;  ///< m
constexpr int kSmoothRounds = 10;
constexpr double kStillStep = 1.0;  ///< s between scenelets of somebody who stays

std::vector<double> arc_length(const std::vector<Vec3>& path) {
  std::vector<double> length(path.size(), 0.0);
  for (std::size_t i = 1; i < path.size(); ++i) length[i] = length[i - 1] + (path[i] - path[i - 1]).norm();
  return length;
}

void check(const RecordedFrame& frame, const RecordedFrame* before, const std::string& source) {
  if (!(frame.pose.cwiseAbs().maxCoeff() <= kFarthest) || !frame.pose.allFinite())
    throw InputError(source, fmt::format("frame {}", frame.frame), "a joint out of range", "joints in metres, within 1 km");
  if (before && frame.frame <= before->frame)
    throw InputError(source, "frames", fmt::format("{} after {}", frame.frame, before->frame), "ascending numbers");
}

void append(Track& track, const Pose& pose, bool valid, Action action) {
  track.poses.push_back(pose);
  track.valid.push_back(valid);
  track.actions.push_back(action);
}

}  // namespace

std::vector<Track> tracks_of(const std::vector<RecordedFrame>& frames, double fps, const std::string& source) {
  std::vector<Track> tracks;
  const RecordedFrame* before = nullptr;
  for (const RecordedFrame& frame : frames) {
    check(frame, before, source);
    if (!before || double(frame.frame) - before->frame > kLongestGap * fps + 1) {
      tracks.push_back({frame.frame, {}, {}, {}});
    } else {
      const int gap = frame.frame - before->frame;
      for (int i = 1; i < gap; ++i)
        append(tracks.back(), before->pose + double(i) / gap * (frame.pose - before->pose), false, 2 * i <= gap ? before->action : frame.action);
    }
    append(tracks.back(), frame.pose, true, frame.action);
    before = &frame;
  }
  return tracks;
}

std::vector<Vec3> smoothed(std::vector<Vec3> path) {
  std::vector<Vec3> sum(path.size() + 1, Vec3::Zero());
  for (int round = 0; round < kSmoothRounds; ++round) {
    const std::vector<double> length = arc_length(path);
    for (std::size_t i = 0; i < path.size(); ++i) sum[i + 1] = sum[i] + path[i];
    std::size_t first = 0, end = 0;
    for (std::size_t i = 0; i < path.size(); ++i) {
      while (length[i] - length[first] > kSmoothRadius) ++first;
      while (end < path.size() && length[end] - length[i] <= kSmoothRadius) ++end;
      path[i] = (sum[end] - sum[first]) / static_cast<double>(end - first);
    }
  }
  return path;
}

std::vector<Clip> cut(const Track& track, double fps, const SceneletOptions& options) {
  std::vector<Vec3> path;
  for (const Pose& pose : track.poses) path.push_back(pose.col(pelvis));
  const std::vector<double> length = arc_length(smoothed(std::move(path)));
  const int count = static_cast<int>(length.size());
  const double half_arc = options.arc_length / 2, half_time = options.longest / 2;
  const auto apart = [&](int i, int j) { return length[static_cast<std::size_t>(j)] - length[static_cast<std::size_t>(i)]; };
  const auto within = [&](int i, int j) { return apart(i, j) <= half_arc && (j - i) / fps <= half_time + 1e-9; };
  const auto covers = [&](int i, int j) { return apart(i, j) >= half_arc || (j - i + 1) / fps > half_time; };
  std::vector<Clip> clips;
  int first = 0, last = 0, previous = -1;
  for (int middle = 0; middle < count; ++middle) {
    if (previous >= 0 && apart(previous, middle) < options.step && (middle - previous) / fps < kStillStep - 1e-9) continue;
    previous = middle;
    if (!covers(0, middle) || !covers(middle, count - 1)) continue;
    while (!within(first, middle)) ++first;
    last = std::max(last, middle);
    while (last + 1 < count && within(middle, last + 1)) ++last;
    clips.push_back({first, middle, last});
  }
  return clips;
}

}  // namespace unseen::interactions
