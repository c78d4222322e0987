// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
// Random piles of boxes whose verdict is not known beforehand, and what statics says of them.
#pragma once

#include <cstdint>
#include <string>

#include "cuboids/engines.h"
#include "cuboids/statics/statics.h"

namespace unseen::test {

struct Stack {
  std::string kind;
  RigidScene scene;
};

/// One of towers, piles, bridges, counterweights and leaning planks, with exact contacts.
Stack random_stack(std::uint64_t seed);

/// Bodies and contact points of a scene: body 0 is what never moves.
struct Statics {
  std::vector<cuboids::Body> bodies;
  std::vector<cuboids::ContactPoint> contacts;
};
Statics statics_of(const RigidScene& scene, double tolerance = 1e-6);

struct Verdict {
  bool stands = false;
  double residual = 0, margin = 0;
  /// More than 10 % from the other verdict: it stands against a push of 0.1 g from every side and with 0.9 μ, or falls
  /// even with one of 0.1 g from any side and with 1.1 μ.
  bool is_clear = false;
};
Verdict decide(const RigidScene& scene);

}  // namespace unseen::test
