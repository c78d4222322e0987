// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>
#include <limits>

#include "cuboids/boxes/box_overlap.h"
#include "cuboids/evaluate/evaluate_parts.h"

namespace unseen::cuboids {
namespace {

constexpr double kUpright = 0.97;                       // |cos| of an axis that counts as vertical
constexpr double kParallel = 0.99;                      // the same of two boxes' axes
constexpr double kLevel = 0.01;                         // m, things that deep inside still count as below
constexpr double kFlush = 0.02, kFlushShare = 0.1;      // m, of the size: sides of two pieces of one box
constexpr double kMoved = 0.05;                         // ε of Eq. 4.5
constexpr double kHiddenBelow = 0.9;                    // of a dimension that is seen

/// m, from below to above along a unit direction.
std::pair<double, double> interval(const OrientedBox& box, const Vec3& direction) {
  const double center = direction.dot(box.center), half = half_extent(box, direction);
  return {center - half, center + half};
}

OrientedBox with_interval(OrientedBox box, int k, double low, double high) {
  box.center += ((low + high) / 2.0 - box.axes.col(k).dot(box.center)) * box.axes.col(k);
  box.half_size[k] = (high - low) / 2.0;
  return box;
}

/// The box of `a`'s axes around both.
OrientedBox around(const OrientedBox& a, const OrientedBox& b) {
  OrientedBox box = a;
  for (int k = 0; k < 3; ++k) {
    const auto [low, high] = interval(a, a.axes.col(k));
    const auto [other_low, other_high] = interval(b, a.axes.col(k));
    box = with_interval(box, k, std::min(low, other_low), std::max(high, other_high));
  }
  return box;
}

bool are_parallel(const OrientedBox& a, const OrientedBox& b) {
  return ((a.axes.transpose() * b.axes).cwiseAbs().rowwise().maxCoeff().array() > kParallel).all();
}

/// True if the two have the same cross-section along one of their axes.
bool are_collinear(const OrientedBox& a, const OrientedBox& b) {
  if (!are_parallel(a, b)) return false;
  int flush = 0;
  for (int k = 0; k < 3; ++k) {
    const auto [low, high] = interval(a, a.axes.col(k));
    const auto [other_low, other_high] = interval(b, a.axes.col(k));
    const double tolerance = std::max(kFlush, kFlushShare * (high - low));
    flush += std::abs(low - other_low) < tolerance && std::abs(high - other_high) < tolerance;
  }
  return flush >= 2;
}

/// m², of the overlap of two boxes' outlines from above: of a slice through both, as if they were as high as needed.
bool is_above(const OrientedBox& upper, OrientedBox lower) {
  const auto [low, high] = interval(upper, Vec3::UnitZ());
  lower.center.z() = (low + high) / 2.0;
  return separation(upper, lower) < -kLevel;
}

double right_share(double size, double real) {
  return std::max(0.0, 1.0 - std::abs(size - real) / real);
}

}  // namespace

std::vector<OrientedBox> dropped(const std::vector<OrientedBox>& boxes) {
  std::vector<OrientedBox> out = boxes;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    int k = 0;
    const double upright = boxes[i].axes.row(2).cwiseAbs().maxCoeff(&k);
    if (upright < kUpright) continue;
    const double bottom = interval(boxes[i], Vec3::UnitZ()).first;
    double floor = 0.0;
    for (std::size_t j = 0; j < boxes.size(); ++j) {
      const double top = interval(boxes[j], Vec3::UnitZ()).second;
      if (j != i && top <= bottom + kLevel && is_above(boxes[i], boxes[j])) floor = std::max(floor, top);
    }
    if (floor >= bottom) continue;
    const auto [low, high] = interval(boxes[i], boxes[i].axes.col(k));
    const double more = (bottom - floor) / upright;
    out[i] = boxes[i].axes(2, k) > 0 ? with_interval(boxes[i], k, low - more, high)
                                     : with_interval(boxes[i], k, low, high + more);
  }
  return out;
}

std::vector<OrientedBox> fused(const std::vector<OrientedBox>& boxes) {
  std::vector<OrientedBox> out = boxes;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = 0; j < boxes.size(); ++j)
      if (i != j && are_collinear(boxes[i], boxes[j])) out[i] = around(out[i], boxes[j]);
  return out;
}

std::vector<OrientedBox> joined(const Completion& result, const Matching& matching) {
  std::vector<OrientedBox> out;
  for (std::size_t i = 0; i < result.cuboids.size(); ++i) {
    OrientedBox box = result.cuboids[i].box;
    for (std::size_t j = 0; j < result.cuboids.size(); ++j) {
      const int a = result.cuboids[i].id, b = result.cuboids[j].id;
      const bool one = i != j && matching.true_of_result[i] >= 0 && matching.true_of_result[i] == matching.true_of_result[j];
      const bool held = std::any_of(result.contacts.begin(), result.contacts.end(), [&](const Contact& contact) {
        return contact.kind == ContactKind::fixed &&
               ((contact.a == a && contact.b == b) || (contact.a == b && contact.b == a));
      });
      if (one && held) box = around(box, result.cuboids[j].box);
    }
    out.push_back(box);
  }
  return out;
}

Vec3 sizes_like(const OrientedBox& box, const TrueCuboid& truth) {
  const Vec3 size = 2.0 * box.half_size;
  Mat3 likeness;
  if (truth.box)
    likeness = (truth.box->axes.transpose() * box.axes).cwiseAbs();
  else
    for (int real = 0; real < 3; ++real)
      for (int k = 0; k < 3; ++k) likeness(real, k) = right_share(size[k], truth.size[real]);
  std::array<int, 3> order = {0, 1, 2}, best = order;
  double most = -1;
  do {
    const double sum = likeness(0, order[0]) + likeness(1, order[1]) + likeness(2, order[2]);
    if (sum > most + 1e-12) {
      most = sum;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  return {size[best[0]], size[best[1]], size[best[2]]};
}

void score_sizes(const Completion& result, const Truth& truth, const Matching& matching, Evaluation& e) {
  std::vector<OrientedBox> fitted;
  for (const Cuboid& cuboid : result.cuboids) fitted.push_back(cuboid.initial);
  const std::vector<OrientedBox> drop = dropped(fitted), fuse = dropped(fused(fitted)), complete = joined(result, matching);
  double weight = 0;
  for (std::size_t t = 0; t < truth.cuboids.size(); ++t) {
    const TrueCuboid& real = truth.cuboids[t];
    std::array<Vec3, 4> sizes;  // of each way, zero if nothing was found
    sizes.fill(Vec3::Zero());
    if (!matching.pieces[t].empty()) {
      const int r = matching.pieces[t].front();
      sizes = {sizes_like(fitted[r], real), sizes_like(drop[r], real), sizes_like(fuse[r], real),
               sizes_like(complete[r], real)};
    }
    for (int k = 0; k < 3; ++k) {
      for (SizeScore* score : {&e.sizes, real.seen[k] < kHiddenBelow ? &e.hidden_sizes : &e.seen_sizes}) {
        ++score->dimensions;
        score->fitted += right_share(sizes[0][k], real.size[k]);
        score->dropped += right_share(sizes[1][k], real.size[k]);
        score->fused += right_share(sizes[2][k], real.size[k]);
        score->completed += right_share(sizes[3][k], real.size[k]);
      }
      if (matching.pieces[t].empty()) continue;
      const double before = std::abs(sizes[0][k] - real.size[k]) / real.size[k];
      const double after = std::abs(sizes[3][k] - real.size[k]) / real.size[k];
      if (std::abs(before - after) <= kMoved) continue;
      ++e.change.dimensions;
      weight += real.size[k];
      e.change.before += real.size[k] * before;
      e.change.after += real.size[k] * after;
      e.change.change += real.size[k] * std::abs(before - after);
    }
  }
  for (SizeScore* score : {&e.sizes, &e.seen_sizes, &e.hidden_sizes})
    for (double* share : {&score->fitted, &score->dropped, &score->fused, &score->completed})
      if (score->dimensions > 0) *share /= static_cast<double>(score->dimensions);
  for (double* mean : {&e.change.before, &e.change.after, &e.change.change})
    if (weight > 0) *mean /= weight;
}

}  // namespace unseen::cuboids
