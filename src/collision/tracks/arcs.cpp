// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/arcs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <utility>

#include "collision/tracks/grow_arc.h"
#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr int kSteps[] = {4, 2, 8, 1};  // frames between the candidates of a seed
constexpr double kLargestBend = 0.35;   // of the seed's length: more is no flight between neighbouring frames
constexpr double kShared = 0.35;        // of its points that an arc may share with longer ones
constexpr double kMuchSmoother = 0.8;       // of its noise
constexpr double kStep = 0.25;          // of the picture's span that something may move a frame

constexpr double kWander = 0.025;       // diameters
constexpr std::size_t kMostFollowed = 8;  // candidates a frame that the noise is taken from

using Key = std::pair<int, int>;        // frame and index of a candidate

/// Diagonal of what the candidates span, px.
double span_of(const Candidates& candidates) {
  Vec2 low = Vec2::Constant(1e30), high = -low;
  for (const auto& frame : candidates)
    for (const Candidate& c : frame) {
      low = low.cwiseMin(c.pixel);
      high = high.cwiseMax(c.pixel);
    }
  return low.x() > high.x() ? 0.0 : (high - low).norm();
}

Key key_of(const Candidate& c, const Candidates& candidates) {
  const auto& frame = candidates[static_cast<std::size_t>(c.frame)];
  for (std::size_t i = 0; i < frame.size(); ++i)
    if (frame[i].pixel == c.pixel) return {c.frame, static_cast<int>(i)};
  return {c.frame, -1};
}

/// Longest first; drops those whose points longer ones have, and ends others where only points of longer and smoother ones follow: what pushed a
/// body may fly on by chance where this would have.
std::vector<Arc> best_of(std::vector<Arc> arcs, const Candidates& candidates) {
  const auto longer = [](const Arc& a, const Arc& b) { return a.points.size() != b.points.size() ? a.points.size() > b.points.size() : a.noise < b.noise; };
  std::stable_sort(arcs.begin(), arcs.end(), longer);
  std::map<Key, double> used;  // and how rough the arc is that has it
  std::vector<Arc> kept;
  for (Arc& arc : arcs) {
    std::vector<Key> keys;
    for (const Candidate& c : arc.points) keys.push_back(key_of(c, candidates));
    const auto shared = std::count_if(keys.begin(), keys.end(), [&](const Key& k) { return used.contains(k); });
    if (static_cast<double>(shared) > kShared * static_cast<double>(keys.size())) continue;
    if (shared > 0) {
      const auto is_own = [&](const Key& k) { return !used.contains(k) || used.at(k) > kMuchSmoother * arc.noise; };
      const auto first = std::find_if(keys.begin(), keys.end(), is_own) - keys.begin(), last = keys.rend() - std::find_if(keys.rbegin(), keys.rend(), is_own);
      if (last - first >= static_cast<std::ptrdiff_t>(kFewestOfArc)) arc = arc_of({arc.points.begin() + first, arc.points.begin() + last});
    }
    for (const Key& k : keys) used.emplace(k, arc.noise);
    kept.push_back(std::move(arc));
  }
  std::stable_sort(kept.begin(), kept.end(), longer);
  return kept;
}

}  // namespace

Arc arc_of(std::vector<Candidate> points) {
  Arc arc{std::move(points), {}, 0.0};
  CurveSums sums(arc.begin());
  for (const Candidate& c : arc.points) sums.add(c.u, c.pixel);
  arc.curve = sums.fit();
  arc.noise = std::sqrt(arc.curve.squares / std::max(1.0, 2.0 * static_cast<double>(arc.points.size()) - 6.0));
  return arc;
}

double estimate_noise(const Candidates& candidates, double least) {
  std::vector<double> values;
  const auto some = [&](std::size_t k) { return std::span(candidates[k]).first(std::min(candidates[k].size(), kMostFollowed)); };
  for (std::size_t k = 0; k + 3 < candidates.size(); ++k)
    for (const Candidate& a : some(k)) {
      // Follow what is nearest to where it should be next: of a wrong continuation the difference is large and does not count.
      double best = 1e30, moved = 0.0;
      for (const Candidate& b : some(k + 1))
        for (const Candidate& c : some(k + 2))
          for (const Candidate& d : some(k + 3)) {
            if (!can_fly(a) || unlikeness(a, b) + unlikeness(b, c) + unlikeness(c, d) > kLooksAlike) continue;
            const double third = off_any_flight({&a, &b, &c, &d}).norm();
            if (third < best) {
              best = third;
              moved = (d.pixel - a.pixel).norm();
            }
          }
      if (best < 1e30 && moved > 4.0) values.push_back(best / std::sqrt(2.0));
    }
  if (values.size() < 4) return least;
  return std::max(least, quantile(std::move(values), 0.25) / 0.536);  // first quartile of a Rayleigh distribution, over √2
}

Candidate looks_of(const Arc& arc) {
  Candidate mean = arc.points[arc.points.size() / 2];
  const auto count = static_cast<double>(arc.points.size());
  mean.color = Vec3::Zero();
  mean.round = 0.0;
  for (const Candidate& c : arc.points) mean.color += c.color / count, mean.round += c.round / count;
  mean.diameter = typical_diameter(arc.points);
  return mean;
}

double silhouette_noise(const Shot& shot, const Candidates& candidates, double noise, Context& context) {
  const bool silhouettes = std::any_of(shot.bodies.begin(), shot.bodies.end(), [](const Body& b) {
    return b.shape == Shape::mesh || b.shape == Shape::box || b.shape == Shape::size;
  });
  if (!silhouettes) return noise;
  std::vector<Candidate> flown;
  for (const Arc& arc : find_arcs(candidates, 2.0 * noise, noise, context))
    for (const Candidate& c : arc.points)
      if (c.region >= 0) flown.push_back(c);
  return std::max(noise, kWander * typical_diameter(flown));
}

std::vector<Arc> find_arcs(const Candidates& candidates, double noise, double jitter, Context& context) {
  const int count = static_cast<int>(candidates.size());
  const double far = kStep * span_of(candidates);
  std::vector<Arc> arcs;
  std::map<Key, std::set<std::size_t>> member;  // arcs of eight points or more that a candidate belongs to
  ArcGrower grower(candidates, noise, jitter);
  const auto together = [&](const Key& a, const Key& b, const Key& c) {
    const auto ia = member.find(a), ib = member.find(b), ic = member.find(c);
    if (ia == member.end() || ib == member.end() || ic == member.end()) return false;
    return std::any_of(ia->second.begin(), ia->second.end(), [&](std::size_t i) { return ib->second.contains(i) && ic->second.contains(i); });
  };
  for (const int step : kSteps)
    for (int k = 0; k + 2 * step < count; ++k) {
      context.check();
      const auto &first = candidates[k], &second = candidates[k + step], &third = candidates[k + 2 * step];
      for (int a = 0; a < static_cast<int>(first.size()); ++a)
        for (int b = 0; b < static_cast<int>(second.size()); ++b) {
          if (!can_fly(first[a]) || !can_fly(second[b]) || unlikeness(first[a], second[b]) > kLooksAlike) continue;
          if ((second[b].pixel - first[a].pixel).norm() > far * step) continue;
          for (int c = 0; c < static_cast<int>(third.size()); ++c) {
            if (!can_fly(third[c]) || unlikeness(second[b], third[c]) > kLooksAlike) continue;
            const double length = (third[c].pixel - first[a].pixel).norm();
            const double bend = (third[c].pixel - 2.0 * second[b].pixel + first[a].pixel).norm();
            if (bend > kLargestBend * std::max(length, 0.15 * far * step) + 4.0 * noise) continue;
            if (together({k, a}, {k + step, b}, {k + 2 * step, c})) continue;
            const auto arc = grower.grow(k, step, first[a], second[b], third[c]);
            if (!arc) continue;
            if (arc->points.size() >= 8)
              for (const Candidate& p : arc->points) member[key_of(p, candidates)].insert(arcs.size());
            arcs.push_back(*arc);
          }
        }
    }
  return best_of(std::move(arcs), candidates);
}

}  // namespace unseen::collision
