// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/repeats.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "collision/video/time_stamps.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr int kNeighbours = 4;        // frames on either side that a frame's change is compared with
constexpr double kRepeats = 0.08;     // share of the neighbours' change that a repeated frame may show
constexpr int kLongestHold = 8;       // frames that repeat one
constexpr int kLongestPeriod = 12;    // frames
constexpr int kFewestRepeats = 5;     // that make a period
constexpr double kRegular = 0.4;      // share of the neighbours' change that repeats at regular places may show, most of them
constexpr double kMostRepeats = 0.6;  // share of the frames
constexpr double kAlike = 0.7;        // share of the largest change of a phase that the others of no repeat must show: what swings slows down first
constexpr double kCaughtUp = 1.6;     // times as much changes after a repeat where a frame was lost instead
constexpr double kTelling = 0.3;      // share of what most frames change by: less tells of no repeat
constexpr double kFlicker = 0.5;      // share of the change that the light as a whole may make, and
constexpr double kLeastFlicker = 0.2;  // grey levels, less than which a moving body and compression make

/// What changes around a frame: the second largest of its neighbours' changes; 0 where there are none.
double change_near(const std::vector<double>& change, int frame) {
  std::vector<double> near;
  for (int j = std::max(1, frame - kNeighbours); j <= std::min(static_cast<int>(change.size()) - 1, frame + kNeighbours); ++j)
    if (j != frame) near.push_back(change[j]);
  if (near.size() < 2) return 0.0;
  std::nth_element(near.begin(), near.begin() + 1, near.end(), std::greater<>());
  return near[1];
}

/// What repeats in each period, as conversion to a higher rate leaves it.
struct Period {
  std::vector<char> repeats;  ///< by phase; empty = there are none
  bool even = true;           ///< no frame was lost where one repeats
};

/// `share`: of the change nearby that a frame shows; negative where it tells nothing.
Period repeats_of_period(const std::vector<double>& share, int period) {
  Period found{std::vector<char>(period, 0), true};
  std::vector<double> typical(period, 0.0);
  for (int phase = 0; phase < period; ++phase) {
    std::vector<double> here;
    for (std::size_t k = phase; k < share.size(); k += period)
      if (share[k] >= 0.0) here.push_back(share[k]);
    if (static_cast<int>(here.size()) < kFewestRepeats) return {};
    found.repeats[phase] = quantile(here, 0.9) < kRegular;
    if (!found.repeats[phase] && quantile(here, 0.2) < kRegular) return {};
    typical[phase] = median(std::move(here));
  }
  const auto some = static_cast<double>(std::count(found.repeats.begin(), found.repeats.end(), 1));
  if (some == 0 || some > kMostRepeats * period) return {};
  const double most = *std::max_element(typical.begin(), typical.end());
  std::vector<double> after, others;
  for (int phase = 0; phase < period; ++phase)
    if (!found.repeats[phase]) (found.repeats[(phase + period - 1) % period] ? after : others).push_back(typical[phase]);
  found.even = others.empty() || median(after) < kCaughtUp * median(others);
  for (int phase = 0; phase < period && found.even; ++phase)
    if (!found.repeats[phase] && typical[phase] < kAlike * most) return {};
  return found;
}

Period shortest_period(const std::vector<double>& share) {
  for (int period = 2; period <= kLongestPeriod; ++period)
    if (Period found = repeats_of_period(share, period); !found.repeats.empty()) return found;
  return {};
}

/// Frames in which next to nothing changes, nor moves where that is known: light that flickers may stand still for one. What stands still for long, before it moves or after,
/// repeats nothing.
std::vector<char> doubled_frames(const std::vector<double>& change, const std::vector<double>& moved) {
  const int count = static_cast<int>(change.size());
  std::vector<char> doubled(change.size(), 0);
  for (int k = 1; k < count; ++k) {
    const double least = kRepeats * change_near(change, k);
    if (change[k] >= least || (!moved.empty() && moved[k] > kRepeats * change_near(moved, k))) continue;
    int first = k, last = k;  // of the still frames
    while (first > 1 && change[first - 1] < least) --first;
    while (last + 1 < count && change[last + 1] < least) ++last;
    doubled[k] = last - first < kLongestHold;
  }
  return doubled;
}

/// Of the change nearby, what each frame shows; −1 where little changes all about, which tells nothing.
std::vector<double> shares_of_neighbours(const std::vector<double>& change) {
  std::vector<double> share(change.size(), -1.0);
  const double most = quantile(change, 0.9);
  for (int k = 1; k < static_cast<int>(change.size()); ++k)
    if (const double near = change_near(change, k); near > kTelling * most) share[k] = change[k] / near;
  return share;
}

/// Whether the light changes as a whole: lamps have periods of their own.
bool flickers(const std::vector<double>& change, const std::vector<double>& brightness) {
  std::vector<double> lighter;
  for (std::size_t k = 1; k < brightness.size(); ++k) lighter.push_back(std::abs(brightness[k] - brightness[k - 1]));
  return median(std::move(lighter)) > std::max(kLeastFlicker, kFlicker * median(change));
}

/// Marks what repeats in each period; where none takes the place of a lost frame, it is a conversion.
void mark(const Period& period, Repeats& repeats) {
  const std::size_t length = period.repeats.size();
  if (period.even) {
    repeats.converted.assign(repeats.doubled.size(), 0);
    repeats.frames_each = static_cast<double>(length) / static_cast<double>(std::count(period.repeats.begin(), period.repeats.end(), 0));
  }
  for (std::size_t k = 1; k < repeats.doubled.size(); ++k) {
    if (!period.repeats[k % length]) continue;
    repeats.doubled[k] = 1;
    if (period.even) repeats.converted[k] = 1;
  }
}

}  // namespace

Repeats find_repeats(const std::vector<double>& change, const std::vector<double>& brightness, const std::vector<double>& moved) {
  Repeats repeats{doubled_frames(change, moved), {}, 1.0};
  if (change.size() < 2 || flickers(change, brightness)) return repeats;
  Period period;
  if (!moved.empty()) period = shortest_period(shares_of_neighbours(moved));
  if (period.repeats.empty()) period = shortest_period(shares_of_neighbours(change));
  if (!period.repeats.empty()) mark(period, repeats);
  return repeats;
}

bool share_out_times(const Repeats& repeats, std::vector<double>& times) {
  if (repeats.converted.empty()) return false;
  const double step = (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  for (std::size_t k = 0; k < times.size(); ++k)
    if (std::abs(times[k] - times.front() - static_cast<double>(k) * step) > kUneven * step) return false;  // stamps tell better
  for (std::size_t k = 1; k < times.size(); ++k) times[k] = times[k - 1] + (repeats.converted[k] ? 0.0 : repeats.frames_each * step);
  return true;
}

}  // namespace unseen::collision
