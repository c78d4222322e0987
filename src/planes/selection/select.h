// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "planes/selection/frames.h"
#include "planes/selection/selection.h"
#include "unseen/planes/options.h"

namespace unseen::planes {

/// Which frame and which of its directions each patch has.
struct Selection {
  std::vector<OrientationFrame> frames;
  std::vector<int> frame_of_patch, local_of_patch;
  std::vector<OrientationFrame> proposed;  ///< for the largest patches
  Energy before, after;  ///< of every local fit kept, and of this selection
  double bound = 0;      ///< no selection from the same candidates, round by round, has less energy; without what `unbounded` rounds add
  std::vector<std::pair<SelectionProblem, double>> unbounded;  ///< rounds, and the energy that was found for them
  bool time_limit = false;
  bool local_fits = false;  ///< λ = 1: every patch keeps its own fit, related to no other
  double lambda = 0.5;      ///< it was made with
};

/// Frames that a set of patches may have, beside those given: single directions from clusters of patch
/// normals, and the closed frames that pairs of them, or of them and the axes of given frames, make.
/// `members` are the patches that may generate, the largest first.
std::vector<OrientationFrame> propose_frames(const Patches& patches, const std::vector<int>& members,
                                             const std::vector<OrientationFrame>& given, const AngleSet& angles,
                                             const Space& space, double patch_angle,
                                             const Context& context = Context());

/// Least-squares rotation of a frame to patches that have given directions of it, each weighted by its own
/// fit's variance and, where asked, by its area. An open frame, or one with members of a single direction, turns as little as it must.
OrientationFrame refit_frame(const OrientationFrame& frame, const std::vector<Vec3>& locals,
                             const std::vector<std::pair<const Patch*, int>>& members, bool by_area = false);

/// The numbers of a selection problem for some patches and frames. `known` is the problem of the same patches
/// and the first of these frames, if it was made before: what it knows is taken over.
SelectionProblem make_problem(const Patches& patches, const std::vector<int>& members,
                              const std::vector<OrientationFrame>& frames, std::size_t fixed,
                              const AngleSet& angles, const std::vector<Vec3>& locals, double lambda,
                              double patch_angle, const SelectionProblem& known = {},
                              const Context& context = Context());

/// Coarse to fine (thesis Algorithm 1): the largest patches choose their frames first; these stay, serve
/// smaller patches, and are not changed by them.
Selection select_frames(const Patches& patches, const AngleSet& angles, const Space& space,
                        const Options& options, Context& context);

/// Adds the lower bounds of the unbounded rounds to the selection's bound.
void state_bound(Selection& selection, const Context& context);

/// Orientations that much of a scene shares, of which the energy does not mind which frame has them: a proposed frame that suits much of
/// the area is added, and patches whose own orientation does not differ go to the frame that can have the most area.
void share_out(const Patches& patches, const AngleSet& angles, const Space& space, const Options& options, const Context& context, Selection& selection);

}  // namespace unseen::planes
