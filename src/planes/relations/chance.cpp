// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>

#include "planes/relations/relate.h"

namespace unseen::planes {
namespace {

constexpr double kAnyTurn = 5.0;  // rad: a normal prior of this deviation about each axis is as good as any rotation alike, where one axis is left open
constexpr double kAnyTilt = 1.0;  // rad: larger doubts say no more

/// How often a patch would be matched with some frame by chance, as a logarithm: with one of its neighbours' frames, or with any of the scene.
std::vector<double> log_choices(const Evidence& p, const std::vector<std::set<int>>& adjoining, const std::vector<int>& group_of, std::size_t groups,
                                const std::vector<Member>& members) {
  std::vector<double> choices;
  for (const Member& m : members) {
    std::set<int> near;
    for (const int other : adjoining[m.patch])
      if (group_of[other] >= 0) near.insert(group_of[other]);
    const bool neighbour = near.count(group_of[m.patch]) > 0;
    choices.push_back(std::log(static_cast<double>(p.locals.size() * (neighbour ? near.size() : groups))));
  }
  return choices;
}

/// The evidence for a group, less what its members could have come to: one is where it is, and the others come to it.
double supported(const Evidence& p, const Group& group, const std::vector<double>& choices) {
  const double all = std::accumulate(choices.begin(), choices.end(), 0.0), most = *std::max_element(choices.begin(), choices.end());
  return log_evidence(p, group) - (all - most);
}

template <class T>
std::vector<T> without(std::vector<T> values, std::size_t i) {
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(i));
  return values;
}

/// The member, of those that the frame certainly turns off their fit, without which there is most evidence for the rest, if more than with it.
std::optional<std::size_t> here_by_chance(const Evidence& p, const Group& group, const std::vector<double>& choices) {
  const OrientationFrame frame = fit_constrained(p, group.frame, group.members, {}, {});
  double best = supported(p, group, choices);
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < group.members.size(); ++i) {
    const Member& m = group.members[i];
    if (noise_chi2(p.patch(m), frame.direction(p.locals[m.local])) < p.certain) continue;
    const double rest = supported(p, {group.frame, without(group.members, i), 0.0}, without(choices, i));
    if (rest > best) best = rest, found = i;
  }
  return found;
}

}  // namespace

double log_evidence(const Evidence& p, const Group& group) {
  const OrientationFrame frame = fit_constrained(p, group.frame, group.members, {}, {});
  double sum = 0;
  Mat3 information = Mat3::Identity() / (kAnyTurn * kAnyTurn);
  for (const Member& m : group.members) {
    const Patch& patch = p.patch(m);
    const double u = std::min(patch.doubt_u, kAnyTilt * kAnyTilt), v = std::min(patch.doubt_v, kAnyTilt * kAnyTilt);
    sum -= 0.5 * std::log(u * v);
    double chi2 = 0;
    for (const TiltResidual& r : tilt_residuals(patch.fit, frame.direction(p.locals[m.local]), u, v)) {
      chi2 += r.weight * r.value * r.value;
      information += r.weight * r.jacobian * r.jacobian.transpose();
    }
    sum -= 2 * std::log1p(0.5 * chi2);  // Student's t with two degrees of freedom: of some patches the doubt says too little
  }
  return sum + std::log(std::pow(2 * kPi, 1.5) / (8 * kPi * kPi)) - 0.5 * std::log(information.determinant());
}

bool part_by_chance(const Evidence& p, const std::vector<std::pair<int, int>>& adjoining_pairs, std::vector<Group>& groups) {
  std::vector<std::set<int>> adjoining(p.patches.size());
  for (const auto& [a, b] : adjoining_pairs) adjoining[a].insert(b), adjoining[b].insert(a);
  std::vector<int> group_of(p.patches.size(), -1);
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (const Member& m : groups[g].members) group_of[m.patch] = static_cast<int>(g);
  const std::size_t count = groups.size();
  for (std::size_t g = 0; g < count; ++g)
    while (groups[g].members.size() > 1) {
      const std::optional<std::size_t> leaves = here_by_chance(p, groups[g], log_choices(p, adjoining, group_of, count, groups[g].members));
      if (!leaves) break;
      const int patch = groups[g].members[*leaves].patch;
      const double area = p.patches[patch].area;
      groups[g].members = without(std::move(groups[g].members), *leaves);
      groups[g].weight -= area;
      group_of[patch] = static_cast<int>(groups.size());
      groups.push_back({open_frame(p.patches[patch].fit.normal, p.space), {{patch, 0}}, area});
    }
  return groups.size() > count;
}

}  // namespace unseen::planes
