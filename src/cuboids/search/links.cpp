// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <array>
#include <tuple>

#include "cuboids/search/complete.h"

namespace unseen::cuboids {
namespace {

constexpr double kBorderPixels = 5.0;  // depth ends as far from the picture's border, or is not to be trusted there
constexpr int kProjections = 100;
constexpr int kSamples = 9;          // along a link
constexpr int kTrials = 200;         // links that may be tried
constexpr double kFreeLink = 0.25;   // of them: speckle

/// A way in which one body may hold another out of sight.
struct Link {
  int a = -1, b = -1;  ///< bodies, a < b
  double length = 0;   ///< m
};

Vec3 nearest_in(const OrientedBox& box, const Vec3& p) {
  const Vec3 local = box.axes.transpose() * (p - box.center);
  return box.center + box.axes * local.cwiseMax(-box.half_size).cwiseMin(box.half_size);
}

/// The nearest points of two boxes, by projections to and fro.
std::array<Vec3, 2> nearest_points(const OrientedBox& a, const OrientedBox& b) {
  Vec3 p = a.center, q = b.center;
  for (int i = 0; i < kProjections; ++i) {
    q = nearest_in(b, p);
    p = nearest_in(a, q);
  }
  return {p, q};
}

bool is_out_of_sight(const DepthView& view, const Vec3& p, const Vec3& q) {
  int free = 0;
  for (int i = 0; i < kSamples; ++i) free += view.at(p + (i + 0.5) / kSamples * (q - p)) == DepthView::Space::free;
  return free <= kFreeLink * kSamples;
}

/// Links to bodies that hang in the air, no longer than these are; the shortest first.
std::vector<Link> links_of(const Problem& problem, const DepthView& view, const Arrangement& arrangement, const std::vector<char>& hangs) {
  std::vector<Link> links;
  const int first = problem.supports_count();
  for (int b = first; b < problem.bodies(); ++b)
    for (int a = first; a < b; ++a) {
      if (!hangs[a] && !hangs[b]) continue;
      const OrientedBox &box_a = arrangement.boxes[a - first], &box_b = arrangement.boxes[b - first];
      const auto [p, q] = nearest_points(box_a, box_b);
      double longest = problem.pair_tolerance(a, b);
      if (hangs[a]) longest = std::max(longest, 2.0 * box_a.half_size.maxCoeff());
      if (hangs[b]) longest = std::max(longest, 2.0 * box_b.half_size.maxCoeff());
      const double length = (p - q).norm();
      if (length <= longest && is_out_of_sight(view, p, q)) links.push_back({a, b, length});
    }
  std::sort(links.begin(), links.end(), [](const Link& s, const Link& t) { return std::tuple(s.length, s.a, s.b) < std::tuple(t.length, t.a, t.b); });
  return links;
}

}  // namespace

std::vector<char> cut_off(const DepthView& view, const std::vector<Cuboid>& cuboids) {
  std::vector<char> out;
  for (const Cuboid& cuboid : cuboids) {
    OrientedBox box = cuboid.initial;
    box.half_size.array() += kBorderPixels * view.spacing(box.center);
    const std::vector<Vec3> corners = solid_of(box).vertices;
    out.push_back(std::any_of(corners.begin(), corners.end(), [&](const Vec3& p) { return view.at(p) == DepthView::Space::outside; }));
  }
  return out;
}

std::vector<char> held_up(const Problem& problem, const Arrangement& arrangement, const std::vector<char>& held) {
  const std::vector<int> group = structure_of(problem, arrangement, {}, held).group;
  std::vector<char> out(problem.bodies(), 0);
  for (int i = problem.supports_count(); i < problem.bodies(); ++i) {
    bool is_held = false, is_firm = false;
    for (int other = 0; other < problem.bodies(); ++other) {
      if (group[other] != group[i]) continue;
      is_firm |= problem.is_support(other);
      is_held |= held[other] != 0;
    }
    out[i] = is_held && !is_firm;
  }
  return out;
}

std::vector<char> hanging(const Problem& problem, const Arrangement& arrangement, const std::vector<char>& held) {
  std::vector<char> out = held_up(problem, arrangement, held);
  const std::vector<int> group = structure_of(problem, arrangement, {}, held).group;
  for (int i = problem.supports_count(); i < problem.bodies(); ++i)
    if (held[i] && problem.is_cut_off(i))
      for (int other = 0; other < problem.bodies(); ++other)
        if (group[other] == group[i]) out[other] = 0;
  return out;
}

void link_hanging(const Problem& problem, const DepthView& view, std::vector<char>& held, Arrangement& arrangement, Context& context) {
  std::vector<Link> links = links_of(problem, view, arrangement, hanging(problem, arrangement, held));
  const auto link_all = [&](const auto& may_be) {
    int trials = 0;
    for (bool changed = true; changed;) {
      changed = false;
      for (const Link& link : links) {
        context.check();
        const std::vector<char> hangs = hanging(problem, arrangement, held);
        const Structure now = structure_of(problem, arrangement, {}, held);
        if ((!hangs[link.a] && !hangs[link.b]) || now.group[link.a] == now.group[link.b]) continue;
        Arrangement linked = arrangement;
        linked.fix({link.a, link.b});
        std::vector<char> freed = held;
        if (!hangs[link.a] || !hangs[link.b])  // the one that stands is to carry the other
          for (int i = problem.supports_count(); i < problem.bodies(); ++i)
            if (now.group[i] == now.group[hangs[link.a] ? link.a : link.b]) freed[i] = 0;
        if (++trials > kTrials) return;
        if (!may_be(problem, linked, freed)) continue;
        arrangement = std::move(linked);
        held = std::move(freed);
        changed = true;
      }
    }
  };
  link_all(bears_pushes);
  link_all(stands);  // rather than that it hangs in the air
}

}  // namespace unseen::cuboids
