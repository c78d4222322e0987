// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/relations/relate.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace unseen::planes {
namespace {

constexpr double kNear = 3.0 * kPi / 180.0;      // relations that fail by more are not considered
constexpr std::size_t kEarlier = 40;             // only the heaviest frames constrain others
constexpr double kByChance = 0.12;  // relations as good that a frame may be expected to have by chance, by the share of the area that the other has

/// A relation that may hold between a frame's direction and one of an earlier frame.
struct Hypothesis {
  std::vector<Constraint> rows;  // one, or two for parallel directions
  double deviation;
  double chance;  // that two random directions come as near to the angle
};

/// Directions of a frame that planes have, and its axes.
std::vector<Vec3> telling_directions(const Evidence& p, const OrientationFrame& frame, const std::vector<Member>& members) {
  std::vector<Vec3> directions;
  const auto add = [&](const Vec3& d) {
    for (const Vec3& o : directions)
      if (line_angle(o, d) < 1e-9) return;
    directions.push_back(d);
  };
  for (const Member& m : members) add(p.locals[m.local]);
  if (frame.closed)
    for (int a = 0; a < 3; ++a) add(Vec3::Unit(a));
  return directions;
}

std::vector<Hypothesis> hypotheses(const Evidence& p, const OrientationFrame& frame, const std::vector<Vec3>& own,
                                   int index, int earlier, const OrientationFrame& other,
                                   const std::vector<Vec3>& others) {
  std::vector<Hypothesis> list;
  for (const Vec3& u : own)
    for (const Vec3& v : others) {
      const Vec3 a = frame.direction(u), b = other.direction(v);
      const double angle = line_angle(a, b);
      for (const double theta : p.angles.all) {
        if (theta > kPi / 2 + 1e-9) continue;
        const double deviation = std::abs(angle - theta);
        if (deviation > kNear) continue;
        Hypothesis h{{}, deviation, theta == 0.0 ? 1 - std::cos(deviation) : std::sin(deviation)};
        if (theta == 0.0) {
          const Vec3 first = any_orthogonal(v);
          h.rows = {{index, earlier, u, first, 0.0}, {index, earlier, u, v.cross(first), 0.0}};
        } else {
          h.rows = {{index, earlier, u, v, std::cos(theta) * (a.dot(b) < 0 ? -1.0 : 1.0)}};
          if (std::abs(theta - kPi / 2) < 1e-9) h.rows[0].cosine = 0.0;
        }
        list.push_back(std::move(h));
      }
    }
  // Parallel directions say most; among equals the nearest comes first.
  std::stable_sort(list.begin(), list.end(), [](const Hypothesis& a, const Hypothesis& b) {
    return a.rows.size() != b.rows.size() ? a.rows.size() > b.rows.size() : a.deviation < b.deviation;
  });
  return list;
}

/// True if the constraints determine independent turns of their frame.
bool independent(const std::vector<Constraint>& rows, const OrientationFrame& frame,
                 const std::vector<Group>& earlier) {
  std::vector<Vec3> basis;
  for (const Constraint& c : rows) {
    Vec3 j = residual_of(c, frame.axes, earlier[c.b].frame.axes).jacobian;
    for (const Vec3& b : basis) j -= j.dot(b) * b;
    if (j.norm() < 0.35) return false;
    basis.push_back(j.normalized());
  }
  return true;
}

}  // namespace

double chi2(const Evidence& p, const OrientationFrame& frame, const std::vector<Member>& members) {
  double sum = 0;
  for (const Member& m : members) sum += tilt_chi2(p.patch(m), frame.direction(p.locals[m.local]));
  return sum;
}

OrientationFrame fit_constrained(const Evidence& p, OrientationFrame frame, const std::vector<Member>& members,
                                 const std::vector<Constraint>& constraints,
                                 const std::vector<Group>& earlier) {
  const int rows = static_cast<int>(constraints.size());
  for (int iteration = 0; iteration < 10; ++iteration) {
    Eigen::MatrixXd system = Eigen::MatrixXd::Zero(3 + rows, 3 + rows);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(3 + rows);
    double largest = 0;
    for (const Member& m : members) {
      const Patch& patch = p.patch(m);
      for (const TiltResidual& r :
           tilt_residuals(patch.fit, frame.direction(p.locals[m.local]), patch.doubt_u, patch.doubt_v)) {
        system.topLeftCorner<3, 3>() += r.weight * r.jacobian * r.jacobian.transpose();
        right.head<3>() -= r.weight * r.value * r.jacobian;
        largest = std::max(largest, r.weight);
      }
    }
    system.diagonal().head<3>().array() += 1e-6 * largest;
    for (int i = 0; i < rows; ++i) {
      const ConstraintResidual r = residual_of(constraints[i], frame.axes, earlier[constraints[i].b].frame.axes);
      system.block<1, 3>(3 + i, 0) = largest * r.jacobian.transpose();
      system.block<3, 1>(0, 3 + i) = largest * r.jacobian;
      right[3 + i] = -largest * r.value;
    }
    const Vec3 step = system.fullPivLu().solve(right).head<3>();
    frame.axes = turned(frame.axes, step);
    if (step.norm() < 1e-13) break;
  }
  return frame;
}

void relate(const Evidence& p, Group& group, const std::vector<Group>& earlier, std::vector<Constraint>& constraints) {
  const int index = static_cast<int>(earlier.size());
  double all = 0;
  for (const Patch& patch : p.patches)
    if (!patch.bowed) all += patch.area;
  const std::vector<Vec3> own = telling_directions(p, group.frame, group.members);
  const std::size_t had = constraints.size();
  const double free = chi2(p, fit_constrained(p, group.frame, group.members, constraints, earlier), group.members);
  const std::size_t most = p.space.is_2d() ? 0 : group.frame.closed ? 3 : 2;  // turns that are left to fix
  for (std::size_t e = 0; e < std::min(earlier.size(), kEarlier) && constraints.size() < most; ++e) {
    const std::vector<Vec3> others = telling_directions(p, earlier[e].frame, earlier[e].members);
    const double unlikely = kByChance * earlier[e].weight / (all * static_cast<double>(own.size() * others.size()));
    for (const Hypothesis& h : hypotheses(p, group.frame, own, index, static_cast<int>(e), earlier[e].frame, others)) {
      if (constraints.size() + h.rows.size() > most || h.chance > unlikely) continue;
      std::vector<Constraint> more = constraints;
      more.insert(more.end(), h.rows.begin(), h.rows.end());
      if (!independent(more, group.frame, earlier)) continue;
      const OrientationFrame frame = fit_constrained(p, group.frame, group.members, more, earlier);
      if (chi2(p, frame, group.members) - free > kSignificant[more.size() - had]) continue;
      constraints = std::move(more);
      group.frame = frame;
    }
  }
}

}  // namespace unseen::planes
