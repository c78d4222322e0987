// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/reconcile.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace unseen::planes {
namespace {

// χ² beyond which a constraint is refused: three standard errors for one, two and three degrees of freedom.
constexpr double kSignificant[] = {0.0, 9.0, 11.8, 14.2};
constexpr double kTypical = 3.0;  // … or, of many patches, what each may lose on average
constexpr double kNear = 3.0 * kPi / 180.0;      // relations that fail by more are not considered
constexpr double kWithin = 15.0 * kPi / 180.0;   // a patch never turns farther than this
constexpr std::size_t kEarlier = 40;             // only the heaviest frames constrain others
constexpr double kByChance = 0.1;  // relations as good that a frame may be expected to have by chance, by the share of the area that the other has

struct Member {
  int patch, local;
};

struct Group {
  OrientationFrame frame;
  std::vector<Member> members;
  double weight = 0;
};

struct Problem {
  const Patches& patches;
  const std::vector<Vec3>& locals;
  const AngleSet& angles;
  const Space& space;

  const Patch& patch(const Member& m) const { return patches.patches[m.patch]; }
};

double chi2(const Problem& p, const OrientationFrame& frame, const std::vector<Member>& members) {
  double sum = 0;
  for (const Member& m : members) sum += tilt_chi2(p.patch(m), frame.direction(p.locals[m.local]));
  return sum;
}

/// The frame turned to suit its members best while constraints against earlier frames hold.
OrientationFrame fit_constrained(const Problem& p, OrientationFrame frame, const std::vector<Member>& members,
                                 const std::vector<Constraint>& constraints,
                                 const std::vector<OrientationFrame>& earlier) {
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
      const ConstraintResidual r = residual_of(constraints[i], frame.axes, earlier[constraints[i].b].axes);
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

/// A relation that may hold between a frame's direction and one of an earlier frame.
struct Hypothesis {
  std::vector<Constraint> rows;  // one, or two for parallel directions
  double deviation;
  double chance;  // that two random directions come as near to the angle
};

/// Directions of a frame that planes have, and its axes.
std::vector<Vec3> telling_directions(const Problem& p, const OrientationFrame& frame, const std::vector<Member>& members) {
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

std::vector<Hypothesis> hypotheses(const Problem& p, const OrientationFrame& frame, const std::vector<Vec3>& own,
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
                 const std::vector<OrientationFrame>& earlier) {
  std::vector<Vec3> basis;
  for (const Constraint& c : rows) {
    Vec3 j = residual_of(c, frame.axes, earlier[c.b].axes).jacobian;
    for (const Vec3& b : basis) j -= j.dot(b) * b;
    if (j.norm() < 0.35) return false;
    basis.push_back(j.normalized());
  }
  return true;
}

std::vector<Group> groups_of(const Problem& p, const Selection& selection) {
  std::vector<Group> groups(selection.frames.size());
  for (std::size_t k = 0; k < groups.size(); ++k) groups[k].frame = selection.frames[k];
  for (std::size_t j = 0; j < p.patches.patches.size(); ++j) {
    Group& g = groups[selection.frame_of_patch[j]];
    g.members.push_back({static_cast<int>(j), selection.local_of_patch[j]});
    g.weight += p.patches.patches[j].area;
  }
  std::erase_if(groups, [](const Group& g) { return g.members.empty(); });
  std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.weight > b.weight; });
  return groups;
}

/// The earlier group from which this one does not differ significantly, and its members' directions there.
int equivalent_group(const Problem& p, const Group& group, const std::vector<Group>& earlier,
                     std::vector<Member>& members) {
  const double free = chi2(p, group.frame, group.members);
  const double limit = kSignificant[p.space.is_2d() ? 1 : group.frame.closed ? 3 : 2];
  for (std::size_t g = 0; g < earlier.size(); ++g) {
    const OrientationFrame& frame = earlier[g].frame;
    members = group.members;
    double sum = 0, farthest = 0;
    for (Member& m : members) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t l = 0; l < (frame.closed ? p.locals.size() : 1); ++l)
        if (const double c = tilt_chi2(p.patch(m), frame.direction(p.locals[l])); c < least) {
          least = c;
          m.local = static_cast<int>(l);
        }
      sum += least;
      farthest = std::max(farthest, line_angle(p.patch(m).fit.normal, frame.direction(p.locals[m.local])));
    }
    if (sum - free < std::max(limit, kTypical * static_cast<double>(members.size())) && farthest < kWithin) return static_cast<int>(g);
  }
  return -1;
}

}  // namespace

Reconciled reconcile(const Selection& selection, const Patches& patches, const std::vector<Vec3>& locals,
                     const AngleSet& angles, const Space& space) {
  const Problem p{patches, locals, angles, space};
  Reconciled result;
  if (selection.local_fits) {
    result.frames = selection.frames;
    result.frame_of_patch = selection.frame_of_patch;
    result.local_of_patch = selection.local_of_patch;
    return result;
  }
  std::vector<Group> nodes;
  double all = 0;
  for (const Patch& patch : patches.patches) all += patch.area;
  for (Group& group : groups_of(p, selection)) {
    group.frame = fit_constrained(p, group.frame, group.members, {}, {});
    std::vector<Member> members;
    if (const int g = equivalent_group(p, group, nodes, members); g >= 0) {
      nodes[g].members.insert(nodes[g].members.end(), members.begin(), members.end());
      continue;
    }
    const int index = static_cast<int>(nodes.size());
    const std::vector<Vec3> own = telling_directions(p, group.frame, group.members);
    const double free = chi2(p, group.frame, group.members);
    std::vector<Constraint> rows;
    const std::size_t most = space.is_2d() ? 0 : group.frame.closed ? 3 : 2;  // turns that are left to fix
    for (std::size_t e = 0; e < std::min(nodes.size(), kEarlier) && rows.size() < most; ++e) {
      const std::vector<Vec3> others = telling_directions(p, nodes[e].frame, nodes[e].members);
      const double unlikely = kByChance * nodes[e].weight / (all * static_cast<double>(own.size() * others.size()));
      for (const Hypothesis& h : hypotheses(p, group.frame, own, index, static_cast<int>(e), nodes[e].frame, others)) {
        if (rows.size() + h.rows.size() > most || h.chance > unlikely) continue;
        std::vector<Constraint> more = rows;
        more.insert(more.end(), h.rows.begin(), h.rows.end());
        if (!independent(more, group.frame, result.frames)) continue;
        const OrientationFrame frame = fit_constrained(p, group.frame, group.members, more, result.frames);
        if (chi2(p, frame, group.members) - free > kSignificant[more.size()]) continue;
        rows = std::move(more);
        group.frame = frame;
      }
    }
    result.constraints.insert(result.constraints.end(), rows.begin(), rows.end());
    result.frames.push_back(group.frame);
    nodes.push_back(std::move(group));
  }
  result.frame_of_patch.assign(patches.patches.size(), -1);
  result.local_of_patch.assign(patches.patches.size(), -1);
  for (std::size_t g = 0; g < nodes.size(); ++g)
    for (const Member& m : nodes[g].members) {
      result.frame_of_patch[m.patch] = static_cast<int>(g);
      result.local_of_patch[m.patch] = m.local;
    }
  return result;
}

}  // namespace unseen::planes
