// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "bench/cgal_planes.h"
#include "bench/planes_cases.h"

namespace unseen::bench {

/// Header and one line of the table; a figure that a case has no truth for stays empty.
std::string csv_header();
std::string csv_row(const Case& c, const Loaded& loaded, const std::string& method,
                    const Detection& detection, double peak_mb, double largest_relation_error_deg);
/// The line of a method that did not end: it ran out of time, or of memory.
std::string csv_failure(const Case& c, const std::string& method, const std::string& why);

}  // namespace unseen::bench
