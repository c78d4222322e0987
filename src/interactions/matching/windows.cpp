// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "interactions/matching/windows.h"

#include <algorithm>
#include <cmath>

namespace unseen::interactions {
namespace {

constexpr double kInformative = 0.35;  // likelihood of a window worth a scenelet
constexpr double kApart = 0.6;         // s between windows
constexpr std::size_t kCandidates = 5;

/// Mean over three readings.
std::vector<double> smoothed_likelihood(const std::vector<Reading>& readings, bool saliency) {
  std::vector<double> smooth;
  const auto of = [&](std::size_t i) { return saliency ? readings[i].likelihood : std::exp(-readings[i].matches.front().error / 0.01); };
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const std::size_t before = i > 0 ? i - 1 : i, after = std::min(i + 1, readings.size() - 1);
    smooth.push_back((of(before) + of(i) + of(after)) / 3);
  }
  return smooth;
}

/// Frames that a scenelet laid at `center` has poses for, as far as `reach` frames.
void cover(Choice& window, const Reading& reading, const Scenelet& scenelet, double fps, int reach) {
  const double before = scenelet.middle / scenelet.fps * fps;
  const double after = (static_cast<double>(scenelet.poses.size()) - 1 - scenelet.middle) / scenelet.fps * fps;
  window.first = reading.frame - std::min(reach, static_cast<int>(before + 1e-6));
  window.last = reading.frame + std::min(reach, static_cast<int>(after + 1e-6));
}

/// How far the bodies of two scenelets are apart in the frame between their windows, m², pelvis first.
double jump(const Reading& a, const Match& ma, const Reading& b, const Match& mb, const Database& database, const Path& path, double fps) {
  const double middle = 0.5 * (a.frame + b.frame);
  const Scenelet& sa = database.scenelets[static_cast<std::size_t>(ma.scenelet)];
  const Scenelet& sb = database.scenelets[static_cast<std::size_t>(mb.scenelet)];
  const auto pa = pose_at(sa, (middle - a.frame) / fps), pb = pose_at(sb, (middle - b.frame) / fps);
  constexpr double kNotCovered = 0.05;
  if (!pa || !pb) return kNotCovered;
  Placement at = ma.placement, bt = mb.placement;
  at.position.head<2>() = path.at(a.frame);
  bt.position.head<2>() = path.at(b.frame);
  return (at * *pa - bt * *pb).colwise().squaredNorm().mean();
}

}  // namespace

std::vector<Choice> find_windows(const std::vector<Reading>& readings, const Database& database, double fps, bool saliency) {
  const std::vector<double> likelihood = smoothed_likelihood(readings, saliency);
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < readings.size(); ++i)
    if (likelihood[i] >= kInformative) order.push_back(i);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return likelihood[a] > likelihood[b]; });
  std::vector<Choice> windows;
  for (const std::size_t i : order) {
    const auto near = [&](const Choice& c) { return std::abs(readings[c.reading].frame - readings[i].frame) < kApart * fps; };
    if (std::none_of(windows.begin(), windows.end(), near)) windows.push_back({i, 0, 0, 0});
  }
  std::sort(windows.begin(), windows.end(), [](const Choice& a, const Choice& b) { return a.reading < b.reading; });
  for (Choice& window : windows)
    cover(window, readings[window.reading], database.scenelets[static_cast<std::size_t>(readings[window.reading].matches[0].scenelet)], fps,
          static_cast<int>(kApart * fps));
  return windows;
}

void choose_scenelets(std::vector<Choice>& windows, const std::vector<Reading>& readings, const Database& database, const Path& path, double fps,
                      bool smooth) {
  constexpr double kJump = 0.1;     // of a jump's m² to a window's m²
  constexpr double kFarthest = 3.0;  // s: windows farther apart do not join
  std::vector<std::vector<double>> cost(windows.size());
  std::vector<std::vector<std::size_t>> from(windows.size());
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const Reading& reading = readings[windows[w].reading];
    const std::size_t count = std::min(kCandidates, reading.matches.size());
    const Reading* before = w > 0 ? &readings[windows[w - 1].reading] : nullptr;
    for (std::size_t c = 0; c < count; ++c) {
      double best = 0;
      std::size_t best_from = 0;
      for (std::size_t b = 0; before && b < cost[w - 1].size(); ++b) {
        double total = cost[w - 1][b];
        if (smooth && reading.frame - before->frame < kFarthest * fps)
          total += kJump * jump(*before, before->matches[b], reading, reading.matches[c], database, path, fps);
        if (b > 0 && total >= best) continue;
        best = total;
        best_from = b;
      }
      cost[w].push_back(best + reading.matches[c].error);
      from[w].push_back(best_from);
    }
  }
  if (windows.empty()) return;
  std::size_t at = static_cast<std::size_t>(std::min_element(cost.back().begin(), cost.back().end()) - cost.back().begin());
  for (std::size_t w = windows.size(); w-- > 0;) {
    windows[w].match = at;
    at = from[w][at];
  }
  for (std::size_t w = 0; w < windows.size(); ++w) {
    const Reading& reading = readings[windows[w].reading];
    cover(windows[w], reading, database.scenelets[static_cast<std::size_t>(reading.matches[windows[w].match].scenelet)], fps, static_cast<int>(kApart * fps));
    windows[w].first = std::max(windows[w].first, path.first);
    windows[w].last = std::min(windows[w].last, path.last());
    if (w == 0 || windows[w - 1].last < windows[w].first) continue;
    const int middle = (readings[windows[w - 1].reading].frame + reading.frame) / 2;
    windows[w - 1].last = std::min(windows[w - 1].last, middle);
    windows[w].first = std::max(windows[w].first, middle + 1);
  }
}

}  // namespace unseen::interactions
