// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "unseen/core/context.h"
#include "unseen/cuboids/truth.h"
#include "unseen/cuboids/types.h"

namespace unseen::cuboids {

struct EvaluateOptions {
  double tolerance = 0.01;  ///< m: initial boxes this near each other count as touching
  bool referee = true;      ///< let MuJoCo decide whether the result stands
  double seconds = 2.0;     ///< s, how long it may fall
  double friction = 0.7;    ///< μ of the referee
};

/// Edges of a contact graph against the true ones. An edge is right if both ends and the kind are.
struct GraphScore {
  std::size_t edges = 0, true_edges = 0, correct = 0;
  double precision = 0, recall = 0, f1 = 0;  ///< shares; 0 where there is nothing to divide by
};

/// Share of sizes that is right: the mean of max(0, 1 − |s − s_true| / s_true), so that too long counts like too short.
/// A true box that was not found counts 0.
struct SizeScore {
  std::size_t dimensions = 0;
  double fitted = 0;     ///< initial boxes
  double dropped = 0;    ///< these, each extended down to what is below
  double fused = 0;      ///< collinear pieces made one, then dropped
  double completed = 0;  ///< the result
};

/// Thesis Eq. 4.5–4.6: sizes that the completion changed by more than 5 %, weighted by the true size.
struct ChangeScore {
  std::size_t dimensions = 0;  ///< that moved
  double before = 0, after = 0;  ///< weighted mean of |s − s_true| / s_true
  double change = 0;             ///< weighted mean of the absolute change of it, as printed
};

struct PoseScore {
  std::size_t boxes = 0;  ///< matched ones
  double iou_before = 0, iou_after = 0;  ///< mean 3D intersection over union
  double center = 0;                     ///< m, mean distance of centres
  double angle = 0;                      ///< rad, mean, of the nearest of the box's equivalent orientations
};

/// How well the extensions fill what was hidden: pooled over all matched boxes.
struct HiddenPartScore {
  double extension = 0, hidden = 0;  ///< m³: completed without initial; true without initial
  double iou = 0;
};

struct RefereeScore {
  std::size_t bodies = 0, still = 0;  ///< boxes that the result calls supported; those that moved less than 5 %
  double share = 0;
  double farthest = 0;  ///< share of its longest side that the worst of them moved
  std::vector<int> moved;  ///< ids of those that did not stay
};

struct Evaluation {
  std::size_t cuboids = 0, true_cuboids = 0;
  std::size_t found = 0;  ///< true boxes that a result box stands for
  GraphScore contacts_before, contacts_after;
  SizeScore sizes, seen_sizes, hidden_sizes;
  ChangeScore change;
  std::optional<PoseScore> pose;                ///< if the truth has poses
  std::optional<HiddenPartScore> hidden_part;   ///< if the truth has poses
  std::optional<RefereeScore> referee;          ///< if it was asked for and this build has MuJoCo
};

/// Measures a result against what is true (design: thesis Tables 4.1–4.3). The truth is carried into the result's world
/// by the camera. Result boxes stand for the true box that they share most volume with (without poses: most visible
/// points); several may stand for one, of which the best counts for pose, and all that are fixed to it for size.
/// Warns where a measure had to be left out. Throws InputError for a truth without cuboids or an option out of range.
Evaluation evaluate(const Completion& result, const Truth& truth, const EvaluateOptions& options, Context& context);

/// What can be measured without a truth: whether the result stands in MuJoCo.
Evaluation evaluate(const Completion& result, const EvaluateOptions& options, Context& context);

/// m³, of the intersection of two boxes, exactly.
double intersection_volume(const OrientedBox& a, const OrientedBox& b);
/// Intersection over union of two boxes' volumes.
double intersection_over_union(const OrientedBox& a, const OrientedBox& b);

}  // namespace unseen::cuboids
