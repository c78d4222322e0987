// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "interactions/matching/reading.h"
#include "interactions/people/path.h"

namespace unseen::interactions {

/// One scenelet for the frames from first to last.
struct Choice {
  std::size_t reading = 0, match = 0;
  int first = 0, last = 0;  ///< frames
};

/// Readings that are likely to show an interaction, thinned by non-maximum suppression; the frames between two belong to the nearer one.
/// `saliency` false: all that match well.
std::vector<Choice> find_windows(const std::vector<Reading>& readings, const Database& database, double fps, bool saliency);

/// For each window the scenelet of a sequence that fits the frames and joins on without jumps (dynamic programming over the best of each;
/// thesis Eqs. 6.9 and 6.10).
void choose_scenelets(std::vector<Choice>& windows, const std::vector<Reading>& readings, const Database& database, const Path& path, double fps,
                      bool smooth);

}  // namespace unseen::interactions
