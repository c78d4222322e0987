// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

namespace unseen::collision {

/// Which terms take part; `soft` is the thesis's form with free states after the impact.
struct Terms {
  bool soft = false;
  bool momentum = true, impulse = true;  ///< soft form only
  bool energy = true, restitution = true, gravity = true, size = true, orientation = true;
};

/// From the options `physics` and `without`. Throws InputError for a term that does not exist.
Terms terms_of(const std::string& physics, const std::string& without);

}  // namespace unseen::collision
