// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/seam_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "unseen/core/quantile.h"

namespace unseen::cuboids {
namespace {

constexpr std::size_t kFewestOfSide = 60;
const double kAlongAxis = 0.8;            // cosine: normals near an edge say nothing
constexpr int kFewestRows = 5;            // of a line, to say anything
constexpr double kShown = 0.6, kShownInAll = 0.7, kShownAlone = 0.75;  // of the line: on each side, on all, and on the only one
constexpr double kEvidence = 10.0;        // of each side
constexpr double kApart = 3.0;            // places, that lines on two sides may be apart
constexpr double kThinnest = 0.02, kThinnestSigmas = 10.0;              // m, of a piece
constexpr double kThinnestOfPieces = 0.25, kThinnestOfLayers = 0.5;     // of the thickest; of layers, else it is a lid
constexpr double kBesideStep = 0.04, kTopOfStep = 0.98;                   // m, on either side; quantile of heights
const double kSeesTop = std::sin(radians(8.0));

/// What the picture shows on one side of a part along the lines across a direction.
struct Side {
  int axis = 0;  ///< that the side looks along
  SeamLines lines;
};

std::vector<Side> sides_of(const PicturedPart& part, int across) {
  std::array<std::vector<int>, 6> points;
  for (const int i : part.points) {
    const Vec3 normal = part.directions(part.seen.graph.normals[i]);
    int axis = 0;
    if (normal.cwiseAbs().maxCoeff(&axis) >= kAlongAxis) points[2 * axis + (normal[axis] > 0.0)].push_back(i);
  }
  std::vector<Side> sides;
  for (int k = 0; k < 6; ++k) {
    if (k / 2 == across || points[k].size() < kFewestOfSide) continue;
    Side side{k / 2, seam_lines(part.picture, part.camera, part.seen, part.directions, points[k], across, 3 - across - k / 2)};
    if (side.lines.count() > 0) sides.push_back(std::move(side));
  }
  return sides;
}

/// What the picture shows along a line on a side: on how much of it, beyond what is usual there, there is a line, and a dark one, and how
/// much more likely that is of a seam than of a print, as a logarithm.
struct Shown {
  double line = 0, dark = 0, evidence = 0;
};

double beyond_usual(double share, double usual) { return std::max(share - usual, 0.0) / (1.0 - usual); }

double evidence_of(int rows, double share, double usual) {
  if (share <= usual) return 0.0;
  return rows * (share * std::log(share / usual) + (share < 1.0 ? (1.0 - share) * std::log((1.0 - share) / (1.0 - usual)) : 0.0));
}

/// None if the side does not tell.
std::optional<Shown> shown_at(const SeamLines& lines, int place) {
  if (place < 0 || place >= lines.count() || lines.rows[place] < kFewestRows) return std::nullopt;
  Shown shown{0, beyond_usual(lines.dark[place], lines.usual[0]), 0};
  for (int m = 0; m < 3; ++m) {
    const double share = m == 0 ? lines.dark[place] : lines.step[m - 1][place];
    shown.line = std::max(shown.line, beyond_usual(share, lines.usual[m]));
    shown.evidence = std::max(shown.evidence, evidence_of(lines.rows[place], share, lines.usual[m]));
  }
  return shown;
}

/// The most of each that lines close by show.
std::optional<Shown> shown_near(const SeamLines& lines, double at, double apart) {
  std::optional<Shown> most;
  const int reach = static_cast<int>(std::ceil(apart / lines.width));
  for (int k = lines.place(at) - reach; k <= lines.place(at) + reach; ++k) {
    const auto shown = shown_at(lines, k);
    if (!shown) continue;
    if (!most) most = shown;
    most = {std::max(most->line, shown->line), std::max(most->dark, shown->dark), std::max(most->evidence, shown->evidence)};
  }
  return most;
}

/// Whether what is on either side of a place is of unlike heights there.
bool steps_at(const PicturedPart& part, int axis, double at, double least) {
  std::array<std::vector<double>, 2> heights;
  for (const int i : part.points) {
    const Vec3 p = part.directions(part.seen.points[i]);
    if (std::abs(p[axis] - at) < kBesideStep) heights[p[axis] > at].push_back(p.z());
  }
  return !heights[0].empty() && !heights[1].empty() && std::abs(quantile(heights[0], kTopOfStep) - quantile(heights[1], kTopOfStep)) > least;
}

/// On how much of the lines at a place of one side, and of those close by on the others, the picture shows a seam, in the mean; 0 = it shows none.
double shown_on_all(const std::vector<Side>& sides, const Side& of, int place, const std::function<bool(double at)>& alone) {
  const auto here = shown_at(of.lines, place);
  if (!here || here->line < kShown) return 0.0;
  int telling = 0;
  double sum = 0, dark = 0;
  for (const Side& side : sides) {
    const auto shown = &side == &of ? here : shown_near(side.lines, of.lines.at(place), kApart * of.lines.width);
    if (!shown) continue;
    if (shown->line < kShown || shown->evidence < kEvidence) return 0.0;
    ++telling;
    sum += shown->line;
    dark = std::max(dark, shown->dark);
  }
  if (dark < kShown || sum < (telling < 2 ? kShownAlone : kShownInAll) * telling) return 0.0;
  return telling > 1 || (of.axis != 2 && alone(of.lines.at(place))) ? sum / telling : 0.0;
}

/// Takes those away that leave pieces much thinner than others: a band between two, or an end, is printed, or a lid.
void leave_out_bands(std::vector<double>& seams, double low, double high, double thinnest_of_pieces) {
  for (;;) {
    std::vector<double> ends = seams;
    ends.insert(ends.begin(), low);
    ends.push_back(high);
    std::size_t thinnest = 0;
    double thickest = 0;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      thickest = std::max(thickest, ends[k + 1] - ends[k]);
      if (ends[k + 1] - ends[k] < ends[thinnest + 1] - ends[thinnest]) thinnest = k;
    }
    if (seams.empty() || ends[thinnest + 1] - ends[thinnest] >= thinnest_of_pieces * thickest) return;
    const std::size_t first = thinnest == 0 ? 0 : thinnest - 1, last = std::min(thinnest, seams.size() - 1);
    seams.erase(seams.begin() + static_cast<std::ptrdiff_t>(first), seams.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  }
}

/// Whether the top would be seen if nothing stood on it.
bool is_seen_from_above(const PicturedPart& part, const DirectedExtent& extent) {
  const Vec3 to_eye = part.seen.T_world_camera.translation - part.seen.points[part.points.front()];
  return part.seen.T_world_camera.translation.z() - extent.high.z() > kSeesTop * to_eye.norm();
}

}  // namespace

Seams seams_across(const PicturedPart& part, int axis) {
  struct Candidate {
    double at, shown, dark;
  };
  const DirectedExtent extent = extent_of(part.seen, part.directions, part.points);
  double sigma = 0;
  for (const int i : part.points) sigma += part.seen.graph.sigma[i] / static_cast<double>(part.points.size());
  const double thinnest = std::max(kThinnest, kThinnestSigmas * sigma);
  const bool top_is_hidden = part.carries && is_seen_from_above(part, extent);
  const auto alone = [&](double at) { return axis != 2 && (top_is_hidden || steps_at(part, axis, at, thinnest)); };
  const std::vector<Side> sides = sides_of(part, axis);
  std::vector<Candidate> candidates;
  for (const Side& side : sides)
    for (int place = 0; place < side.lines.count(); ++place) {
      const double at = side.lines.at(place);
      if (at - extent.low[axis] < thinnest || extent.high[axis] - at < thinnest) continue;
      if (const double shown = shown_on_all(sides, side, place, alone); shown > 0.0)
        candidates.push_back({at, shown, beyond_usual(side.lines.dark[place], side.lines.usual[0])});
    }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) { return a.shown > b.shown; });
  Seams seams;
  double sum = 0, count = 0;
  // Both flanks of a dark line are candidates, too: it is where they are darkest.
  for (const Candidate& seam : candidates) {
    if (std::any_of(seams.at.begin(), seams.at.end(), [&](double other) { return std::abs(other - seam.at) < thinnest; })) continue;
    double weight = 0, at = 0;
    for (const Candidate& other : candidates)
      if (std::abs(other.at - seam.at) < thinnest) weight += other.dark, at += other.dark * other.at;
    seams.at.push_back(weight > 0.0 ? at / weight : seam.at);
    sum += seam.shown;
    count += 1.0;
  }
  std::sort(seams.at.begin(), seams.at.end());
  leave_out_bands(seams.at, extent.low[axis], extent.high[axis], axis == 2 ? kThinnestOfLayers : kThinnestOfPieces);
  seams.shown = seams.at.empty() ? 0.0 : sum / count;
  return seams;
}

}  // namespace unseen::cuboids
