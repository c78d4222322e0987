// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <optional>

#include "interactions/ground/sight.h"
#include "interactions/synth/synth_furniture.h"

namespace unseen::interactions {

/// Where the camera stands: 0.8 to 1.8 m high.
View draw_view(int width, int height, Random& random);

/// The floor that people walk on, m: between walls and within the camera's sight.
struct Floor {
  double left = 0, right = 0, near = 0, far = 0;
  double slope = 1;  ///< |x| ≤ slope · y is seen

  bool contains(const Vec2& p, double margin) const;
};

struct Room {
  Floor floor;
  std::vector<Piece> pieces;
};

/// A room with so many pieces, none in the way of another. Fewer only if there is really no place.
Room draw_room(const View& view, int pieces, Random& random);

/// Distance of a point on the ground to the piece's footprint, m; 0 inside.
double ground_distance(const Piece& piece, const Vec2& p);

}  // namespace unseen::interactions
