// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "planes/scan/scale.h"
#include "planes/selection/select.h"
#include "unseen/planes/types.h"

namespace unseen::planes {

/// A relation between two frames that is kept exactly: (R_a·u)·(R_b·v) = cosine. A shared axis is two of them
/// with cosine 0 (a table turned on the floor keeps the floor's up and may only turn about it).
struct Constraint {
  int a = -1, b = -1;  ///< nodes; a comes after b
  Vec3 u, v;           ///< unit, in the frames' own coordinates
  double cosine = 0;
};

/// One exact plane in space, which several planes of the result may share (coplanar ones).
struct Surface {
  int frame = -1, local = -1;  ///< indices into Model::frames and Model::locals
  Patch support;               ///< all that lies on it
  double offset = 0;
};

/// A plane on its way to the result: a connected part of a surface.
struct Part {
  int surface = -1;
  std::vector<int> cells;  ///< voxels, ascending
};

/// Everything the refit changes together.
struct Model {
  std::vector<Vec3> locals;
  std::vector<OrientationFrame> frames;  ///< the one with the most area first
  std::vector<Constraint> constraints;   ///< independent of each other, by rising `a`
  std::vector<Surface> surfaces;
  std::vector<Part> parts;
  bool local_fits = false;  ///< every patch keeps its own fit, related to no other
  double certain = kCertain;  ///< χ² by its noise, from which a surface is certainly turned out of its own points: the more, the more one frame is asked for

  Vec3 normal(const Surface& s) const { return frames[s.frame].direction(locals[s.local]); }
  Plane plane(const Part& p) const { return {normal(surfaces[p.surface]), surfaces[p.surface].offset}; }
};

/// Turns a selection into a model: frames that do not differ significantly become one, relations between
/// frames that do not fail significantly become constraints, patches of one direction that adjoin within the
/// scale become one part, and parts whose offsets do not differ significantly share a surface.
Model build_model(const Selection& selection, const Patches& patches, const VoxelGrid& grid, const Cells& cells,
                  const AngleSet& angles, const Space& space, Context& context);

/// Least squares over all surfaces at once with every relation kept exact: a rotation a frame, an offset a surface.
void refit(Model& model);

/// Whether a plane of this normal certainly turns a patch off its own points, by more than half of what these are off their own plane.
bool is_turned_out(const Model& model, const Patch& patch, const Vec3& normal);

/// Refits, and gives surfaces that their frame turned out of their own points a frame of their own: the relations of many small ones
/// must not carry away a large one that knows better.
void refit_held(Model& model, double tolerance, const Space& space);

/// Adds the relations between frames that show only in the surfaces as refitted, where these do not differ significantly from them by their
/// noise; true if there are any.
bool relate_again(Model& model, const AngleSet& angles, const Space& space);

/// Replaces a surface's moments, e.g. by those of the points assigned to it; its variances are scaled along, but noise counts as no less than
/// `least_noise` (m): of an image, whole strokes lie exactly in a row of pixels.
void update_support(Surface& surface, const Moments& moments, const Space& space, double least_noise);

/// Of surfaces that are much thicker than the `noise` (m), the sheet with most of the sample's points is what supports them: a door's leaf has two sides.
void keep_main_sheets(Model& model, const Survey& survey, const VoxelGrid& grid, const Space& space, double noise, double tolerance, const Context& context);

/// Variances (rad²) of a surface's tilts along u and v in refits.
std::pair<double, double> tilt_variances(const Patch& support);

/// A surface's normal as a residual: how far it turns from its fit along one of the fit's axes, and how precise
/// that is. Turning its frame by w changes `value` by w·jacobian.
struct TiltResidual {
  Vec3 jacobian;
  double value, weight;
};
std::array<TiltResidual, 2> tilt_residuals(const PlaneFit& fit, const Vec3& normal, double variance_u,
                                           double variance_v);

/// How a constraint fails, and its change with a turn w of frame a: w·jacobian (of frame b: −w·jacobian).
struct ConstraintResidual {
  Vec3 jacobian;
  double value;
};
ConstraintResidual residual_of(const Constraint& c, const Mat3& axes_a, const Mat3& axes_b);

/// `axes` turned by the rotation vector w, orthonormal to rounding.
Mat3 turned(const Mat3& axes, const Vec3& w);

}  // namespace unseen::planes
