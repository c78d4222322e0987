// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/objects/seams.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "cuboids/objects/seam_lines.h"
#include "cuboids/objects/upright_box.h"

namespace unseen::cuboids {
namespace {

constexpr std::size_t kFewestOfSide = 60, kFewestOfPiece = 80, kSamples = 800;
const double kAlongAxis = 0.8;               // cosine: normals near an edge say nothing
constexpr int kFewestRows = 5;            // of a line, to say anything
constexpr double kShown = 0.6, kShownInAll = 0.7, kShownAlone = 0.75, kEvidence = 10.0;  // of the line: on each side, on all, and on the only one
constexpr double kApart = 3.0;            // places, that lines on two sides may be apart
constexpr double kThinnest = 0.02, kThinnestSigmas = 10.0;  // m, of a piece
constexpr double kThinnestOfPieces = 0.25;                  // of the thickest
constexpr double kMostLeft = 0.25, kMoreLeft = 0.03;  // of the points, that boxes between the seams may leave unexplained, and more than other cuts do

/// The points of one side of a part: that look along ± an axis.
struct Side {
  int axis = 0;
  std::vector<int> points;
};

/// A plane across one of the directions, along which the picture shows a seam.
struct Seam {
  double at = 0, shown = 0, dark = 0;
};

struct Seams {
  int axis = 0;
  std::vector<Seam> found;
  double shown() const {
    double sum = 0;
    for (const Seam& seam : found) sum += seam.shown;
    return found.empty() ? 0.0 : sum / static_cast<double>(found.size());
  }
};

/// What is cut, and what it is cut by.
struct Scene {
  const GreyPicture& picture;
  const Camera& camera;
  const Observation& seen;
  Directions directions;
};

std::vector<Side> sides_of(const Scene& scene, std::span<const int> points) {
  std::array<Side, 6> sides;
  for (const int i : points) {
    const Vec3 normal = scene.directions(scene.seen.graph.normals[i]);
    int axis = 0;
    if (normal.cwiseAbs().maxCoeff(&axis) < kAlongAxis) continue;
    sides[2 * axis + (normal[axis] > 0.0)].axis = axis;
    sides[2 * axis + (normal[axis] > 0.0)].points.push_back(i);
  }
  std::vector<Side> out;
  for (Side& side : sides)
    if (side.points.size() >= kFewestOfSide) out.push_back(std::move(side));
  return out;
}

/// What the picture shows along the line at that place on a side: on how much of it (beyond what is usual there) there is a line, and a dark one, and how
/// much more likely that is of a seam than of a print, as a logarithm; none if the side does not tell.
struct Shown {
  double share = 0, dark = 0, evidence = 0;
};
double beyond_usual(double share, double usual) { return std::max(share - usual, 0.0) / (1.0 - usual); }
double evidence(int rows, double share, double usual) {
  if (share <= usual) return 0.0;
  return rows * (share * std::log(share / usual) + (share < 1.0 ? (1.0 - share) * std::log((1.0 - share) / (1.0 - usual)) : 0.0));
}
std::optional<Shown> shown_at(const SeamLines& lines, int place) {
  if (place < 0 || place >= lines.count() || lines.rows[place] < kFewestRows) return std::nullopt;
  Shown shown{0, beyond_usual(lines.dark[place], lines.usual[0]), 0};
  for (int m = 0; m < 3; ++m) {
    const double share = m == 0 ? lines.dark[place] : lines.step[m - 1][place];
    shown.share = std::max(shown.share, beyond_usual(share, lines.usual[m]));
    shown.evidence = std::max(shown.evidence, evidence(lines.rows[place], share, lines.usual[m]));
  }
  return shown;
}
std::optional<Shown> shown_near(const SeamLines& lines, double at, double apart) {
  std::optional<Shown> best;
  const int reach = static_cast<int>(std::ceil(apart / lines.width));
  for (int k = lines.place(at) - reach; k <= lines.place(at) + reach; ++k)
    if (const auto shown = shown_at(lines, k); shown && (!best || shown->share > best->share)) best = {shown->share, std::max(shown->dark, best ? best->dark : 0.0), std::max(shown->evidence, best ? best->evidence : 0.0)};
  return best;
}

/// Takes those away that leave pieces much thinner than others: a band between two, or an end, is printed, or a lid.
void leave_out_bands(std::vector<Seam>& seams, double low, double high) {
  for (;;) {
    std::vector<double> ends{low};
    for (const Seam& seam : seams) ends.push_back(seam.at);
    ends.push_back(high);
    std::size_t thinnest = 0;
    double thickest = 0;
    for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
      thickest = std::max(thickest, ends[k + 1] - ends[k]);
      if (ends[k + 1] - ends[k] < ends[thinnest + 1] - ends[thinnest]) thinnest = k;
    }
    if (seams.empty() || ends[thinnest + 1] - ends[thinnest] >= kThinnestOfPieces * thickest) return;
    const std::size_t first = thinnest == 0 ? 0 : thinnest - 1, last = std::min(thinnest, seams.size() - 1);
    seams.erase(seams.begin() + static_cast<std::ptrdiff_t>(first), seams.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  }
}

/// Of how few sides one may tell alone: of a piece of a stack, a wall across; of what is cut at seams already, any.
enum class Alone { never, walls, any };

/// The seams across one direction.
Seams seams_across(const Scene& scene, std::span<const int> points, const std::vector<Side>& sides, int axis, Alone alone) {
  Seams seams{axis, {}};
  std::vector<SeamLines> lines;
  for (const Side& side : sides)
    if (side.axis != axis) lines.push_back(seam_lines(scene.picture, scene.camera, scene.seen, scene.directions, side.points, axis, 3 - axis - side.axis));
  std::erase_if(lines, [](const SeamLines& l) { return l.count() == 0; });
  if (lines.empty()) return seams;
  const DirectedExtent extent = extent_of(scene.seen, scene.directions, points);
  const double thinnest = std::max(kThinnest, kThinnestSigmas * scene.seen.graph.sigma[points.front()]);
  std::vector<Seam> candidates;
  for (const SeamLines& of : lines)
    for (int place = 0; place < of.count(); ++place) {
      const auto here = shown_at(of, place);
      const double at = of.at(place);
      if (!here || here->share < kShown || at - extent.low[axis] < thinnest || extent.high[axis] - at < thinnest) continue;
      int telling = 0;
      double sum = 0, least = 1.0, dark = 0, least_evidence = 1e9;
      for (const SeamLines& other : lines) {
        const auto shown = &other == &of ? here : shown_near(other, at, kApart * of.width);
        if (!shown) continue;
        ++telling;
        sum += shown->share;
        least = std::min(least, shown->share);
        dark = std::max(dark, shown->dark);
        least_evidence = std::min(least_evidence, shown->evidence);
      }
      if (telling == 1 && (alone == Alone::never || (alone == Alone::walls && axis == 2))) continue;
      if (dark >= kShown && least_evidence >= kEvidence && least >= kShown && sum >= (telling == 1 ? kShownAlone : kShownInAll) * telling) candidates.push_back({at, sum / telling, here->dark});
    }
  std::stable_sort(candidates.begin(), candidates.end(), [](const Seam& a, const Seam& b) { return a.shown > b.shown; });
  // Both flanks of a dark line are candidates, too: it is where they are darkest.
  for (const Seam& seam : candidates) {
    if (std::any_of(seams.found.begin(), seams.found.end(), [&](const Seam& other) { return std::abs(other.at - seam.at) < thinnest; })) continue;
    double weight = 0, at = 0;
    for (const Seam& other : candidates)
      if (std::abs(other.at - seam.at) < thinnest) weight += other.dark, at += other.dark * other.at;
    seams.found.push_back({weight > 0.0 ? at / weight : seam.at, seam.shown, seam.dark});
  }
  std::sort(seams.found.begin(), seams.found.end(), [](const Seam& a, const Seam& b) { return a.at < b.at; });
  leave_out_bands(seams.found, extent.low[axis], extent.high[axis]);
  return seams;
}

std::vector<Sample> few_samples(const Observation& seen, std::span<const int> points, std::size_t step) {
  std::vector<Sample> samples;
  for (std::size_t k = 0; k < points.size(); k += step)
    if (const int i = points[k]; !seen.graph.normals[i].isZero()) samples.push_back({seen.points[i], seen.graph.normals[i], seen.graph.sigma[i]});
  return samples;
}

/// How much of the points boxes around pieces leave unexplained, 0 … 1.
double left_by(const Observation& seen, const std::vector<std::vector<int>>& pieces) {
  double left = 0, samples = 0;
  std::size_t count = 0;
  for (const std::vector<int>& piece : pieces) count += piece.size();
  for (const std::vector<int>& piece : pieces) {
    const std::vector<Sample> some = few_samples(seen, piece, count / kSamples + 1);
    left += unexplained(some);
    samples += static_cast<double>(some.size());
  }
  return left / std::max(samples, 1.0);
}

/// The pieces between the seams of a part: cut across the direction in which they show best, and again.
std::vector<std::vector<int>> cut_at_seams(const Scene& scene, std::vector<int> points, Alone alone) {
  const std::vector<Side> sides = sides_of(scene, points);
  Seams best;
  for (int axis = 0; axis < 3; ++axis)
    if (Seams seams = seams_across(scene, points, sides, axis, alone); seams.shown() > best.shown()) best = std::move(seams);
  if (best.found.empty()) return {std::move(points)};
  std::vector<std::vector<int>> pieces(best.found.size() + 1);
  for (const int i : points) {
    const double at = scene.directions(scene.seen.points[i])[best.axis];
    pieces[static_cast<std::size_t>(std::count_if(best.found.begin(), best.found.end(), [&](const Seam& seam) { return seam.at < at; }))].push_back(i);
  }
  if (std::any_of(pieces.begin(), pieces.end(), [](const auto& piece) { return piece.size() < kFewestOfPiece; })) return {std::move(points)};
  std::vector<std::vector<int>> all;
  for (std::vector<int>& piece : pieces)
    for (std::vector<int>& smaller : cut_at_seams(scene, std::move(piece), Alone::any)) all.push_back(std::move(smaller));
  return all;
}

}  // namespace

void find_seams(const RgbdFrame& frame, const Observation& seen, const std::vector<std::vector<int>>& parts, Stacks& stacks, const Context& context) {
  if (frame.color.empty()) return;
  const GreyPicture picture(frame);
  int stack = *std::max_element(stacks.stack_of_piece.begin(), stacks.stack_of_piece.end()) + 1;
  const auto cut = [&](const std::vector<int>& part, Alone alone, double most) {
    const std::vector<Sample> samples = few_samples(seen, part, part.size() / kSamples + 1);
    if (samples.empty()) return false;
    const Scene scene{picture, frame.camera, seen, Directions{across_front(samples)}};
    const std::vector<std::vector<int>> pieces = cut_at_seams(scene, part, alone);
    if (pieces.size() < 2 || left_by(seen, pieces) > most) return false;
    for (const std::vector<int>& piece : pieces) {
      for (const int i : piece) stacks.piece_of_point[i] = static_cast<int>(stacks.stack_of_piece.size());
      stacks.stack_of_piece.push_back(stack);
    }
    ++stack;
    return true;
  };
  for (const std::vector<int>& part : parts) {
    context.check();
    std::map<int, std::vector<int>> by_piece;
    for (const int i : part) by_piece[stacks.piece_of_point[i]].push_back(i);
    std::vector<std::vector<int>> pieces;
    for (auto& [piece, points] : by_piece) pieces.push_back(std::move(points));
    if (cut(part, Alone::never, std::min(kMostLeft, left_by(seen, pieces) + kMoreLeft)) || pieces.size() < 2) continue;
    for (const std::vector<int>& piece : pieces) cut(piece, Alone::walls, kMostLeft);
  }
}

}  // namespace unseen::cuboids
