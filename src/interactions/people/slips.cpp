// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/people/slips.h"

#include <algorithm>
#include <array>
#include <map>

namespace unseen::interactions {
namespace {

constexpr double kLongest = 0.3;     // s, that sides are wrong for, or between detections that are compared
constexpr double kLeftOver = 0.25;       // of the squared jumps, that exchanging may leave
constexpr double kJitter = 25.0;      // px²: smaller jumps tell nothing
constexpr double kAlone = 3.0;       // times as far as the median joint
constexpr double kThereAndBack = 0.14;  // s

/// First and last of the joints that are taken for those of the other side together.
struct Limbs {
  int first, last;
};
constexpr std::array<Limbs, 2> kLimbs = {{{right_ankle, left_ankle}, {right_wrist, left_wrist}}};

void exchange(Detection& detection, const Limbs& limbs) {
  const Detection before = detection;
  for (int k = limbs.first; k <= limbs.last; ++k) {
    const int other = other_side(k);
    detection.pixels.col(k) = before.pixels.col(other);
    detection.confidence[k] = before.confidence[other];
    if (before.local) detection.local->col(k) = before.local->col(other);
  }
}

/// px²: confidence-weighted mean of squared motion of some limbs, or of those of one side to those of the other.
double limb_jump(const Detection& a, const Detection& b, const Limbs& limbs, bool exchanged) {
  double weight = 0, squared = 0;
  for (int k = limbs.first; k <= limbs.last; ++k) {
    const int to = exchanged ? other_side(k) : k;
    const double both = a.confidence[k] * b.confidence[to];
    weight += both;
    squared += both * (b.pixels.col(to) - a.pixels.col(k)).squaredNorm();
  }
  return weight > 0 ? squared / weight : 0.0;
}

using PersonTrack = std::vector<Detection*>;  // of a person, by frame

double apart(const Take& take, const Detection& a, const Detection& b) { return (b.frame - a.frame) / take.fps; }

void put_sides_right(const Take& take, const PersonTrack& track, const Limbs& limbs) {
  for (std::size_t first = 1; first < track.size(); ++first) {
    if (apart(take, *track[first - 1], *track[first]) > kLongest || limb_jump(*track[first - 1], *track[first], limbs, false) < kJitter) continue;
    for (std::size_t last = first; last + 1 < track.size() && apart(take, *track[first], *track[last]) <= kLongest && apart(take, *track[last], *track[last + 1]) <= kLongest; ++last) {
      const auto jumps = [&](bool exchanged) { return limb_jump(*track[first - 1], *track[first], limbs, exchanged) + limb_jump(*track[last], *track[last + 1], limbs, exchanged); };
      const double as_told = jumps(false);
      if (as_told < 2.0 * kJitter || jumps(true) > kLeftOver * as_told) continue;
      for (std::size_t i = first; i <= last; ++i) exchange(*track[i], limbs);
      break;
    }
  }
}

/// px²: of each joint, and what it takes to be a jump; joints not seen in both have not moved.
struct Moves {
  std::array<double, kJoints> squared{};
  double far = 0;
};
Moves moves(const Detection& a, const Detection& b) {
  Moves m;
  std::array<double, kJoints> seen;
  std::size_t count = 0;
  for (int k = 0; k < kJoints; ++k) {
    if (!(a.confidence[k] * b.confidence[k] > 0)) continue;
    m.squared[static_cast<std::size_t>(k)] = (b.pixels.col(k) - a.pixels.col(k)).squaredNorm();
    seen[count++] = m.squared[static_cast<std::size_t>(k)];
  }
  m.far = lone_jump({seen.data(), count});
  return m;
}

void leave_out_jumps(const Take& take, const PersonTrack& track) {
  for (std::size_t i = 1; i + 1 < track.size(); ++i) {
    if (apart(take, *track[i - 1], *track[i + 1]) > kThereAndBack) continue;
    const Moves there = moves(*track[i - 1], *track[i]), back = moves(*track[i], *track[i + 1]), both = moves(*track[i - 1], *track[i + 1]);
    for (std::size_t k = 0; k < kJoints; ++k)
      if (there.squared[k] > there.far && back.squared[k] > back.far && both.squared[k] < kLeftOver * std::min(there.squared[k], back.squared[k]))
        track[i]->confidence[static_cast<int>(k)] = 0.0;
  }
}

}  // namespace

double lone_jump(std::span<double> squares) {
  if (squares.empty()) return kAlone * kAlone * kJitter;
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return kAlone * kAlone * (*middle + kJitter);
}

void undo_slips(Take& take) {
  std::map<int, PersonTrack> people;
  for (Detection& detection : take.detections) people[detection.person].push_back(&detection);
  for (auto& [person, track] : people) {
    std::stable_sort(track.begin(), track.end(), [](const Detection* a, const Detection* b) { return a->frame < b->frame; });
    for (const Limbs& limbs : kLimbs) put_sides_right(take, track, limbs);
    leave_out_jumps(take, track);
  }
}

}  // namespace unseen::interactions
