// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>

#include "unseen/core/options.h"
#include "unseen/planes/types.h"
#include "unseen/report/planes_result.h"
#include "unseen/report/point_sample.h"

namespace unseen::report {

/// report.html: one page that needs nothing else; pictures, table of planes, how it was made. `command` is
/// the command line that gives the same result. All text is escaped.
std::string planes_page(const planes::Arrangement& arrangement, const InputRecord& input,
                        const OptionTable& options, const std::string& command, const PointSample& points);

}  // namespace unseen::report
