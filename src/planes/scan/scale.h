// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "planes/scan/moments.h"
#include "planes/scan/voxel_builder.h"
#include "unseen/core/context.h"
#include "unseen/core/point_cloud.h"
#include "unseen/planes/options.h"

namespace unseen::planes {

/// What a first look at a source tells.
struct Survey {
  std::size_t points = 0, finite = 0, duplicates = 0;
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< bounding box of the points near others, m
  Box within;                                    ///< points outside lie far from all others: they are left out
  std::size_t without_normal = 0;                ///< finite points whose normal has no usable length
  std::vector<bool> duplicate;  ///< per point: a twin of one that stays; empty if there are none
  LargeVector<Vec3> sample;     ///< an even share of the finite points, chosen by their coordinates alone
  LargeVector<Vec3f> sample_normals;  ///< of the sample, if the source has normals
  double share = 1;             ///< how many of the distinct points the sample holds

  bool has_normals() const { return !sample_normals.empty(); }
  double extent() const { return (high - low).maxCoeff(); }
};

Survey survey(PointSource& source, Context& context);

/// The steps (m) that the sample's coordinates come in, as text with few decimals or a LAS file has them: 10ᵏ, a half or a quarter of it; 0 if there are none
/// of a 100 000th of the extent or more.
double rounding_of(const Survey& survey);

/// The space of a survey: 2D if all points share a coordinate, or lie in a slice between two such planes, and on lines.
Space space_of(const Survey& survey, bool declared_2d);

/// ρ, and how far points may lie from their plane: ρ as well, unless it was estimated from points that are sparse but precise.
struct Scale {
  double scale = 0, tolerance = 0;  ///< m
  double step = 0;                  ///< m, of the levels that coarse depth has left the points on, if they ask for the scale
  double gap = 0;                   ///< m, between the dashes of a drawing in pixels, if they ask for it
};

/// ρ as the larger of 1.25 times the distance to the sixth neighbour and four times the noise of small neighbourhoods, each the median over
/// probes of the surface; where coarse depth has left the points on levels, at least 2.5 steps of these; where
/// most of a drawing in pixels (of this width, m) is dashes, 1.25 times the gaps. Reads the source again if the survey's
/// sample holds only a part of it.
Scale estimate_scale(PointSource& source, const Survey& survey, const Space& space, Context& context, double pixel = 0.0);

/// ρ from the options, or estimated if they give none, with a warning of levels. Throws InputError if the scale exceeds the scene.
Scale choose_scale(PointSource& source, const Survey& survey, const Space& space, const Options& options,
                   Context& context, double pixel = 0.0);

/// Whether input normals may be relied upon: of usable length, and agreeing with PCA at most probes.
bool normals_usable(const Survey& survey, const Space& space, const Context& context = Context());

}  // namespace unseen::planes
