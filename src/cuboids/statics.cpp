// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "cuboids/statics.h"

#include <algorithm>
#include <cmath>

namespace unseen::cuboids {
namespace {

constexpr int kDirections = 16;
constexpr double kMarginStep = 1e-3;    // g
constexpr double kFrictionStep = 2e-3;  // of μ
constexpr double kNearHorizontal = 0.26;  // |n·up| below this: within 15° of horizontal

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
              double limit) {
  Balance last = balance(bodies, contacts);
  if (!(last.residual < stable_residual)) return 0.0;
  double least = limit;
  for (int k = 0; k < kDirections; ++k) {
    const double angle = 2.0 * kPi * k / kDirections;
    const Vec3 sideways(std::cos(angle), std::sin(angle), 0.0);
    std::vector<Vec3> start = last.forces;
    const auto stands_at = [&](double acceleration) {
      Balance pushed = balance(bodies, contacts, -Vec3::UnitZ() + acceleration * sideways, start);
      const bool stands = pushed.residual < stable_residual;
      if (stands) start = std::move(pushed.forces);
      return stands;
    };
    if (stands_at(least)) continue;
    double low = 0.0, high = least;
    while (high - low > kMarginStep) {
      const double middle = 0.5 * (low + high);
      (stands_at(middle) ? low : high) = middle;
    }
    least = low;
  }
  return least;
}

double friction_needed(std::span<const Body> bodies, std::span<const ContactPoint> contacts, double stable_residual) {
  double high = 0.0;
  for (const ContactPoint& c : contacts) high = std::max(high, c.friction);
  std::vector<Vec3> start;
  std::vector<ContactPoint> slippery(contacts.begin(), contacts.end());
  const auto stands_with = [&](double friction) {
    for (std::size_t i = 0; i < contacts.size(); ++i) slippery[i].friction = std::min(contacts[i].friction, friction);
    Balance tried = balance(bodies, slippery, -Vec3::UnitZ(), start);
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
