// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <ceres/evaluation_callback.h>
#include <ceres/problem.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "collision/solve/contact.h"
#include "collision/solve/unknowns.h"

namespace unseen::collision {

constexpr double kBound = 0.01;  ///< σ of restitution beyond [0,1] and of growing energy, as a share

/// One residual block with the name of the term that it belongs to.
struct NamedBlock {
  std::string term;
  ceres::ResidualBlockId id = nullptr;
};

/// What was seen of one body on one side of the impact, from there outwards: points or orientations of the problem.
struct SeenOutwards {
  int body = 0;
  bool after = false;
  std::vector<std::size_t> seen;
};

/// The unknowns and the state at them, made once for all terms of an evaluation.
struct EvaluatedState : ceres::EvaluationCallback {
  /// `free` are the unknowns that are varied.
  EvaluatedState(const Problem& problem, const State& reference, std::vector<int> free);
  void PrepareForEvaluation(bool jacobians, bool new_point) override;
  std::array<double, kUnknowns> unknowns() const;

  const Problem& problem;
  const State& reference;  ///< the unknowns are steps from it
  std::vector<int> free;
  std::vector<double> steps;  ///< of the free ones
  StateT<double> state;
  StateT<Wide> wide;  ///< with derivatives along the steps, if they were asked for
  std::vector<TurnedEnd> turned;  ///< to where each orientation of the problem was seen
  std::vector<SeenPlace> places;  ///< where each point of the problem was seen
  bool has_derivatives = false;

 private:
  void fly(const SeenOutwards& flight, bool derivatives);

  std::vector<SeenOutwards> flights_, turnings_;
};

/// Adds all terms of the problem to a Ceres problem that has `evaluation` as its callback. `touch` is where the shapes meet at the
/// impact, if they are known.
std::vector<NamedBlock> add_residuals(const std::optional<Proximity>& touch, EvaluatedState& evaluation, ceres::Problem& ceres);

}  // namespace unseen::collision
