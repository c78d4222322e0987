// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "cuboids/boxes/box_overlap.h"
#include "cuboids/search/complete.h"
#include "cuboids/search/trims.h"

namespace unseen::cuboids {
namespace {

constexpr double kHardlyDeep = 1e-3;  // m: less is left

bool are_near(const Problem& problem, const Arrangement& arrangement, int a, int b) {
  const double tolerance = problem.pair_tolerance(a, b);
  const ConvexSolid& second = arrangement.solids[b - problem.supports_count()];
  const auto there = problem.is_support(a) ? interface_of(problem.supports[a], second, tolerance) : interface_of(arrangement.solids[a - problem.supports_count()], second, tolerance);
  return there && there->gap <= tolerance;
}

/// Whether all that a body was near, beyond its rigid body, still is near it or the `other` one, and what it is fixed to near itself.
bool keeps_contacts(const Problem& problem, const std::vector<int>& group, const Arrangement& before, const Arrangement& after, int body, int other) {
  for (int i = 0; i < problem.bodies(); ++i) {
    const int a = std::min(i, body), b = std::max(i, body);
    const bool is_fixed = std::binary_search(before.fixed.begin(), before.fixed.end(), std::array{a, b});
    if (i == body || i == other || (group[i] == group[body] && !is_fixed) || !are_near(problem, before, a, b) || are_near(problem, after, a, b)) continue;
    if (is_fixed || !are_near(problem, after, std::min(i, other), std::max(i, other))) return false;
  }
  return true;
}

/// How much an arrangement bears, within tolerance and as the boxes are written: 0 = it falls, 1 = it stands, 2 = it bears the pushes too.
struct Firmness {
  int near = 0, exact = 0;
};

Problem exact_of(const Problem& problem) {
  Problem exact = as_written(problem);
  exact.stable_residual = kAtRest;
  return exact;
}

Firmness firmness_of(const Problem& problem, const Arrangement& arrangement, const std::vector<char>& held) {
  const auto degree = [&](const Problem& p) { return bears_pushes(p, arrangement, held) ? 2 : stands(p, arrangement, held) ? 1 : 0; };
  return {degree(problem), degree(exact_of(problem))};
}

bool is_as_firm(const Problem& problem, const Arrangement& arrangement, const std::vector<char>& held, const Firmness& before) {
  const auto reaches = [&](const Problem& p, int degree) { return degree == 0 || (degree == 1 ? stands(p, arrangement, held) : bears_pushes(p, arrangement, held)); };
  return reaches(problem, before.near) && reaches(exact_of(problem), before.exact);
}

/// Without one cuboid, whose links another one takes over.
Ending without(const Ending& ending, int cuboid, int heir) {
  Ending out = ending;
  const int first = ending.problem.supports_count(), body = first + cuboid;
  const auto erase = [](auto& values, int at) {
    if (!values.empty()) values.erase(values.begin() + at);
  };
  erase(out.problem.cuboids, cuboid), erase(out.problem.tolerance, cuboid), erase(out.problem.cut_off, cuboid), erase(out.cuboids, cuboid);
  erase(out.held, body), erase(out.falls, body);
  erase(out.arrangement.extension, cuboid), erase(out.arrangement.boxes, cuboid), erase(out.arrangement.solids, cuboid);
  out.arrangement.fixed.clear();
  const auto place = [&](int i) { return i == body ? first + heir - (heir > cuboid) : i - (i > body); };
  for (const auto& [a, b] : ending.arrangement.fixed)
    if (place(a) != place(b)) out.arrangement.fix({std::min(place(a), place(b)), std::max(place(a), place(b))});
  out.cuboids[heir - (heir > cuboid)].visible_points += ending.cuboids[cuboid].visible_points;
  out.problem.hypotheses.clear(), out.problem.joints.clear();
  return out;
}

Arrangement with_trim(Arrangement arrangement, const Trim& trim) {
  OrientedBox& box = arrangement.boxes[trim.cuboid];
  const double before = box.volume();
  box = extended(box, trim.face, -trim.length);
  arrangement.solids[trim.cuboid] = solid_of(box);
  arrangement.extension[trim.cuboid][trim.face] -= trim.length;
  arrangement.extended_volume += box.volume() - before;
  return arrangement;
}

}  // namespace

void drop_contained(const DepthView& view, Ending& ending) {
  std::optional<Firmness> before;
  for (int i = 0; i < static_cast<int>(ending.cuboids.size()); ++i) {
    const Problem& problem = ending.problem;
    const std::vector<OrientedBox>& boxes = ending.arrangement.boxes;
    const int first = problem.supports_count();
    const std::vector<int> group = structure_of(problem, ending.arrangement, {}, std::vector<char>(problem.bodies(), 0)).group;
    for (int j = 0; j < static_cast<int>(boxes.size()); ++j) {
      if (i == j || group[first + i] != group[first + j] || (problem.are_known_objects(first + i, first + j) && problem.cuboids[i].label != problem.cuboids[j].label)) continue;
      if (!is_contained(view, boxes[i], problem.tolerance[i], boxes[j], problem.tolerance[j])) continue;
      if (!before) before = firmness_of(problem, ending.arrangement, ending.held);
      Ending dropped = without(ending, i, j);
      if (!is_as_firm(dropped.problem, dropped.arrangement, dropped.held, *before)) continue;
      ending = std::move(dropped);
      --i;
      break;
    }
  }
}

std::optional<std::vector<char>> trim_overlaps(const DepthView& view, const Problem& problem, const std::vector<char>& held, Arrangement& arrangement, Context& context) {
  const int first = problem.supports_count();
  const std::vector<int> group = structure_of(problem, arrangement, {}, std::vector<char>(problem.bodies(), 0)).group;
  Firmness before;
  const auto trim_each = [&](Arrangement a, bool check) {
    for (int j = 0; j < static_cast<int>(a.boxes.size()); ++j)
      for (int i = 0; i < j; ++i) {
        if (group[first + i] != group[first + j] || separation(a.boxes[i], a.boxes[j]) > -kHardlyDeep) continue;
        for (const Trim& trim : trims_of(view, a.boxes, problem.tolerance, {i, j})) {
          Arrangement trimmed = with_trim(a, trim);
          if (!keeps_contacts(problem, group, a, trimmed, first + trim.cuboid, first + i + j - trim.cuboid)) continue;
          if (check && !is_as_firm(problem, trimmed, held, before)) continue;
          a = std::move(trimmed);
          break;
        }
      }
    return a;
  };
  Arrangement trimmed = trim_each(arrangement, false);
  if (trimmed.extension == arrangement.extension) return std::nullopt;
  before = firmness_of(problem, arrangement, held);
  std::optional<std::vector<char>> falls;
  if (!is_as_firm(problem, trimmed, held, before)) {  // weights have changed
    falls = hold_together(problem, held, trimmed, context);
    if (!is_as_firm(problem, trimmed, held, before)) trimmed = trim_each(arrangement, true), falls.reset();
  }
  arrangement = std::move(trimmed);
  return falls;
}

}  // namespace unseen::cuboids
