// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/hygiene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace unseen::collision {
namespace {

constexpr int kNeighbours = 4;        // frames on either side that a frame's change is compared with
constexpr double kRepeats = 0.08;     // share of the neighbours' change that a repeated frame may show
constexpr double kUneven = 0.25;      // of a frame time

/// Steps between stamps in frame times of the median step; containers leave some stamps out, those count as one.
std::vector<double> steps_of(const std::vector<double>& stamps) {
  std::vector<double> steps, sorted;
  for (std::size_t k = 1; k < stamps.size(); ++k) {
    steps.push_back(stamps[k] - stamps[k - 1]);
    if (steps.back() > 0.0) sorted.push_back(steps.back());
  }
  if (sorted.empty()) return {};
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  const double typical = sorted[sorted.size() / 2];
  for (double& step : steps) step = step > 0.0 ? step / typical : 1.0;
  return steps;
}

}  // namespace

std::vector<char> doubled_frames(const std::vector<double>& change) {
  std::vector<char> doubled(change.size(), 0);
  const int count = static_cast<int>(change.size());
  for (int k = 1; k < count; ++k) {
    std::vector<double> near;
    for (int j = std::max(1, k - kNeighbours); j <= std::min(count - 1, k + kNeighbours); ++j)
      if (j != k) near.push_back(change[j]);
    if (near.size() < 2) continue;
    std::nth_element(near.begin(), near.begin() + 1, near.end(), std::greater<>());
    doubled[k] = change[k] < kRepeats * near[1];
  }
  return doubled;
}

std::vector<double> frame_times(const std::vector<double>& stamps, double file_fps, std::optional<double> fps, const std::string& name,
                                Context& context) {
  const double rate = fps.value_or(file_fps);
  std::vector<double> times(stamps.size());
  for (std::size_t k = 0; k < times.size(); ++k) times[k] = static_cast<double>(k) / rate;
  const std::vector<double> steps = steps_of(stamps);
  const auto uneven = std::count_if(steps.begin(), steps.end(), [](double s) { return std::abs(s - 1.0) > kUneven; });
  if (uneven == 0) return times;
  const double longest = *std::max_element(steps.begin(), steps.end());
  context.warn(fmt::format("{}: the time stamps are uneven ({} of {} steps, the longest {:.1f} frame times); they are used instead of "
                           "an even frame rate", name, uneven, steps.size(), longest));
  for (std::size_t k = 1; k < times.size(); ++k) times[k] = times[k - 1] + steps[k - 1] / rate;
  return times;
}

}  // namespace unseen::collision
