// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <functional>
#include <vector>

#include "cuboids/search/problem.h"
#include "unseen/core/context.h"

namespace unseen::cuboids {

/// What an arrangement costs: compared in this order.
struct Cost {
  double fixed = 0;   ///< contacts; one that leads out of the part of the scene that is looked at counts half
  double volume = 0;  ///< m³
  double grounded = 0;  ///< fixed contacts with a ground or desk: what stands there is rarely glued to it
};
/// Lexicographic; volumes within a mm³ are equal.
bool cheaper(const Cost& a, const Cost& b);

/// The chosen hypotheses, and how sure it is that nothing is cheaper.
struct Choice {
  std::vector<int> chosen;  ///< indices into Problem::hypotheses, ascending
  std::vector<char> held;   ///< a body: nothing can support it, so it counts as held by something unknown
  Cost cost;
  double residual = 0;
  std::size_t nodes = 0, pruned = 0;
  bool optimal = true;
};

/// When to be content with the best arrangement found. The number of arrangements, of each part of the scene, makes the
/// same end on every machine; the time is a last resort.
struct SearchLimits {
  int arrangements = 2000;
  double seconds = 60.0;
};

/// True if the geometry of an arrangement is allowed (no extension into free space), beyond not penetrating.
using Admissible = std::function<bool(const Arrangement&)>;

/// Finds at most one hypothesis a pair such that the arrangement stands, without penetration, with the fewest fixed
/// contacts, then the least extended volume (design page, step 6), and of equals with the fewest contacts glued to the ground. Each unstable arrangement that is met gives a
/// collapse motion, and of the hypotheses that could stop it one must be chosen: a hitting set is searched by branch and
/// bound, so that few arrangements are ever balanced. Parts of the scene that do not touch are solved apart, the rest of
/// the scene taken as firm; parts that turn out to need each other are solved together.
Choice search_contacts(const Problem& problem, const Admissible& admissible, const SearchLimits& limits, Context& context);

}  // namespace unseen::cuboids
