// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "unseen/core/context.h"
#include "unseen/core/geometry.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

/// A model of a repository: points of its surface, upright (z up), in any unit.
struct RetrievalModel {
  std::string name;
  std::vector<Vec3> points;
};

struct RetrievalOptions {
  std::vector<int> ids;                ///< cuboids of the object; empty = the largest that hangs together by contacts
  double angle_step = radians(10.0);   ///< between the sampled turns about up, in (0, π]
  double tolerance = 0.03;             ///< of the structure's diagonal: what counts as covered, in (0, 0.5]
  std::uint64_t seed = 1;
};

/// How well a model fits the structure, and where.
struct RetrievedModel {
  int model = -1;              ///< index
  double score = 0;            ///< in [0, 2]: sum of the two shares
  double structure_share = 0;  ///< of points sampled on the structure, those with a covered vertex nearby
  double model_share = 0;      ///< of the vertices, those that the structure covers
  double scale = 1;            ///< from the model's unit to metres
  RigidTransform T_world_model;  ///< of the scaled model
};

struct Retrieval {
  std::vector<int> ids;                ///< cuboids of the structure
  std::vector<RetrievedModel> ranked;  ///< best first
};

/// Ranks models by how well they fill a completed structure (thesis, Section 4.5 (ii)): upright, scaled into its
/// bounding box, turned about up, refined by iterated closest points. Throws InputError for an id that is no cuboid's,
/// a scene without cuboids and models of which none has an extent; single ones without are a warning.
Retrieval retrieve_models(const Completion& scene, const std::vector<RetrievalModel>& models, const RetrievalOptions& options,
                          Context& context);

/// Ids of the cuboids that hang together by contacts with each other, the group of the largest volume.
std::vector<int> largest_structure(const Completion& scene);

}  // namespace unseen::cuboids
