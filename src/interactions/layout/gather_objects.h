// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "interactions/matching/reading.h"
#include "interactions/people/path.h"

namespace unseen::interactions {

/// A scenelet's object that its person uses, laid into the scene by a match.
struct UsedObject {
  int story = 0;
  std::size_t reading = 0;
  int scenelet = -1;
  Object object;  ///< world
  Vec2 place = Vec2::Zero();  ///< of a seat where it is sat on, else the object's centre: what tells two objects apart
  double mass = 0;            ///< s, weight of the match times the time of its reading
  double share = 0;           ///< weight of the match
  double likelihood = 0;      ///< of an interaction, at the reading
};

/// Used objects of all matches of a story, the matches moved along the path's positions.
std::vector<UsedObject> used_objects_in(int story, const std::vector<Reading>& readings, const Path& path, const Database& database,
                                        const std::vector<std::vector<bool>>& used);

/// Objects where used objects gather: of one superclass, near each other across the view and somewhat farther along it, for long enough and
/// convincingly enough. Where a table and a shelf would be one piece it is what more votes are for. `members` has the indices of each.
struct Gathered {
  std::vector<FoundObject> objects;
  std::vector<std::vector<std::size_t>> members;
};
Gathered gather_objects(const std::vector<UsedObject>& in_use, const View& view);

}  // namespace unseen::interactions
