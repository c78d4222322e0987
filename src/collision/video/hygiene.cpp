// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/hygiene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr int kNeighbours = 4;        // frames on either side that a frame's change is compared with
constexpr double kRepeats = 0.08;     // share of the neighbours' change that a repeated frame may show
constexpr int kLongestHold = 8;       // frames that repeat one
constexpr double kUneven = 0.25;      // of a frame time
constexpr double kDrift = 0.5;        // frame times off an even rate, by steps that each are less uneven
constexpr double kTick = 1e-3;        // s: Matroska rounds stamps to it
constexpr int kLongestPeriod = 12;    // frames
constexpr int kFewestRepeats = 5;     // that make a period
constexpr double kRegular = 0.4;      // share of the neighbours' change that repeats at regular places may show, most of them
constexpr double kMostRepeats = 0.6;  // share of the frames
constexpr double kAlike = 0.7;        // share of the largest change of a phase that the others of no repeat must show: what swings slows down first
constexpr double kCaughtUp = 1.6;     // times as much changes after a repeat where a frame was lost instead
constexpr double kTelling = 0.3;      // share of what most frames change by: less tells of no repeat
constexpr double kFlicker = 0.5;      // share of the change that the light as a whole may make, and
constexpr double kLeastFlicker = 0.2;  // grey levels, less than which a moving body and compression make

/// Whether all stamps are whole milliseconds.
bool are_rounded(const std::vector<double>& stamps) {
  return std::all_of(stamps.begin(), stamps.end(), [](double t) { return std::abs(t / kTick - std::round(t / kTick)) < 1e-3; });
}

/// The typical step between stamps that follow each other, s; 0 = there is none. Of rounded ones the file's own rate is nearer than their median.
double typical_step(const std::vector<double>& stamps, double file_fps) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < stamps.size(); ++k)
    if (stamps[k] > stamps[k - 1]) steps.push_back(stamps[k] - stamps[k - 1]);
  const double typical = median(std::move(steps));
  if (typical > 0.0 && file_fps > 0.0 && are_rounded(stamps) && std::abs(1.0 / file_fps - typical) < kTick) return 1.0 / file_fps;
  return typical;
}

/// Whether rounded stamps are those of even frames, at about this rate. Some may be left out.
bool are_even_but_rounded(const std::vector<double>& stamps, double fps) {
  constexpr double kSameRate = 0.005;
  const auto last = std::max_element(stamps.begin(), stamps.end()) - stamps.begin();
  const double step = (stamps[last] - stamps[0]) / static_cast<double>(std::max<std::ptrdiff_t>(1, last));
  if (!are_rounded(stamps) || std::abs(step * fps - 1.0) > kSameRate) return false;
  for (std::size_t k = 1; k < stamps.size(); ++k)
    if (stamps[k] > stamps[0] && std::abs(stamps[k] - stamps[0] - static_cast<double>(k) * step) > kTick + kUneven * step) return false;
  return true;
}

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

/// Steps between frames, in frame times of the typical step. Containers leave some stamps out: what is between the two beside them is shared out.
std::vector<double> steps_of(const std::vector<double>& stamps, double typical) {
  std::vector<double> steps(stamps.size() - 1, 1.0);
  std::size_t last = 0;  // that has a stamp
  for (std::size_t k = 1; k < stamps.size(); ++k) {
    if (stamps[k] <= stamps[last]) continue;
    const double between = (stamps[k] - stamps[last]) / typical / static_cast<double>(k - last);
    std::fill(steps.begin() + last, steps.begin() + k, between);
    last = k;
  }
  return steps;
}

/// Frame times that the frames are off an even rate at most, as those of a phone that takes fewer where it gets darker.
double drift_of(const std::vector<double>& steps) {
  const double mean = std::accumulate(steps.begin(), steps.end(), 0.0) / static_cast<double>(steps.size());
  double at = 0.0, drift = 0.0;
  for (const double step : steps) drift = std::max(drift, std::abs(at += step - mean));
  return drift;
}

}  // namespace

bool lasts_as_announced(const std::vector<double>& stamps, int announced, double fps) {
  constexpr double kSlack = 2.5;  // frame times
  const double step = typical_step(stamps, fps);
  if (step == 0.0 || fps <= 0.0) return false;
  const std::vector<double> steps = steps_of(stamps, step);
  const bool uneven = std::any_of(steps.begin(), steps.end(), [](double s) { return std::abs(s - 1.0) > kUneven; });
  const auto last = std::max_element(stamps.begin(), stamps.end()) - stamps.begin();  // those after it often have no stamp
  const double lasts = (stamps[last] - stamps.front()) * static_cast<double>(stamps.size() - 1) / static_cast<double>(std::max<std::ptrdiff_t>(1, last));
  return uneven && lasts + kSlack * std::max(step, 1.0 / fps) > announced / fps;
}

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

std::vector<double> frame_times(const std::vector<double>& stamps, double file_fps, std::optional<double> fps, const std::string& name,
                                Context& context) {
  const double rate = fps.value_or(file_fps);
  std::vector<double> times(stamps.size());
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = static_cast<double>(k) / rate;
  const double typical = typical_step(stamps, file_fps);
  if (typical == 0.0 || are_even_but_rounded(stamps, file_fps) || are_even_but_rounded(stamps, rate)) return times;
  const std::vector<double> steps = steps_of(stamps, typical);
  const auto uneven = std::count_if(steps.begin(), steps.end(), [](double s) { return std::abs(s - 1.0) > kUneven; });
  const double longest = *std::max_element(steps.begin(), steps.end()), drift = drift_of(steps);
  if (uneven == 0 && drift < kDrift) return times;
  const std::string how = uneven > 0 ? fmt::format("{} of {} steps, the longest {:.1f} frame times", uneven, steps.size(), longest)
                                     : fmt::format("they drift by {:.1f} frame times", drift);
  context.warn(fmt::format("{}: the time stamps are uneven ({}); they are used instead of an even frame rate", name, how));
  double step = fps ? 1.0 / *fps : typical;  // the file's own rate counts the missing frames too
  if (fps && uneven == 0) step *= static_cast<double>(steps.size()) / std::accumulate(steps.begin(), steps.end(), 0.0);  // a rate of all of them
  for (std::size_t k = 1; k < times.size(); ++k) times[k] = times[k - 1] + steps[k - 1] * step;
  return times;
}

}  // namespace unseen::collision
