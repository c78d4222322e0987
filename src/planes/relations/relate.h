// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "planes/arrange.h"

namespace unseen::planes {

/// χ² beyond which constraints are refused: three standard errors for one, two and three degrees of freedom.
constexpr double kSignificant[] = {0.0, 9.0, 11.8, 14.2};

/// A patch (index) in a group, and the direction (index of a local one) that it has there.
struct Member {
  int patch, local;
};

/// An orientation frame on its way to a node of the model, with what has its directions.
struct Group {
  OrientationFrame frame;
  std::vector<Member> members;
  double weight = 0;  ///< m², area of the members
};

/// What is known of all patches.
struct Evidence {
  const std::vector<Patch>& patches;
  const std::vector<Vec3>& locals;
  const AngleSet& angles;
  const Space& space;
  double certain = kCertain;  ///< χ² by its noise, from which a patch certainly contradicts its frame

  const Patch& patch(const Member& m) const { return patches[m.patch]; }
};

/// Of all members against their directions.
double chi2(const Evidence& known, const OrientationFrame& frame, const std::vector<Member>& members);

/// The frame turned to suit its members best while constraints against earlier groups hold.
OrientationFrame fit_constrained(const Evidence& known, OrientationFrame frame, const std::vector<Member>& members,
                                 const std::vector<Constraint>& constraints, const std::vector<Group>& earlier);

/// Log of how much likelier the patches' normals are if they share the group's frame, whatever its rotation, than if each lay anyhow. A single
/// patch has none.
double log_evidence(const Evidence& known, const Group& group);

/// Gives patches that their group would turn off their own points a group of their own, where chance explains that they suit the frame: among
/// many frames each patch is near a direction of some. Patches that adjoin come together more easily. True if there are any.
bool part_by_chance(const Evidence& known, const std::vector<std::pair<int, int>>& adjoining, std::vector<Group>& groups);

/// Adds each relation of a group to an earlier one, which its members do not contradict significantly and which is no chance, to those
/// it has; its frame is turned along.
void relate(const Evidence& known, Group& group, const std::vector<Group>& earlier, std::vector<Constraint>& constraints);

}  // namespace unseen::planes
