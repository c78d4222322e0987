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

/// The median step between stamps that follow each other, s; 0 = there is none.
double typical_step(const std::vector<double>& stamps) {
  std::vector<double> steps;
  for (std::size_t k = 1; k < stamps.size(); ++k)
    if (stamps[k] > stamps[k - 1]) steps.push_back(stamps[k] - stamps[k - 1]);
  return median(std::move(steps));
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
  const double typical = typical_step(stamps);
  if (typical == 0.0) return times;
  const std::vector<double> steps = steps_of(stamps, typical);
  const auto uneven = std::count_if(steps.begin(), steps.end(), [](double s) { return std::abs(s - 1.0) > kUneven; });
  if (uneven == 0) return times;
  const double longest = *std::max_element(steps.begin(), steps.end());
  context.warn(fmt::format("{}: the time stamps are uneven ({} of {} steps, the longest {:.1f} frame times); they are used instead of "
                           "an even frame rate", name, uneven, steps.size(), longest));
  const double step = fps ? 1.0 / *fps : typical;  // the file's own rate counts the missing frames too
  for (std::size_t k = 1; k < times.size(); ++k) times[k] = times[k - 1] + steps[k - 1] * step;
  return times;
}

}  // namespace unseen::collision
