// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// From a selection to a model: what does not differ significantly is made one.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "planes/arrange.h"

namespace unseen::planes {
namespace {

// χ² beyond which a constraint is refused: three standard errors for one, two and three degrees of freedom.
constexpr double kSignificant[] = {0.0, 9.0, 11.8, 14.2};
constexpr double kShareAngle = 3.0 * kPi / 180.0;

struct Member {
  int patch, local;
};

struct Group {
  OrientationFrame frame;
  std::vector<Member> members;
  double weight = 0;
};

class Reconciler {
 public:
  Reconciler(const Patches& patches, const std::vector<Vec3>& locals, const AngleSet& angles, const Space& space)
      : patches_(patches), locals_(locals), angles_(angles), space_(space) {}

  const Patch& patch(const Member& m) const { return patches_.patches[m.patch]; }

  double chi2(const OrientationFrame& frame, const std::vector<Member>& members) const {
    double sum = 0;
    for (const Member& m : members) sum += tilt_chi2(patch(m), frame.direction(locals_[m.local]));
    return sum;
  }

  OrientationFrame fitted(const OrientationFrame& frame, const std::vector<Member>& members) const {
    std::vector<std::pair<const Patch*, int>> list;
    for (const Member& m : members) list.emplace_back(&patch(m), m.local);
    return refit_frame(frame, locals_, list);
  }

  /// The members' nearest directions in another frame; χ² of that in `sum`.
  std::vector<Member> relabel(const OrientationFrame& frame, std::vector<Member> members, double& sum) const {
    sum = 0;
    for (Member& m : members) {
      double least = std::numeric_limits<double>::infinity();
      for (std::size_t l = 0; l < (frame.closed ? locals_.size() : 1); ++l)
        if (const double c = tilt_chi2(patch(m), frame.direction(locals_[l])); c < least) {
          least = c;
          m.local = static_cast<int>(l);
        }
      sum += least;
    }
    return members;
  }

  /// The frame whose first axis is exactly `axis`, turned about it to suit its members best.
  OrientationFrame turned_about(const Vec3& axis, OrientationFrame frame, const std::vector<Member>& members) const {
    for (int iteration = 0; iteration < 10; ++iteration) {
      double information = 0, gradient = 0;
      for (const Member& m : members) {
        const Vec3 n = frame.direction(locals_[m.local]);
        const Patch& p = patch(m);
        const auto add = [&](const Vec3& u, double variance) {
          const double j = axis.dot(n.cross(u)), v = variance + kSystematicTilt * kSystematicTilt;
          information += j * j / v;
          gradient -= j * n.dot(u) / v;
        };
        add(p.fit.u, p.variance_u);
        add(p.fit.v, p.variance_v);
      }
      if (!(information > 0)) break;
      const double w = gradient / information;
      const Vec3 second = Eigen::AngleAxisd(w, axis) * frame.axes.col(1);
      frame.axes.col(0) = axis;
      frame.axes.col(1) = (second - second.dot(axis) * axis).normalized();
      frame.axes.col(2) = axis.cross(frame.axes.col(1));
      if (std::abs(w) < 1e-12) break;
    }
    return frame;
  }

  /// Joins `group` to a node if an axis of the node may be its own; true if that was done.
  bool share_axis(const Group& group, const std::vector<FrameNode>& nodes, FrameNode& result,
                  std::vector<Member>& members) const {
    const double free = chi2(group.frame, group.members);
    for (std::size_t g = 0; g < nodes.size(); ++g) {
      if (!nodes[g].frame.closed) continue;
      double best = kSignificant[2];
      for (int a = 0; a < 3; ++a) {
        const Vec3 axis = nodes[g].frame.axes.col(a);
        OrientationFrame start;
        start.closed = true;
        if (group.frame.closed) {
          int own = 0;
          for (int b = 1; b < 3; ++b)
            if (line_angle(group.frame.axes.col(b), axis) < line_angle(group.frame.axes.col(own), axis)) own = b;
          if (line_angle(group.frame.axes.col(own), axis) > kShareAngle) continue;
          const Vec3 other = group.frame.axes.col((own + 1) % 3);
          start.axes << axis, other, axis.cross(other);
        } else {
          const Vec3 d = group.frame.axes.col(0);
          if (std::abs(line_angle(d, axis) - kPi / 2) > kShareAngle || !angles_.has_right_angle) continue;
          start.axes << axis, d, axis.cross(d);
        }
        start.axes.col(1) = (start.axes.col(1) - start.axes.col(1).dot(axis) * axis).normalized();
        start.axes.col(2) = axis.cross(start.axes.col(1));
        double sum = 0;
        std::vector<Member> labelled = relabel(start, group.members, sum);
        const OrientationFrame frame = turned_about(axis, start, labelled);
        const double loss = chi2(frame, labelled) - free;
        if (loss >= best) continue;
        best = loss;
        result = {frame, static_cast<int>(g), a};
        members = std::move(labelled);
      }
      if (best < kSignificant[2]) return true;
    }
    return false;
  }

  std::vector<Group> groups(const Selection& selection) const {
    std::vector<Group> groups(selection.frames.size());
    for (std::size_t k = 0; k < groups.size(); ++k) groups[k].frame = selection.frames[k];
    for (std::size_t j = 0; j < patches_.patches.size(); ++j) {
      Group& g = groups[selection.frame_of_patch[j]];
      g.members.push_back({static_cast<int>(j), selection.local_of_patch[j]});
      g.weight += patches_.patches[j].area;
    }
    std::erase_if(groups, [](const Group& g) { return g.members.empty(); });
    std::stable_sort(groups.begin(), groups.end(), [](const Group& a, const Group& b) { return a.weight > b.weight; });
    return groups;
  }

  /// Nodes and, per node, its members.
  std::pair<std::vector<FrameNode>, std::vector<std::vector<Member>>> run(const Selection& selection) const {
    std::vector<FrameNode> nodes;
    std::vector<std::vector<Member>> members;
    for (Group& group : groups(selection)) {
      group.frame = fitted(group.frame, group.members);
      if (!absorb(group, nodes, members)) {
        FrameNode node{group.frame, -1, -1};
        std::vector<Member> own = group.members;
        if (!space_.is_2d()) share_axis(group, nodes, node, own);
        nodes.push_back(node);
        members.push_back(std::move(own));
      }
    }
    return {std::move(nodes), std::move(members)};
  }

 private:
  /// Gives the members of a group to a frame from which it does not differ significantly.
  bool absorb(const Group& group, std::vector<FrameNode>& nodes, std::vector<std::vector<Member>>& members) const {
    const double free = chi2(group.frame, group.members);
    const double limit = kSignificant[space_.is_2d() ? 1 : group.frame.closed ? 3 : 2];
    for (std::size_t g = 0; g < nodes.size(); ++g) {
      double sum = 0;
      std::vector<Member> labelled = relabel(nodes[g].frame, group.members, sum);
      if (sum - free >= limit) continue;
      bool within = true;
      for (const Member& m : labelled)
        within = within && line_angle(patch(m).fit.normal, nodes[g].frame.direction(locals_[m.local])) < kPi / 12;
      if (!within) continue;
      members[g].insert(members[g].end(), labelled.begin(), labelled.end());
      return true;
    }
    return false;
  }

  const Patches& patches_;
  const std::vector<Vec3>& locals_;
  const AngleSet& angles_;
  const Space& space_;
};

}  // namespace

Model build_model(const Selection& selection, const Patches& patches, const VoxelGrid& grid, const Cells& cells,
                  const AngleSet& angles, const Space& space, Context& context) {
  Model model;
  model.locals = local_directions(angles, space);
  auto [nodes, members] = Reconciler(patches, model.locals, angles, space).run(selection);
  model.nodes = std::move(nodes);
  context.check();

  // One number for each direction in space, so that shared axes count as one.
  const std::size_t n = patches.patches.size();
  std::vector<std::pair<int, int>> label(n);  // node, local
  for (std::size_t g = 0; g < members.size(); ++g)
    for (const Member& m : members[g]) label[m.patch] = {static_cast<int>(g), m.local};
  const auto normal_of = [&](std::size_t j) {
    return model.nodes[label[j].first].frame.direction(model.locals[label[j].second]);
  };

  // Patches of one orientation that adjoin within the scale become one plane, the most alike first.
  std::vector<int> group(n);
  std::iota(group.begin(), group.end(), 0);
  const auto root = [&](int j) {
    while (group[j] != j) j = group[j] = group[group[j]];
    return j;
  };
  std::vector<Moments> sums(n);
  for (std::size_t j = 0; j < n; ++j) sums[j] = patches.patches[j].moments;
  struct Join {
    double gap;
    int a, b;
  };
  std::vector<Join> joins;
  for (const auto& [a, b] : patches.neighbours) {
    const Vec3 normal = normal_of(a);
    if (line_angle(normal, normal_of(b)) > 1e-7) continue;
    joins.push_back({std::abs(normal.dot(sums[a].mean - sums[b].mean)), a, b});
  }
  std::stable_sort(joins.begin(), joins.end(), [](const Join& a, const Join& b) { return a.gap < b.gap; });
  for (const Join& join : joins) {
    const int a = root(join.a), b = root(join.b);
    if (a == b) continue;
    const double tolerance = std::min(cells.tolerance[patches.patches[a].cells.front()],
                                      cells.tolerance[patches.patches[b].cells.front()]);
    if (std::abs(normal_of(a).dot(sums[a].mean - sums[b].mean)) >= tolerance) continue;
    const int keep = std::min(a, b), gone = std::max(a, b);  // the larger patch gives the frame
    group[gone] = keep;
    sums[keep] += sums[gone];
  }
  for (std::size_t j = 0; j < n; ++j) {
    if (root(static_cast<int>(j)) != static_cast<int>(j)) continue;
    PlaneModel plane;
    std::tie(plane.frame, plane.local) = label[j];
    std::vector<int> members_cells;
    for (std::size_t k = j; k < n; ++k)
      if (root(static_cast<int>(k)) == static_cast<int>(j)) {
        const std::vector<int>& c = patches.patches[k].cells;
        members_cells.insert(members_cells.end(), c.begin(), c.end());
      }
    std::sort(members_cells.begin(), members_cells.end());
    plane.support = make_patch(grid, space, std::move(members_cells));
    model.planes.push_back(std::move(plane));
  }
  return model;
}

}  // namespace unseen::planes
