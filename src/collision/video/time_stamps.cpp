// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/video/time_stamps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr double kDrift = 0.5;        // frame times off an even rate, by steps that each are less uneven
constexpr double kTick = 1e-3;        // s: Matroska rounds stamps to it

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
