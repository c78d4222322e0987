// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/statics/statics.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace unseen::cuboids {
namespace {

constexpr std::size_t kDirections = 16;
constexpr double kMarginStep = 1e-3;    // g
constexpr double kFrictionStep = 2e-3;  // of μ
constexpr double kRoughResidual = 1e-4;  // Effort::certain: only falling or not counts
constexpr double kNearHorizontal = 0.26;  // |n·up| below this: within 15° of horizontal

Vec3 direction(std::size_t k) {
  const double angle = 2.0 * kPi * static_cast<double>(k) / kDirections;
  return {std::cos(angle), std::sin(angle), 0.0};
}

/// How large a push can be at most in each direction, by the collapses found so far: ‖r‖ is convex in the push, and
/// the sum of the motions is its gradient.
struct PushBounds {
  explicit PushBounds(double limit) { high.fill(limit); }

  /// The direction with the least bound among those not yet taken.
  std::size_t take_worst() {
    std::size_t worst = kDirections;
    for (std::size_t k = 0; k < kDirections; ++k)
      if (!taken[k] && (worst == kDirections || high[k] < high[worst])) worst = k;
    taken[worst] = true;
    return worst;
  }

  void lower(const Vec3& push, const Balance& collapse, double stable_residual) {
    Vec3 sum = Vec3::Zero();
    double norm = 0.0;
    for (const Vec6& motion : collapse.motion) {
      sum += motion.head<3>();
      norm += motion.squaredNorm();
    }
    norm = std::sqrt(norm);
    // ‖r‖ has to fall to what it is where its largest part, the residual, is just stable.
    const double fall = norm - stable_residual * norm / collapse.residual;
    for (std::size_t k = 0; k < kDirections; ++k) {
      const double slope = sum.dot(direction(k)) / norm, here = sum.dot(push) / norm;
      if (slope > 0.0) high[k] = std::min(high[k], std::max((here - fall) / slope, 0.0));
    }
  }

  std::array<double, kDirections> high;
  std::array<bool, kDirections> taken{};
};

}  // namespace

std::vector<Body> merge(std::span<const Body> bodies, std::span<const int> group, int groups) {
  std::vector<Body> merged(groups);
  std::vector<Vec3> sum(groups, Vec3::Zero());
  std::vector<int> count(groups, 0), any(groups, -1);
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& whole = merged[group[i]];
    whole.is_static |= bodies[i].is_static;
    any[group[i]] = static_cast<int>(i);
    if (bodies[i].is_static) continue;
    whole.weight += bodies[i].weight;
    sum[group[i]] += bodies[i].weight * bodies[i].center;
    ++count[group[i]];
  }
  for (int g = 0; g < groups; ++g) {
    if (count[g] > 0) {
      merged[g].center = sum[g] / merged[g].weight;
    } else if (any[g] >= 0) {
      merged[g].center = bodies[any[g]].center;
    }
  }
  // The half size of a whole reaches from its centre to the far end of each part's.
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Body& whole = merged[group[i]];
    if (bodies[i].is_static && count[group[i]] > 0) continue;
    whole.half_size = std::max(whole.half_size, (bodies[i].center - whole.center).norm() + bodies[i].half_size);
  }
  return merged;
}

double margin(std::span<const Body> bodies, std::span<const ContactPoint> contacts, double stable_residual,
              double limit, const Context& context) {
  const Balance at_rest = balance(bodies, contacts, -Vec3::UnitZ(), {}, {}, context);
  if (!(at_rest.residual < stable_residual)) return 0.0;
  const Effort effort{0.5 * stable_residual, kRoughResidual};
  PushBounds bounds(limit + kMarginStep);
  double least = limit;
  for (std::size_t checked = 0; checked < kDirections; ++checked) {
    const std::size_t k = bounds.take_worst();
    const auto stands_at = [&](double acceleration) {
      const Vec3 push = acceleration * direction(k);
      const Balance pushed = balance(bodies, contacts, push - Vec3::UnitZ(), at_rest.forces, effort, context);
      const bool stands = pushed.residual < stable_residual;
      if (!stands) {
        bounds.high[k] = acceleration;
        bounds.lower(push, pushed, stable_residual);
      }
      return stands;
    };
    // Just below the bound, then farther and farther below it.
    double low = std::min(least, bounds.high[k] - kMarginStep);
    for (double step = kMarginStep; low > 0.0 && !stands_at(low); step *= 2.0)
      low = std::min(low, bounds.high[k]) - step;
    if (low <= 0.0) low = 0.0;
    while (std::min(least, bounds.high[k]) - low > kMarginStep) {
      const double middle = 0.5 * (low + std::min(least, bounds.high[k]));
      if (stands_at(middle)) low = middle;
    }
    least = low;
    if (least == 0.0) return 0.0;
  }
  return least;
}

double friction_needed(std::span<const Body> bodies, std::span<const ContactPoint> contacts, double stable_residual,
                       const Context& context) {
  double high = 0.0;
  for (const ContactPoint& c : contacts) high = std::max(high, c.friction);
  const Effort effort{0.5 * stable_residual, kRoughResidual};
  std::vector<Vec3> start;
  std::vector<ContactPoint> slippery(contacts.begin(), contacts.end());
  const auto stands_with = [&](double friction) {
    for (std::size_t i = 0; i < contacts.size(); ++i) slippery[i].friction = std::min(contacts[i].friction, friction);
    Balance tried = balance(bodies, slippery, -Vec3::UnitZ(), start, effort, context);
    const bool stands = tried.residual < stable_residual;
    if (stands) start = std::move(tried.forces);
    return stands;
  };
  if (!stands_with(high)) return high;
  if (stands_with(0.0)) return 0.0;
  double low = 0.0;
  while (high - low > kFrictionStep) {
    const double middle = 0.5 * (low + high);
    (stands_with(middle) ? high : low) = middle;
  }
  return high;
}

double measured_friction(const Vec3& normal, double friction, const Vec3& up) {
  return std::abs(normal.dot(up)) < kNearHorizontal ? 0.0 : friction;
}

}  // namespace unseen::cuboids
