// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/relations/reconcile.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>
#include <utility>

#include "planes/relations/relate.h"

namespace unseen::planes {
namespace {

constexpr double kTypical = 3.0;  // χ² that each of many patches may lose on average, if that is more than is significant
constexpr double kWithin = 15.0 * kPi / 180.0;  // a patch never turns farther than this

std::vector<Group> groups_of(const Evidence& p, const Selection& selection) {
  std::vector<Group> groups(selection.frames.size());
  for (std::size_t k = 0; k < groups.size(); ++k) groups[k].frame = selection.frames[k];
  for (std::size_t j = 0; j < p.patches.size(); ++j) {
    Group& g = groups[selection.frame_of_patch[j]];
    g.members.push_back({static_cast<int>(j), selection.local_of_patch[j]});
    g.weight += p.patches[j].area;
  }
  std::erase_if(groups, [](const Group& g) { return g.members.empty(); });
  std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.weight > b.weight; });
  return groups;
}

/// Whether a group is a bowed patch: it is related to nothing.
bool is_bowed(const Evidence& p, const Group& group) { return std::any_of(group.members.begin(), group.members.end(), [&](const Member& m) { return p.patch(m).bowed; }); }

/// The earlier group from which this one does not differ significantly, and its members' directions there.
int equivalent_group(const Evidence& p, const Group& group, const std::vector<Group>& earlier,
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

/// Appends a group to the nodes, with its relations to them.
void relate_to_earlier(const Evidence& p, Group group, std::vector<Group>& nodes, std::vector<Constraint>& constraints) {
  std::vector<Constraint> rows;
  relate(p, group, nodes, rows);
  constraints.insert(constraints.end(), rows.begin(), rows.end());
  nodes.push_back(std::move(group));
}

}  // namespace

Reconciled reconcile(const Selection& selection, const Patches& patches, const std::vector<Vec3>& locals,
                     const AngleSet& angles, const Space& space) {
  const Evidence p{patches.patches, locals, angles, space, certain_at(selection.lambda)};
  Reconciled result;
  if (selection.local_fits) {
    result.frames = selection.frames;
    result.frame_of_patch = selection.frame_of_patch;
    result.local_of_patch = selection.local_of_patch;
    return result;
  }
  std::vector<Group> nodes, bowed;
  for (Group& group : groups_of(p, selection)) {
    if (is_bowed(p, group)) {
      bowed.push_back(std::move(group));
      continue;
    }
    group.frame = fit_constrained(p, group.frame, group.members, {}, {});
    std::vector<Member> members;
    if (const int g = equivalent_group(p, group, nodes, members); g >= 0) {
      nodes[g].members.insert(nodes[g].members.end(), members.begin(), members.end());
      nodes[g].weight += group.weight;
      continue;
    }
    relate_to_earlier(p, std::move(group), nodes, result.constraints);
  }
  if (!space.is_2d() && part_by_chance(p, patches.adjoining, nodes)) {
    std::stable_sort(nodes.begin(), nodes.end(), [](const Group& a, const Group& b) { return a.weight > b.weight; });
    result.constraints.clear();
    for (Group& group : std::exchange(nodes, {})) {
      group.frame = fit_constrained(p, group.frame, group.members, {}, {});
      relate_to_earlier(p, std::move(group), nodes, result.constraints);
    }
  }
  nodes.insert(nodes.end(), std::make_move_iterator(bowed.begin()), std::make_move_iterator(bowed.end()));  // after all others, which are related to earlier ones
  for (const Group& node : nodes) result.frames.push_back(node.frame);
  result.frame_of_patch.assign(patches.patches.size(), -1);
  result.local_of_patch.assign(patches.patches.size(), -1);
  for (std::size_t g = 0; g < nodes.size(); ++g)
    for (const Member& m : nodes[g].members) {
      result.frame_of_patch[m.patch] = static_cast<int>(g);
      result.local_of_patch[m.patch] = m.local;
    }
  return result;
}

bool relate_again(Model& model, const AngleSet& angles, const Space& space) {
  if (model.local_fits) return false;
  std::vector<Patch> patches;  // known as well as in a refit
  for (const Surface& s : model.surfaces) {
    Patch& p = patches.emplace_back();
    p.fit = s.support.fit;
    p.area = s.support.area;
    p.bowed = s.support.bowed;
    std::tie(p.doubt_u, p.doubt_v) = tilt_variances(s.support);
  }
  const Evidence p{patches, model.locals, angles, space};
  std::vector<Group> nodes(model.frames.size());
  for (std::size_t f = 0; f < nodes.size(); ++f) nodes[f].frame = model.frames[f];
  for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
    Group& g = nodes[model.surfaces[s].frame];
    g.members.push_back({static_cast<int>(s), model.surfaces[s].local});
    g.weight += patches[s].area;
  }
  std::vector<Group> earlier;
  std::vector<Constraint> constraints;
  for (std::size_t f = 0; f < nodes.size(); ++f) {
    std::vector<Constraint> rows;
    for (const Constraint& c : model.constraints)
      if (c.a == static_cast<int>(f)) rows.push_back(c);
    if (is_bowed(p, nodes[f])) nodes[f].members.clear();
    if (!nodes[f].members.empty()) relate(p, nodes[f], earlier, rows);
    constraints.insert(constraints.end(), rows.begin(), rows.end());
    earlier.push_back(std::move(nodes[f]));
  }
  const bool more = constraints.size() > model.constraints.size();
  model.constraints = std::move(constraints);
  return more;
}

}  // namespace unseen::planes
