// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "interactions/path.h"
#include "interactions/reading.h"

namespace unseen::interactions {

/// A scenelet's object that its person uses, laid into the scene by a match.
struct Vote {
  int person = 0;
  std::size_t reading = 0;
  int scenelet = -1;
  Object object;  ///< world
  Vec2 place = Vec2::Zero();  ///< of a seat where it is sat on, else the object's centre: what tells two objects apart
  double mass = 0;            ///< s, weight of the match times the time of its reading
  double share = 0;           ///< weight of the match
};

/// Votes of all matches of a person, with matches moved along the path's positions.
std::vector<Vote> votes_of(int person, const std::vector<Reading>& readings, const Path& path, const Database& database,
                           const std::vector<std::vector<bool>>& used, double seconds);

/// Objects where votes gather: of one superclass, near each other across the view and somewhat farther along it, for long enough and
/// convincingly enough. `members` has the votes of each.
struct Gathered {
  std::vector<FoundObject> objects;
  std::vector<std::vector<std::size_t>> members;
};
Gathered gather_objects(const std::vector<Vote>& votes, const View& view);

}  // namespace unseen::interactions
