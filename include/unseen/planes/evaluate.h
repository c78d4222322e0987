// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <vector>

#include "unseen/core/context.h"
#include "unseen/core/geometry.h"
#include "unseen/core/mesh.h"
#include "unseen/planes/types.h"

namespace unseen::planes {

/// How a result is measured.
struct EvaluateOptions {
  double scale = 0.0;          ///< ρ, m, > 0: how near the truth must be
  std::size_t pairs = 500000;  ///< point pairs drawn for the angles
  std::uint64_t seed = 1;      ///< of the pairs
};

/// Difference between the angle of two points' assigned normals and the angle of their true normals, each
/// folded to [0, π/2] first (normals have no sign), over random pairs of points. Angles in radians.
struct AngleScore {
  std::size_t pairs = 0;  ///< 0 if fewer than two points could be used; the rest is 0 then, too
  double mean = 0, median = 0, deviation = 0;
  double below_tenth = 0;  ///< share of pairs below 0.1°
  double below_one = 0;    ///< share of pairs below 1°
};

/// One way of treating points that have no plane. Only points with a true normal count here.
struct AssignmentScore {
  AngleScore angles;           ///< pairs of points that have a plane, the right one or not
  AngleScore angles_recalled;  ///< pairs of recalled points: a point on a wrong plane costs recall, not angle
  std::size_t used = 0;        ///< points that have a plane
  std::size_t recalled = 0;    ///< points whose projection on their plane is within ρ of that on the truth
  double recall = 0;           ///< their share of the points with a true normal
};

/// A result against a mesh or against another result. Every figure comes twice.
struct TruthScore {
  std::size_t points = 0;    ///< finite points; the others are left out everywhere
  std::size_t assigned = 0;  ///< of these, how many have a plane
  std::size_t ambiguous = 0;  ///< two triangles within ρ that differ by more than 10⁻⁴ rad: no true normal
  std::size_t uncovered = 0;  ///< no triangle within ρ (the other result: no plane): no true normal
  AssignmentScore
      as_assigned;  ///< a point without a plane is missed: no pair has it, and recall counts it as lost
  AssignmentScore nearest;  ///< a point without a plane first gets the nearest one
};

using MeshScore = TruthScore;
using ResultScore = TruthScore;

/// Measures an assignment of N points to infinite planes against the mesh they were sampled from.
/// plane_of_point: N indices into `planes`, -1 = none. The true normal of a point is that of the nearest
/// triangle, if one is within ρ; ambiguous and uncovered points have none. Degenerate triangles are ignored.
/// Throws InputError for arrays of unequal length, an index without a plane, ρ ≤ 0 or a mesh without area.
MeshScore evaluate_against_mesh(const std::vector<Vec3>& points, const std::vector<int>& plane_of_point,
                                const std::vector<Plane>& planes, const TriangleMesh& truth,
                                const EvaluateOptions& options, Context& context);

/// The same with another result for the same points as truth: the true normal of a point is that of the
/// plane it has there, and its projection on the truth is that on this plane. Points that the other result
/// leaves without a plane count as `uncovered`.
ResultScore evaluate_against_result(const std::vector<Vec3>& points, const std::vector<int>& plane_of_point,
                                    const std::vector<Plane>& planes,
                                    const std::vector<int>& true_plane_of_point,
                                    const std::vector<Plane>& true_planes, const EvaluateOptions& options,
                                    Context& context);

/// Every point without a plane (-1) gets the nearest infinite plane; the others keep theirs.
std::vector<int> assign_to_nearest(const std::vector<Vec3>& points, const std::vector<int>& plane_of_point,
                                   const std::vector<Plane>& planes, Context& context);

/// Region measures of Hoover et al., "An Experimental Comparison of Range Image Segmentation Algorithms",
/// PAMI 1996 (SegComp). A region that fits more than one of the first three counts where it fits best.
struct LabelScore {
  std::size_t planes = 0, labels = 0;  ///< regions found, regions in truth; both hold at least one point
  std::size_t correct = 0;             ///< pairs that cover at least the overlap of each other
  std::size_t over_segmented = 0;      ///< true regions cut into two or more
  std::size_t under_segmented = 0;     ///< found regions that join two or more
  std::size_t missed = 0;              ///< true regions in none of these
  std::size_t noise = 0;               ///< found regions in none of these
  double precision = 0, recall = 0, f1 = 0;  ///< of the correct pairs
};

/// Measures a segmentation against true labels of the same N points; negative = none, on both sides. Points
/// without a label count in the size of a found region. `overlap` in (0.5, 1].
/// Throws InputError for arrays of unequal length and for an overlap outside its range.
LabelScore evaluate_against_labels(const std::vector<int>& plane_of_point,
                                   const std::vector<int>& label_of_point, double overlap = 0.8);

/// What a result states about itself, measured on its own numbers.
struct RelationScore {
  std::size_t planes = 0, directions = 0, frames = 0, relations = 0, plane_relations = 0;
  double largest_error =
      0;  ///< rad, of any relation, of a plane against its direction, and of coplanar normals
  std::size_t near_misses = 0;  ///< pairs of planes between 0.01° and 1° off an angle of Θ
};
RelationScore evaluate_relations(const Arrangement& arrangement);

/// The angles of Θ, folded to [0, π/2], rising: 0 and the multiples below π of each generator (rad, > 0).
std::vector<double> folded_angles(const std::vector<double>& generators);

/// Pairs of planes whose angle is more than `exact` and less than `near` (rad) off every angle of Θ.
std::size_t count_near_misses(const std::vector<Plane>& planes, const std::vector<double>& generators,
                              double exact = radians(0.01), double near = radians(1.0));

}  // namespace unseen::planes
