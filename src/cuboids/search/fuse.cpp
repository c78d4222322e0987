// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "cuboids/objects/groove.h"
#include "cuboids/objects/tints.h"
#include "cuboids/search/complete.h"
#include "cuboids/search/hypotheses.h"
#include "cuboids/search/slab_patch.h"

namespace unseen::cuboids {
namespace {

constexpr double kSameYaw = 10.0;  // deg: what two visible parts of one box may differ by

constexpr double kKnownObject = 0.4;  // share that may be free where a label says that parts are one: boxes only resemble things
const double kLeansCosine = std::cos(radians(5.0));
constexpr double kLeansInto = 0.25;  // share of what the whole adds to its parts, in what it leans on
constexpr double kOverlap = 0.3;  // of the shorter part's length: parts of one box may each reach into the other
constexpr double kSlabOff = 0.03, kTurnedOff = 2.0;  // of a slab's length, and of what its turn moves: that the end of a patch may be off
constexpr double kOfThin = 0.5;   // of a part thinner than the tolerance, as a top of which nothing else was seen: that overlaps
constexpr double kSpacings = 3.0;  // between pixels, that an edge may be off
constexpr double kLeastTolerance = 0.004, kLargestTolerance = 0.03;  // m

OrientedBox box_of(const Mat3& axes, const std::array<Span, 3>& spans) {
  OrientedBox box;
  box.axes = axes;
  for (int k = 0; k < 3; ++k) {
    box.half_size[k] = 0.5 * (spans[k].high - spans[k].low);
    box.center += 0.5 * (spans[k].high + spans[k].low) * axes.col(k);
  }
  return box;
}

/// Axes of `b` in the order and with the signs that bring them nearest to those of `a`; none if they differ too much.
std::optional<Mat3> aligned_axes(const OrientedBox& a, const OrientedBox& b) {
  Mat3 out;
  for (int k = 0; k < 3; ++k) {
    int nearest = 0;
    (b.axes.transpose() * a.axes.col(k)).cwiseAbs().maxCoeff(&nearest);
    const Vec3 axis = b.axes.col(nearest);
    if (line_angle(axis, a.axes.col(k)) > radians(kSameYaw)) return std::nullopt;
    out.col(k) = axis.dot(a.axes.col(k)) < 0.0 ? Vec3(-axis) : axis;
  }
  return out;
}

/// The box around two parts of one known object, along the axes of the larger; none if it enters free space.
std::optional<OrientedBox> joined_object(const DepthView& view, const Cuboid& a, const Cuboid& b, double tolerance) {
  const OrientedBox& larger = a.initial.volume() >= b.initial.volume() ? a.initial : b.initial;
  std::array<Span, 3> spans;
  for (int k = 0; k < 3; ++k) {
    const Span first = span_along(a.initial, larger.axes.col(k)), second = span_along(b.initial, larger.axes.col(k));
    spans[k] = {std::min(first.low, second.low), std::max(first.high, second.high)};
  }
  const OrientedBox whole = box_of(larger.axes, spans);
  return in_hidden_space(view, {&larger, 1}, whole, tolerance, kKnownObject) ? std::optional(whole) : std::nullopt;
}

/// Whether most of what was measured where a side of the whole would be is farther.
bool is_groove(const DepthView& view, const OrientedBox& gap, int apart) {
  const std::vector<double> shares = seen_through(view, gap, apart, 0.0);
  return std::any_of(shares.begin(), shares.end(), [](double share) { return share > 0.5; });
}

/// Whether neither labels, nor levels of a stack, nor colours part them.
bool may_be_one(const Cuboid& a, const Cuboid& b) {
  if (a.label != b.label || (a.stack >= 0 && a.stack == b.stack && a.level != b.level)) return false;
  return !a.label.empty() || !a.tint || !b.tint || !are_other_tints(*a.tint, *b.tint);
}

/// Of two boxes in one place the one that holds the other, if this ends in two of its planes.
std::optional<OrientedBox> around_both(const OrientedBox& a, const OrientedBox& b, const std::array<Span, 3>& of_a, const std::array<Span, 3>& of_b,
                                       double tolerance) {
  const bool first = a.volume() >= b.volume();
  tolerance = std::min(tolerance, (first ? b : a).half_size.minCoeff());  // what lies on a box is no part of it
  const auto &outer = first ? of_a : of_b, &inner = first ? of_b : of_a;
  int flush = 0;
  for (int k = 0; k < 3; ++k) {
    const double low = inner[k].low - outer[k].low, high = outer[k].high - inner[k].high;
    if (std::min(low, high) < -tolerance) return std::nullopt;
    flush += (std::abs(low) <= tolerance) + (std::abs(high) <= tolerance);
  }
  return flush >= 2 ? std::optional(first ? a : b) : std::nullopt;
}

/// The box of which both are visible parts; none if they are not: along two axes they must have a plane in common, they
/// are apart along the third or overlap by little of the shorter (by any of a slab), and what the whole adds to them is hidden.
std::optional<OrientedBox> joined(const DepthView& view, const Cuboid& a, const Cuboid& b, double tolerance) {
  if (!may_be_one(a, b)) return std::nullopt;
  if (!a.label.empty()) return joined_object(view, a, b, tolerance);
  if (a.visible_points + b.visible_points == 0) return std::nullopt;  // nothing was seen of either
  if (is_patch_of(a.initial, b.initial, tolerance)) return b.initial;
  if (is_patch_of(b.initial, a.initial, tolerance)) return a.initial;
  const auto axes_b = aligned_axes(a.initial, b.initial);
  if (!axes_b) return std::nullopt;
  const double weight = static_cast<double>(a.visible_points) / static_cast<double>(a.visible_points + b.visible_points);
  Mat3 axes = weight * a.initial.axes + (1.0 - weight) * *axes_b;
  axes.col(2).normalize();
  axes.col(0) = (axes.col(0) - axes.col(0).dot(axes.col(2)) * axes.col(2)).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  // What the turn of either may be wrong by moves the other's ends.
  const double turn = line_angle(a.initial.axes.col(0), axes_b->col(0)), turned = 0.5 * turn * (a.initial.center - b.initial.center).norm();
  std::array<Span, 3> of_a, of_b, spans;
  for (int k = 0; k < 3; ++k) {
    of_a[k] = span_along(a.initial, axes.col(k)), of_b[k] = span_along(b.initial, axes.col(k));
    spans[k] = {std::min(of_a[k].low, of_b[k].low), std::max(of_a[k].high, of_b[k].high)};
  }
  const auto overlap = [&](int k) { return std::min(of_a[k].high, of_b[k].high) - std::max(of_a[k].low, of_b[k].low); };
  const auto share = [&](int k) {
    const double shorter = std::min(of_a[k].high - of_a[k].low, of_b[k].high - of_b[k].low);
    return overlap(k) <= std::min(tolerance, kOfThin * shorter) ? 0.0 : overlap(k) / shorter;
  };
  int apart = 0;
  for (int k = 1; k < 3; ++k)
    if (share(k) < share(apart)) apart = k;
  if (const auto larger = around_both(a.initial, b.initial, of_a, of_b, tolerance)) return larger;
  const bool one_slab = are_one_slab(a.initial, b.initial, tolerance);
  if (share(apart) > kOverlap && !one_slab) return std::nullopt;
  for (int k = 0; k < 3; ++k) {
    if (k == apart) continue;
    if (share(k) == 0.0) return std::nullopt;
    // One end of both lies in one plane; where the other one of the shorter part ends, something hides it.
    const double low = std::abs(of_a[k].low - of_b[k].low), high = std::abs(of_a[k].high - of_b[k].high);
    const double length = spans[k].high - spans[k].low, of_turn = kTurnedOff * turn * std::max(of_a[apart].high - of_a[apart].low, of_b[apart].high - of_b[apart].low);
    const double off = 2.0 * tolerance + std::min(turned, tolerance) + (one_slab ? std::min(kSlabOff * length, of_turn) : 0.0);
    if (std::min(low, high) > off) return std::nullopt;
    if (!one_slab) continue;
    const Span& better = weight < 0.5 ? of_b[k] : of_a[k];
    if (low <= off) spans[k].low = better.low;
    if (high <= off) spans[k].high = better.high;
  }
  const OrientedBox whole = box_of(axes, spans);
  spans[apart] = {std::min(of_a[apart].high, of_b[apart].high), std::max(of_a[apart].low, of_b[apart].low)};
  const bool is_gap = spans[apart].high > spans[apart].low;
  const OrientedBox gap = box_of(axes, spans);
  if (is_gap && (!in_hidden_space(view, {}, gap, tolerance) || is_groove(view, gap, apart))) return std::nullopt;
  const std::array parts = {a.initial, b.initial};
  return in_hidden_space(view, parts, whole, tolerance) ? std::optional(whole) : std::nullopt;
}

/// Whether a third box leaves no room for the whole of two parts. What leans on a box touches it along an edge that may be hidden, so that a small error of
/// either puts the one into the other.
bool is_in_the_way(const OrientedBox& other, const OrientedBox& whole, std::span<const OrientedBox> parts, double tolerance) {
  const auto meet = interface_of(solid_of(whole), solid_of(other), 0.0);
  if (!meet || -meet->gap <= tolerance || stands_too_low(other, whole, -meet->gap, tolerance)) return false;
  int thin = 0;
  whole.half_size.minCoeff(&thin);
  const bool leans = (other.axes.transpose() * whole.axes.col(thin)).cwiseAbs().maxCoeff() < kLeansCosine;
  return !leans || share_inside(parts, whole, other, tolerance) > kLeansInto;
}

}  // namespace

std::vector<double> contact_tolerance(const DepthView& view, const std::vector<Cuboid>& cuboids) {
  std::vector<double> out;
  for (const Cuboid& cuboid : cuboids) {
    const Vec3& place = cuboid.initial.center;
    out.push_back(std::clamp(view.sigma(place) + kSpacings * view.spacing(place), kLeastTolerance, kLargestTolerance));
  }
  return out;
}

std::size_t fuse_pieces(const DepthView& view, std::vector<Cuboid>& cuboids, std::vector<double>& tolerance) {
  std::size_t fused = 0;
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < cuboids.size() && !again; ++i)
      for (std::size_t j = i + 1; j < cuboids.size() && !again; ++j) {
        const double within = std::max(tolerance[i], tolerance[j]);
        const auto whole = joined(view, cuboids[i], cuboids[j], within);
        if (!whole) continue;
        const std::array parts = {cuboids[i].initial, cuboids[j].initial};
        const bool blocked = std::any_of(cuboids.begin(), cuboids.end(), [&](const Cuboid& other) {
          if (&other == &cuboids[i] || &other == &cuboids[j]) return false;
          if (may_be_one(other, cuboids[i]) && may_be_one(other, cuboids[j]) && is_patch_of(other.initial, *whole, within)) return false;
          return is_in_the_way(other.initial, *whole, parts, within);
        });
        if (blocked) continue;
        cuboids[i].initial = cuboids[i].box = *whole;
        cuboids[i].visible_points += cuboids[j].visible_points;
        if (cuboids[i].stack < 0) cuboids[i].stack = cuboids[j].stack, cuboids[i].level = cuboids[j].level;
        cuboids.erase(cuboids.begin() + static_cast<std::ptrdiff_t>(j));
        tolerance.erase(tolerance.begin() + static_cast<std::ptrdiff_t>(j));
        ++fused;
        again = true;
      }
  }
  return fused;
}

}  // namespace unseen::cuboids
