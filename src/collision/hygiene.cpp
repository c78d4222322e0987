// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/hygiene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr int kNeighbours = 4;        // frames on either side that a frame's change is compared with
constexpr double kRepeats = 0.08;     // share of the neighbours' change that a repeated frame may show
constexpr double kUneven = 0.25;      // of a frame time
constexpr double kTick = 1e-3;        // s: Matroska rounds stamps to it
constexpr int kLongestPeriod = 12;    // frames
constexpr int kFewestRepeats = 5;     // that make a period
constexpr double kRegular = 0.4;      // share of the neighbours' change that repeats at regular places may show, most of them, …
constexpr double kFlicker = 0.5;       // share of the change that the light as a whole may make
constexpr double kTelling = 0.3;      // … where that is more than this share of what changes most

/// Whether all stamps are whole milliseconds, and tell a frame time no better.
bool are_rounded(const std::vector<double>& stamps) {
  return std::all_of(stamps.begin(), stamps.end(), [](double t) { return std::abs(t / kTick - std::round(t / kTick)) < 1e-3; });
}

/// The typical step between stamps that follow each other, s; 0 = there is none. Where they are rounded, as many steps as they may be share what they sum up to.
double typical_step(const std::vector<double>& stamps) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < stamps.size(); ++k)
    if (stamps[k] > stamps[k - 1]) steps.push_back(stamps[k] - stamps[k - 1]);
  double typical = median(steps);
  if (typical == 0.0 || !are_rounded(stamps)) return typical;
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    double sum = 0, count = 0;
    for (const double step : steps) sum += step, count += std::max(1.0, std::round(step / typical));
    typical = sum / count;
  }
  return typical;
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

/// Which frames of each period repeat the one before, as conversion to a higher rate leaves them: clearly less changes there, again and again.
std::vector<char> repeats_of_period(const std::vector<double>& share, int period) {
  std::vector<char> repeats(period, 0);
  std::vector<double> others;
  for (int phase = 0; phase < period; ++phase) {
    std::vector<double> here;
    for (std::size_t k = phase; k < share.size(); k += period)
      if (share[k] >= 0.0) here.push_back(share[k]);
    repeats[phase] = static_cast<int>(here.size()) >= kFewestRepeats && quantile(here, 0.9) < kRegular;
    if (!repeats[phase]) others.insert(others.end(), here.begin(), here.end());
  }
  const auto some = std::count(repeats.begin(), repeats.end(), 1);
  if (some == 0 || others.empty() || quantile(others, 0.1) < kRegular) return {};
  return repeats;
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

}  // namespace

Repeats find_repeats(const std::vector<double>& change, const std::vector<double>& brightness) {
  Repeats repeats{std::vector<char>(change.size(), 0), 1.0};
  std::vector<double> share(change.size(), -1.0);  // of the change nearby; −1 where that is little
  const double most = change.size() < 2 ? 0.0 : *std::max_element(change.begin() + 1, change.end());
  for (int k = 1; k < static_cast<int>(change.size()); ++k) {
    const double near = change_near(change, k);
    repeats.doubled[k] = change[k] < kRepeats * near;
    if (near > kTelling * most) share[k] = change[k] / near;
  }
  std::vector<double> lighter;
  for (std::size_t k = 1; k < brightness.size(); ++k) lighter.push_back(std::abs(brightness[k] - brightness[k - 1]));
  if (median(std::move(lighter)) > kFlicker * median(change)) return repeats;  // lamps have periods of their own
  for (int period = 2; period <= kLongestPeriod; ++period) {
    const std::vector<char> regular = repeats_of_period(share, period);
    if (regular.empty()) continue;
    for (std::size_t k = 1; k < change.size(); ++k) repeats.doubled[k] = regular[k % period];
    repeats.frames_each = static_cast<double>(period) / static_cast<double>(std::count(regular.begin(), regular.end(), 0));
    break;
  }
  return repeats;
}

void share_out_times(const Repeats& repeats, std::vector<double>& times) {
  if (repeats.frames_each == 1.0) return;
  const double step = repeats.frames_each * (times.back() - times.front()) / static_cast<double>(times.size() - 1);
  for (std::size_t k = 1; k < times.size(); ++k) times[k] = times[k - 1] + (repeats.doubled[k] ? 0.0 : step);
}

std::vector<double> frame_times(const std::vector<double>& stamps, double file_fps, std::optional<double> fps, const std::string& name,
                                Context& context) {
  const double rate = fps.value_or(file_fps);
  std::vector<double> times(stamps.size());
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = static_cast<double>(k) / rate;
  const double typical = typical_step(stamps);
  if (typical == 0.0) return times;
  const std::vector<double> steps = steps_of(stamps, typical);
  const double off = kUneven + (are_rounded(stamps) ? kTick / typical : 0.0);
  const auto uneven = std::count_if(steps.begin(), steps.end(), [&](double s) { return std::abs(s - 1.0) > off; });
  if (uneven == 0) return times;
  const double longest = *std::max_element(steps.begin(), steps.end());
  context.warn(fmt::format("{}: the time stamps are uneven ({} of {} steps, the longest {:.1f} frame times); they are used instead of "
                           "an even frame rate", name, uneven, steps.size(), longest));
  const double step = fps ? 1.0 / *fps : typical;  // the file's own rate counts the missing frames too
  for (std::size_t k = 1; k < times.size(); ++k) times[k] = times[k - 1] + steps[k - 1] * step;
  return times;
}

}  // namespace unseen::collision
