// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <vector>

#include "unseen/cuboids/check.h"

namespace unseen::report {

/// The verdict on an assembly as JSON (docs/formats.md): stability, contacts with forces by the names of the blocks,
/// and, of what falls, how it starts to.
std::string check_json(const cuboids::Check& check, const std::vector<cuboids::Block>& blocks,
                       const cuboids::CheckOptions& options);

}  // namespace unseen::report
