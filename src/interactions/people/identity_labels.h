// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstdint>
#include <vector>

#include "interactions/people/identity_costs.h"

namespace unseen::interactions {

constexpr int kMostPeople = 16;

/// Who may be at a detection: a bit a person.
using People = std::uint32_t;

/// What is known of who is who.
struct Allowed {
  std::vector<People> detection;  ///< of each detection
  std::vector<std::vector<int>> fixed;  ///< of each person, the slots in which it is known where, ascending
};

bool is_one(People people);

/// Who is known to be somewhere in a slot strictly between two.
People busy(const Allowed& allowed, int after, int before);

/// `allowed` with one person fixed to a detection: that person is nowhere else in its frame.
Allowed with_fixed(Allowed allowed, const Sightings& sightings, int detection, int person);

/// What the take's labels and named detections say. Throws InputError if that cannot be.
Allowed allowed_by_labels(const Take& take, const Sightings& sightings);

}  // namespace unseen::interactions
