// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "unseen/core/error.h"
#include "unseen/planes/evaluate.h"

namespace unseen::planes {
namespace {

enum class Kind { correct, over, under };

/// One instance of the measures: which regions it maps to which, and how well.
struct Instance {
  Kind kind;
  std::vector<int> planes, labels;
  double quality;  ///< mean of the two shares that the definition compares with the overlap
};

struct Regions {
  std::map<int, double> planes, labels;            ///< size in points
  std::map<std::pair<int, int>, double> overlaps;  ///< (plane, label) → points that have both
};

Regions count_regions(const std::vector<int>& plane_of_point, const std::vector<int>& label_of_point) {
  Regions regions;
  for (std::size_t i = 0; i < plane_of_point.size(); ++i) {
    const int plane = plane_of_point[i], label = label_of_point[i];
    if (plane >= 0) ++regions.planes[plane];
    if (label >= 0) ++regions.labels[label];
    if (plane >= 0 && label >= 0) ++regions.overlaps[{plane, label}];
  }
  return regions;
}

/// Parts that lie in one whole and together cover it: over-segmentation; with the roles exchanged,
/// under-segmentation.
struct Cover {
  std::vector<int> parts;
  double inside = 0, size = 0;  ///< points of the parts within the whole, and in all
};

void add_covers(Kind kind, const std::map<int, Cover>& covers, const std::map<int, double>& wholes,
                double overlap, std::vector<Instance>& instances) {
  for (const auto& [whole, cover] : covers) {
    const double covered = cover.inside / wholes.at(whole);
    if (cover.parts.size() < 2 || covered < overlap) continue;
    const double quality = 0.5 * (covered + cover.inside / cover.size);
    if (kind == Kind::over)
      instances.push_back({kind, cover.parts, {whole}, quality});
    else
      instances.push_back({kind, {whole}, cover.parts, quality});
  }
}

std::vector<Instance> find_instances(const Regions& regions, double overlap) {
  std::vector<Instance> instances;
  std::map<int, Cover> over, under;
  for (const auto& [pair, common] : regions.overlaps) {
    const auto [plane, label] = pair;
    const double plane_size = regions.planes.at(plane), label_size = regions.labels.at(label);
    const bool plane_inside = common >= overlap * plane_size, label_inside = common >= overlap * label_size;
    if (plane_inside && label_inside)
      instances.push_back(
          {Kind::correct, {plane}, {label}, 0.5 * (common / plane_size + common / label_size)});
    const auto add = [common = common](Cover& cover, int part, double size) {
      cover.parts.push_back(part);
      cover.inside += common;
      cover.size += size;
    };
    if (plane_inside) add(over[label], plane, plane_size);
    if (label_inside) add(under[plane], label, label_size);
  }
  add_covers(Kind::over, over, regions.labels, overlap, instances);
  add_covers(Kind::under, under, regions.planes, overlap, instances);
  std::stable_sort(instances.begin(), instances.end(),
                   [](const Instance& a, const Instance& b) { return a.quality > b.quality; });
  return instances;
}

}  // namespace

LabelScore evaluate_against_labels(const std::vector<int>& plane_of_point,
                                   const std::vector<int>& label_of_point, double overlap) {
  if (plane_of_point.size() != label_of_point.size())
    throw InputError("evaluate", "label_of_point", fmt::format("{} entries", label_of_point.size()),
                     fmt::format("one a point: {}", plane_of_point.size()));
  if (!(overlap > 0.5 && overlap <= 1.0))
    throw InputError("evaluate", "overlap", fmt::format("{}", overlap), "above 0.5, at most 1");

  const Regions regions = count_regions(plane_of_point, label_of_point);
  LabelScore score;
  score.planes = regions.planes.size();
  score.labels = regions.labels.size();
  std::map<int, bool> plane_taken, label_taken;
  const auto free = [](const std::vector<int>& ids, std::map<int, bool>& taken) {
    return std::none_of(ids.begin(), ids.end(), [&](int id) { return taken[id]; });
  };
  for (const Instance& instance : find_instances(regions, overlap)) {
    if (!free(instance.planes, plane_taken) || !free(instance.labels, label_taken)) continue;
    for (const int id : instance.planes) plane_taken[id] = true;
    for (const int id : instance.labels) label_taken[id] = true;
    if (instance.kind == Kind::correct) ++score.correct;
    if (instance.kind == Kind::over) ++score.over_segmented;
    if (instance.kind == Kind::under) ++score.under_segmented;
  }
  for (const auto& [id, size] : regions.planes) score.noise += plane_taken[id] ? 0 : 1;
  for (const auto& [id, size] : regions.labels) score.missed += label_taken[id] ? 0 : 1;
  const auto share = [&](std::size_t of) {
    return of == 0 ? 0.0 : static_cast<double>(score.correct) / static_cast<double>(of);
  };
  score.precision = share(score.planes);
  score.recall = share(score.labels);
  if (score.correct > 0) score.f1 = 2.0 * score.precision * score.recall / (score.precision + score.recall);
  return score;
}

}  // namespace unseen::planes
