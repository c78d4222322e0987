// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "unseen/core/random.h"
#include "unseen/interactions/types.h"

namespace unseen::interactions {

/// A piece of furniture as one uses it. Its own frame: origin on the floor under its middle, +y to the front, where people sit down or stand.
struct Piece {
  Object object;        ///< in the world
  Placement placement;  ///< of the own frame in the world
  Vec2 half = Vec2::Zero();  ///< of the footprint, m
  double height = 0;    ///< of the whole, m
  double surface = 0;   ///< height of what one sits or lies on, or puts hands on, m
  double edge = 0;      ///< y of the front edge of that
  double depth = 0;     ///< from the edge to the backrest, or over the whole seat
  double room = 0;      ///< half the width in which one can sit or stand before it
  bool soft = false, rest = false;  ///< upholstered; with a backrest
  std::vector<std::array<double, 2>> levels;  ///< of a shelf: lowest and highest point of each compartment, m
  bool idle = false;    ///< nobody uses it, it stands by
  int table = -1;       ///< index of the table or desk that one sits at here
};

enum class Kind { chair, couch, armchair, stool, bed, dining_table, coffee_table, desk, shelf, sideboard };

/// A piece of the kind with sizes as furniture has, in its own frame.
Piece draw_piece(Kind kind, Random& random);

/// The piece at a place.
Piece placed(Piece piece, const Placement& placement);

/// The same piece with another of its four sides as the front (quarter turns counter-clockwise), for tables, which have no front.
Piece from_side(Piece piece, int quarter);

}  // namespace unseen::interactions
