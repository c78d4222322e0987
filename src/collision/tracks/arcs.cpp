// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/arcs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>

#include "unseen/core/quantile.h"

namespace unseen::collision {
namespace {

constexpr int kSteps[] = {4, 2, 8, 1};  // frames between the candidates of a seed
constexpr double kGate = 3.5;           // σ
constexpr double kAlike = 6.0;          // σ² between neighbours' looks
constexpr int kMisses = 4;              // frames in a row
constexpr double kFilled = 0.6;         // share of the seed's frames that must be on the curve
constexpr std::size_t kFewestOfArc = 4;      // points
constexpr double kLargestBend = 0.35;   // of the seed's length: more is no flight between neighbouring frames
constexpr double kShared = 0.35;        // of its points that an arc may share with longer ones
constexpr double kStep = 0.25;          // of the picture's span that something may move a frame

constexpr double kWander = 0.025;       // diameters
constexpr double kMuchLess = 0.6;       // of the noise: jitter that neighbours are held to
constexpr double kRough = 0.1;          // of the noise, added to the jitter
constexpr std::size_t kNeighbours = 8, kFewestNeighbours = 5;
constexpr std::size_t kSmoothest = 14;  // points
constexpr std::size_t kMostFollowed = 8;  // candidates a frame that the noise is taken from

using Key = std::pair<int, int>;        // frame and index of a candidate

bool can_fly(const Candidate& c) { return c.whole && !c.shadow; }

/// Grows one arc from a seed.
class Grower {
 public:
  Grower(const Candidates& candidates, double noise, double jitter)
      : candidates_(candidates), noise_(noise), jitter_(jitter < kMuchLess * noise ? std::hypot(jitter, kRough * noise) : 0.0) {}

  std::optional<Arc> grow(int first, int step, const Candidate& a, const Candidate& b, const Candidate& c) {
    CurveSums seed(a.u);
    for (const Candidate* s : {&a, &b, &c}) seed.add(s->u, s->pixel);
    Curve curve = seed.fit();
    points_.clear();
    sums_ = CurveSums(a.u);
    for (int k = first; k <= first + 2 * step; ++k)
      if (const Candidate* found = nearest(k, curve, b, 0.0)) add(*found);
    if (static_cast<double>(points_.size()) < std::max(3.0, kFilled * (2 * step + 1))) return {};
    extend(first + 2 * step + 1, 1);
    extend(first - 1, -1);
    if (points_.size() > kSmoothest) grow_again();
    if (points_.size() < kFewestOfArc) return {};
    Arc arc;
    for (const auto& [frame, point] : points_) arc.points.push_back(point);
    arc.curve = sums_.fit();
    arc.noise = std::sqrt(arc.curve.squares / std::max(1.0, 2.0 * static_cast<double>(arc.points.size()) - 6.0));
    return arc.noise < 2.0 * noise_ ? std::optional(arc) : std::nullopt;
  }

 private:
  void add(const Candidate& c) {
    points_.emplace(c.frame, c);
    sums_.add(c.u, c.pixel);
  }

  void extend(int k, int direction) {
    for (int misses = 0; misses <= kMisses && k >= 0 && k < static_cast<int>(candidates_.size()); k += direction) {
      if (candidates_[k].empty()) {
        ++misses;
        continue;
      }
      const Curve curve = sums_.fit();
      const Candidate& last = direction > 0 ? points_.rbegin()->second : points_.begin()->second;
      const Candidate* found = nearest(k, curve, last, curve.variance_at(candidates_[k].front().u));
      if (found && !led_to(*found, curve, direction)) found = nullptr;
      if (found) add(*found);
      misses = found ? 0 : misses + 1;
    }
  }

  /// Grows again from the smoothest stretch: the seed may have had the moment of a push, or of two bodies seen as one, in its middle.
  void grow_again() {
    const std::vector<std::pair<int, Candidate>> all(points_.begin(), points_.end());
    const auto fit = [&](std::size_t begin) {
      CurveSums sums(all[begin].second.u);
      for (std::size_t i = begin; i < begin + kSmoothest; ++i) sums.add(all[i].second.u, all[i].second.pixel);
      return sums;
    };
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t begin = 0; begin + kSmoothest <= all.size(); begin += 2) {
      const double squares = fit(begin).fit().squares;
      if (squares < least) least = squares, best = begin;
    }
    sums_ = fit(best);
    points_ = {all.begin() + static_cast<std::ptrdiff_t>(best), all.begin() + static_cast<std::ptrdiff_t>(best + kSmoothest)};
    extend(points_.rbegin()->first + 1, 1);
    extend(points_.begin()->first - 1, -1);
  }

  /// Whether the points at the end that grows lead to `next`: where they do not, something pushed the body.
  bool led_to(const Candidate& next, const Curve& curve, int direction) const {
    if (jitter_ == 0.0 || points_.size() < kFewestNeighbours) return true;
    CurveSums near(next.u);
    const auto add_near = [&](auto begin, auto end) {
      for (auto it = begin; it != end && near.count() < static_cast<int>(kNeighbours); ++it) near.add(it->second.u, it->second.pixel);
    };
    if (direction > 0) add_near(points_.rbegin(), points_.rend());
    else add_near(points_.begin(), points_.end());
    const Curve local = near.fit(curve.curvature, jitter_ * jitter_ / (noise_ * noise_ * curve.cofactor(2, 2)));
    const double sigma = jitter_ * std::sqrt(1.0 + local.variance_at(next.u));
    return (next.pixel - local.at(next.u)).norm() < kGate * sigma;
  }

  const Candidate* nearest(int k, const Curve& curve, const Candidate& like, double variance) const {
    const Candidate* best = nullptr;
    const double sigma = noise_ * std::sqrt(1.0 + std::min(variance, 8.0));
    double least = kGate * kGate;
    for (const Candidate& c : candidates_[k]) {
      if (!can_fly(c)) continue;
      const double off = (c.pixel - curve.at(c.u)).squaredNorm() / (2.0 * sigma * sigma), unlike = unlikeness(c, like);
      if (unlike < kAlike && off + unlike < least + kAlike && off < kGate * kGate / 2.0 && (!best || off + unlike < least)) {
        best = &c;
        least = off + unlike;
      }
    }
    return best;
  }

  const Candidates& candidates_;
  double noise_, jitter_;  ///< px; no jitter = neighbours tell no more than the curve
  std::map<int, Candidate> points_;
  CurveSums sums_{0.0};
};

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

/// Longest first; drops those whose points longer ones have.
std::vector<Arc> best_of(std::vector<Arc> arcs, const Candidates& candidates) {
  std::stable_sort(arcs.begin(), arcs.end(), [](const Arc& a, const Arc& b) {
    return a.points.size() != b.points.size() ? a.points.size() > b.points.size() : a.noise < b.noise;
  });
  std::set<Key> used;
  std::vector<Arc> kept;
  for (Arc& arc : arcs) {
    std::vector<Key> keys;
    for (const Candidate& c : arc.points) keys.push_back(key_of(c, candidates));
    const auto shared = std::count_if(keys.begin(), keys.end(), [&](const Key& k) { return used.contains(k); });
    if (static_cast<double>(shared) > kShared * static_cast<double>(keys.size())) continue;
    used.insert(keys.begin(), keys.end());
    kept.push_back(std::move(arc));
  }
  return kept;
}

}  // namespace

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
            if (!can_fly(a) || unlikeness(a, b) + unlikeness(b, c) + unlikeness(c, d) > kAlike) continue;
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
  Grower grower(candidates, noise, jitter);
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
          if (!can_fly(first[a]) || !can_fly(second[b]) || unlikeness(first[a], second[b]) > kAlike) continue;
          if ((second[b].pixel - first[a].pixel).norm() > far * step) continue;
          for (int c = 0; c < static_cast<int>(third.size()); ++c) {
            if (!can_fly(third[c]) || unlikeness(second[b], third[c]) > kAlike) continue;
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
