// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "interactions/layout/gather_objects.h"
#include "interactions/matching/windows.h"
#include "unseen/interactions/options.h"

namespace unseen::interactions {

/// One person's part of a take, as the scenelets tell it.
struct Story {
  int person = 0;
  std::vector<Sight> sights;
  std::vector<Reading> readings;  ///< they point into `sights`
  Path path;
  std::vector<Choice> windows;
};

Story read_story(std::vector<Sight> sights, int person, const Database& database, const View& view, double fps, const Options& options,
                 const Context& context);

/// What all good matches together say of the ground (thesis Section 7.4).
EvidenceMap evidence_of(const std::vector<Story>& stories, const Database& database);

/// Objects that people use, with the windows that prove them. `evidence` prices them.
std::vector<FoundObject> find_objects(const std::vector<Story>& stories, const Database& database, const EvidenceMap& evidence, const View& view,
                                      const Options& options);

/// All people's windows, in the order in which FoundObject::windows counts them.
std::vector<Window> windows_of(const std::vector<Story>& stories, const Database& database);

/// A person's poses and likelihood of interaction.
Person person_of(const Story& story, const Database& database, const View& view, double fps);

}  // namespace unseen::interactions
