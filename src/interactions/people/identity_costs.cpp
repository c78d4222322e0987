// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/people/identity_costs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "interactions/people/slips.h"

namespace unseen::interactions {
namespace {

constexpr double kMemory = 3.0;        ///< s
constexpr int kMostSlots = 45;         ///< of memory, which bounds the number of links
constexpr double kMostLinks = 1e6;
constexpr double kSure = 4.0;          ///< a neighbour is sure if the next best has moved so many times its squared distance
constexpr double kNoise = 25.0;        ///< px², added to both
constexpr double kAlike = 0.8;         ///< of the weight: as many joints of one side are seen as of the other
constexpr double kSureWithin = 0.5;    ///< s
constexpr int kVelocitySteps = 3;      ///< neighbours that a velocity is the mean of

/// Confidence-weighted sums over joints of motion and squared motion that a velocity leaves; joints that jump alone count as three times the median. px
struct Motion {
  double weight = 0, squared = 0;
  Vec2 sum = Vec2::Zero();
};
Motion motion(const Detection& a, const Detection& b, const Vec2& predicted, bool exchange) {
  struct Moved {
    double weight, squared;
    Vec2 by;
  };
  std::array<Moved, kJoints> moved;
  std::array<double, kJoints> squares;
  std::size_t count = 0;
  for (int j = 0; j < kJoints; ++j) {
    const int k = exchange ? other_side(j) : j;
    const double weight = a.confidence[j] * b.confidence[k];
    if (!(weight > 0)) continue;
    const Vec2 by = b.pixels.col(k) - a.pixels.col(j) - predicted;
    squares[count] = by.squaredNorm();
    moved[count] = {weight, squares[count], by};
    ++count;
  }
  Motion m;
  if (count == 0) return m;
  const double most = lone_jump({squares.data(), count});
  for (std::size_t i = 0; i < count; ++i) {
    const double kept = std::min(1.0, most / std::max(moved[i].squared, 1e-12));
    m.weight += moved[i].weight;
    m.sum += moved[i].weight * std::sqrt(kept) * moved[i].by;
    m.squared += moved[i].weight * kept * moved[i].squared;
  }
  return m;
}

/// The same, with left and right exchanged in one of them if they have moved less so: detectors take the one for the other.
Motion motion(const Detection& a, const Detection& b, const Vec2& predicted) {
  const Motion as_told = motion(a, b, predicted, false);
  Motion exchanged = motion(a, b, predicted, true);
  if (!(exchanged.weight > kAlike * as_told.weight)) return as_told;
  const double scale = as_told.weight / exchanged.weight;
  exchanged = {as_told.weight, scale * exchanged.squared, scale * exchanged.sum};
  return exchanged.squared < as_told.squared ? exchanged : as_told;
}

/// The detection of `others` that is surely the same person as `from`; −1 if that is not sure.
int sure_neighbour(const Take& take, int from, const std::vector<int>& others) {
  int best = -1;
  double least = std::numeric_limits<double>::infinity(), second = least;
  for (const int to : others) {
    const Motion m = motion(take.detections[static_cast<std::size_t>(from)], take.detections[static_cast<std::size_t>(to)], Vec2::Zero());
    const double squared = m.weight > 0 ? m.squared / m.weight + kNoise : std::numeric_limits<double>::infinity();
    if (squared < least) {
      second = least;
      least = squared;
      best = to;
    } else {
      second = std::min(second, squared);
    }
  }
  return second >= kSure * least ? best : -1;
}

/// Mean velocity along up to three sure neighbours in one direction of time.
std::optional<Vec2> velocity(const Take& take, const std::vector<int>& neighbour, int from) {
  Vec2 moved = Vec2::Zero();
  int at = from;
  for (int step = 0; step < kVelocitySteps && neighbour[static_cast<std::size_t>(at)] >= 0; ++step) {
    const int next = neighbour[static_cast<std::size_t>(at)];
    const Motion m = motion(take.detections[static_cast<std::size_t>(at)], take.detections[static_cast<std::size_t>(next)], Vec2::Zero());
    moved += m.sum / m.weight;
    at = next;
  }
  const int frames = take.detections[static_cast<std::size_t>(at)].frame - take.detections[static_cast<std::size_t>(from)].frame;
  if (frames == 0) return std::nullopt;
  return moved / frames;
}

void set_velocities(const Take& take, Sightings& s) {
  const std::size_t count = take.detections.size();
  std::vector<int> next(count, -1), previous(count, -1);
  for (std::size_t slot = 0; slot + 1 < s.frames.size(); ++slot) {
    if (double(s.frames[slot + 1]) - s.frames[slot] > kSureWithin * take.fps + 1) continue;
    for (const int from : s.at[slot]) {
      const int to = sure_neighbour(take, from, s.at[slot + 1]);
      if (to < 0 || sure_neighbour(take, to, s.at[slot]) != from) continue;
      next[static_cast<std::size_t>(from)] = to;
      previous[static_cast<std::size_t>(to)] = from;
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    s.before.push_back(velocity(take, previous, static_cast<int>(i)));
    s.after.push_back(velocity(take, next, static_cast<int>(i)));
  }
}

}  // namespace

Sightings sightings_of(const Take& take) {
  Sightings s;
  std::map<int, std::vector<int>> by_frame;
  for (std::size_t i = 0; i < take.detections.size(); ++i) by_frame[take.detections[i].frame].push_back(static_cast<int>(i));
  s.slot.resize(take.detections.size());
  double most = 1;
  for (const auto& [frame, detections] : by_frame) {
    for (const int i : detections) s.slot[static_cast<std::size_t>(i)] = static_cast<int>(s.frames.size());
    s.frames.push_back(frame);
    s.at.push_back(detections);
    most = std::max(most, static_cast<double>(detections.size()));
  }
  s.half_diagonal = std::max(std::hypot(take.camera.width, take.camera.height) / 2, 1.0);
  const double links_a_slot = most * static_cast<double>(take.detections.size());
  s.memory = static_cast<int>(std::clamp(std::min({kMemory * take.fps, double(kMostSlots), kMostLinks / std::max(links_a_slot, 1.0)}), 1.0, double(kMostSlots)));
  set_velocities(take, s);
  return s;
}

double presence_cost(const Detection& detection) { return -detection.confidence.mean(); }

double leave_cost(const Detection& detection) {
  const double seen = detection.confidence.mean();
  return kLeave * seen * seen;
}

double link_cost(const Take& take, const Sightings& s, int from, int to) {
  const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(to);
  const double frames = double(take.detections[b].frame) - take.detections[a].frame;
  double squared = std::numeric_limits<double>::infinity();
  for (const std::optional<Vec2>& v : {s.before[a], s.after[b]})
    if (v) squared = std::min(squared, motion(take.detections[a], take.detections[b], frames * *v).squared);
  if (!s.before[a] && !s.after[b]) squared = motion(take.detections[a], take.detections[b], Vec2::Zero()).squared;
  const int missed = s.slot[b] - s.slot[a] - 1;
  const double slow = std::min(1.0, take.fps / kMotionFps);
  return kMotion * slow * slow * squared / (kJoints * s.half_diagonal * s.half_diagonal * frames) + kAbsent * missed +
         std::min(kMissed * missed, leave_cost(take.detections[a]) + leave_cost(take.detections[b]));
}

double path_cost(const Take& take, const Sightings& s, const std::vector<int>& path) {
  const int slots = static_cast<int>(s.frames.size());
  if (path.empty()) return kAbsent * slots;
  const auto at = [&](std::size_t i) -> const Detection& { return take.detections[static_cast<std::size_t>(path[i])]; };
  const int first = s.slot[static_cast<std::size_t>(path.front())], missed = slots - 1 - s.slot[static_cast<std::size_t>(path.back())];
  double cost = kAbsent * (first + missed) + (first > 0 ? leave_cost(at(0)) : 0) + (missed > 0 ? leave_cost(at(path.size() - 1)) : 0);
  for (std::size_t i = 0; i < path.size(); ++i) {
    cost += presence_cost(at(i));
    if (i == 0) continue;
    const int slots_between = s.slot[static_cast<std::size_t>(path[i])] - s.slot[static_cast<std::size_t>(path[i - 1])];
    cost += slots_between <= s.memory ? link_cost(take, s, path[i - 1], path[i]) : leave_cost(at(i - 1)) + leave_cost(at(i)) + kAbsent * (slots_between - 1);
  }
  return cost;
}

}  // namespace unseen::interactions
