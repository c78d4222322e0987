// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "cuboids/statics/statics.h"

namespace unseen::cuboids {

/// How a contact's force (in its own unit) acts on one of its bodies.
struct Lever {
  int body = -1;     ///< of the component, −1 = static
  double scale = 0;  ///< signed, unit/weight
  Vec3 arm;          ///< from the centre, in half sizes
};

struct ConeContact {
  Lever lever[2];
  Vec3 normal;
  double friction = 0, unit = 0;  ///< N
  int index = -1;                 ///< of the caller's contact
  int pair = -1;                  ///< of bodies, −1 = one is static
};

/// Movable bodies that touch each other, directly or through others.
struct Component {
  std::vector<int> bodies;
  std::vector<ConeContact> contacts;
  std::vector<std::pair<int, int>> pairs;
};

/// Bodies that are not static by components, each with its contacts in units of the load that may pass
/// through them. Throws std::invalid_argument for bodies without weight or size.
std::vector<Component> components_of(std::span<const Body> bodies, std::span<const ContactPoint> contacts);

}  // namespace unseen::cuboids
