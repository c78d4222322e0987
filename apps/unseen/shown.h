// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/core/context.h"

namespace unseen::cli {

/// A result as the page shows it.
struct Shown {
  std::string title, scene;
};

/// Reads the result of any capability, with what it was made from if that is still there. Throws InputError.
Shown read_shown(const std::string& out, Context& context);

}  // namespace unseen::cli
