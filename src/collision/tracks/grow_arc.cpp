// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "collision/tracks/grow_arc.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace unseen::collision {
namespace {

constexpr double kGate = 3.5;           // σ
constexpr int kMisses = 4;              // frames in a row
constexpr double kOther = 1.0;          // σ² between looks
constexpr double kFilled = 0.6;         // share of the seed's frames that must be on the curve
constexpr double kMuchLess = 0.6;       // of the noise: jitter that neighbours are held to
constexpr double kRough = 0.1;          // of the noise, added to the jitter
constexpr std::size_t kNeighbours = 8, kFewestNeighbours = 5;
constexpr std::size_t kSmoothest = 14;  // points

/// As large as the first of them, in the colour of all: a region of two bodies must not lead from one of them to the other.
Candidate look_of(const std::vector<const Candidate*>& near) {
  Candidate look = *near.front();
  look.color = Vec3::Zero();
  for (const Candidate* c : near) look.color += c->color / static_cast<double>(near.size());
  return look;
}

}  // namespace

bool can_fly(const Candidate& c) { return c.whole && !c.shadow; }

ArcGrower::ArcGrower(const Candidates& candidates, double noise, double jitter)
    : candidates_(candidates), noise_(noise), jitter_(jitter < kMuchLess * noise ? std::hypot(jitter, kRough * noise) : 0.0) {}

std::optional<Arc> ArcGrower::grow(int first, int step, const Candidate& a, const Candidate& b, const Candidate& c) {
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
  if (points_.size() > kSmoothest) {
    grow_again();
    drop_strays();
  }
  if (points_.size() < kFewestOfArc) return {};
  std::vector<Candidate> points;
  for (const auto& [frame, point] : points_) points.push_back(point);
  Arc arc = arc_of(std::move(points));
  return arc.noise < 2.0 * noise_ ? std::optional(arc) : std::nullopt;
}

void ArcGrower::add(const Candidate& c) {
  points_.emplace(c.frame, c);
  sums_.add(c.u, c.pixel);
}

void ArcGrower::extend(int k, int direction) {
  for (int misses = 0; misses <= kMisses && k >= 0 && k < static_cast<int>(candidates_.size()); k += direction) {
    if (candidates_[k].empty()) {
      ++misses;
      continue;
    }
    const Curve curve = sums_.fit();
    const Candidate* found = nearest(k, curve, look_of(at_end(direction)), curve.variance_at(candidates_[k].front().u));
    if (found && !led_to(*found, curve, direction)) found = nullptr;
    if (found) add(*found);
    misses = found ? 0 : misses + 1;
  }
}

/// Grows again from the smoothest stretch: the seed may have had the moment of a push, or of two bodies seen as one, in its middle.
void ArcGrower::grow_again() {
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

/// Drops at both ends what looks otherwise and lies beyond a gap of more frames than it has points: where bodies meet, a region of both may by chance
/// lie on the way that one would have gone.
void ArcGrower::drop_strays() {
  for (const int direction : {1, -1}) {
    const std::vector<const Candidate*> near = at_end(direction);
    for (std::size_t count = 1; count < near.size(); ++count) {
      const int gap = std::abs(near[count]->frame - near[count - 1]->frame) - 1;
      if (gap <= static_cast<int>(count) || unlikeness(look_of({near.begin(), near.begin() + count}), look_of({near.begin() + count, near.end()})) < kOther) continue;
      const std::map<int, Candidate> all = std::exchange(points_, {});
      sums_ = CurveSums(all.begin()->second.u);
      for (const auto& [frame, point] : all)
        if ((frame - near[count]->frame) * direction <= 0) add(point);
      break;
    }
  }
}

/// The points at the end that grows, the last one first.
std::vector<const Candidate*> ArcGrower::at_end(int direction) const {
  std::vector<const Candidate*> near;
  const auto add_near = [&](auto begin, auto end) {
    for (auto it = begin; it != end && near.size() < kNeighbours; ++it) near.push_back(&it->second);
  };
  if (direction > 0) add_near(points_.rbegin(), points_.rend());
  else add_near(points_.begin(), points_.end());
  return near;
}

/// Whether the points at the end that grows lead to `next`: where they do not, something pushed the body.
bool ArcGrower::led_to(const Candidate& next, const Curve& curve, int direction) const {
  if (jitter_ == 0.0 || points_.size() < kFewestNeighbours) return true;
  CurveSums near(next.u);
  for (const Candidate* c : at_end(direction)) near.add(c->u, c->pixel);
  const Curve local = near.fit(curve.curvature, jitter_ * jitter_ / (noise_ * noise_ * curve.cofactor(2, 2)));
  const double sigma = jitter_ * std::sqrt(1.0 + local.variance_at(next.u));
  return (next.pixel - local.at(next.u)).norm() < kGate * sigma;
}

const Candidate* ArcGrower::nearest(int k, const Curve& curve, const Candidate& like, double variance) const {
  const Candidate* best = nullptr;
  const double sigma = noise_ * std::sqrt(1.0 + std::min(variance, 8.0));
  double least = kGate * kGate;
  for (const Candidate& c : candidates_[k]) {
    if (!can_fly(c)) continue;
    const double off = (c.pixel - curve.at(c.u)).squaredNorm() / (2.0 * sigma * sigma), unlike = unlikeness(c, like);
    if (unlike < kLooksAlike && off + unlike < least + kLooksAlike && off < kGate * kGate / 2.0 && (!best || off + unlike < least)) {
      best = &c;
      least = off + unlike;
    }
  }
  return best;
}

}  // namespace unseen::collision
