// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "collision/synth/synth_body.h"
#include "unseen/collision/synth.h"

namespace unseen::collision {

/// Towards the one lamp of the scene, unit, world.
Vec3 to_lamp();

/// Share of the light that a surface of that normal (unit, world) throws back.
double lit(const Vec3& normal);

/// What a body is painted with: each face has its own two colours, in checks, stripes or rings; a ball has eight fields of two colours.
class Paint {
 public:
  Paint(const SynthBody& body, int number);
  /// Linear blue, green and red in [0,1] at a place in the body's axes; `face` is ignored for a ball.
  const Vec3& at(int face, const Vec3& place) const;

 private:
  struct Coat {
    Vec3 u, v;  ///< axes of the pattern, 1/m
    Vec3 colors[2];
  };
  bool ball_;
  std::vector<Coat> coats_;
};

/// What the camera sees where no body is: a wall with pictures on it, a floor, or a table from above.
struct Backdrop {
  double wall = 0;              ///< y of the wall, m
  std::optional<double> floor;  ///< z, m
  std::vector<Vec3> places;     ///< world coordinates of what each pixel shows, m
  std::vector<Vec3> colors;     ///< linear
};
Backdrop make_backdrop(const SynthShot& scene, std::uint64_t seed, Context& context);

/// Level of 0…255 of a linear intensity.
double encoded(double linear);
double linear(double level);

}  // namespace unseen::collision
