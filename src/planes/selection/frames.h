// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>
#include <vector>

#include "planes/patches/patches.h"

namespace unseen::planes {

/// Θ: the angles that a scene repeats.
struct AngleSet {
  std::vector<double> all;  ///< rad, ascending in [0, π): 0 and the multiples below π of every generator
  bool has_right_angle = false;

  /// How far `angle` (rad, of two directions, any sign) is from the nearest angle of Θ.
  double deviation(double angle) const;
};

/// Θ from its generators (rad).
AngleSet make_angles(const std::vector<double>& generators);

/// Orientation frame. `local` holds its directions in frame coordinates; they are the axes and what turning
/// an axis about another by an angle of Θ gives. An open frame is a single direction that nothing closes yet.
struct OrientationFrame {
  Mat3 axes = Mat3::Identity();  ///< columns, right-handed; of an open frame only the first one means anything
  bool closed = false;

  Vec3 direction(const Vec3& local) const { return axes * local; }
};

/// Directions of a closed frame in frame coordinates, without sign, the axes first. In 2D the third axis is
/// the flat one, and all directions are orthogonal to it.
std::vector<Vec3> local_directions(const AngleSet& angles, const Space& space);

/// The frame that directions `a` and `b` (at about `angle`) close: the first axis is `a`, the third is
/// orthogonal to both, or the flat axis.
OrientationFrame close_frame(const Vec3& a, const Vec3& b, const Space& space);
OrientationFrame open_frame(const Vec3& a, const Space& space);

/// Irr between two frames: f(x) = 1 − exp(−3x) of the mean deviation of their directions (thesis Eq. 3.2 and
/// Section 3.4, made a mean over directions so that frames that share an axis cost less).
double irregularity(const OrientationFrame& a, const OrientationFrame& b, const std::vector<Vec3>& locals,
                    const AngleSet& angles);

/// χ²: by how many standard errors, squared, a patch's fitted normal differs from `normal`.
double tilt_chi2(const Patch& patch, const Vec3& normal);

/// The same by noise alone, and from where on a patch is certainly turned off its fit.
constexpr double kCertain = 25.0;
double noise_chi2(const Patch& patch, const Vec3& normal);
/// kCertain, or more where λ asks for fewer frames than by default: infinite at 0.
double certain_at(double lambda);

/// Directions that differ by less, rad, are one orientation.
constexpr double kSameOrientation = 0.5 * kPi / 180.0;

/// D: what it costs to give a patch the orientation `normal` (Eq. 3.7 in terms of significance): near zero
/// within a standard error, 1 at three, and growing with the squared tilt beyond.
double data_cost(const Patch& patch, const Vec3& normal);

/// The cheapest candidate that a frame offers a patch.
struct Candidate {
  double cost = std::numeric_limits<double>::infinity();
  int local = -1;  ///< index into local_directions; 0 for an open frame
};
Candidate best_candidate(const Patch& patch, const OrientationFrame& frame, const std::vector<Vec3>& locals,
                         double angle);

}  // namespace unseen::planes
