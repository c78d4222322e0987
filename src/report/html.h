// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <string_view>

namespace unseen::report {

/// Text for HTML content and attributes: & < > " ' are replaced, and so are control characters and what is
/// not UTF-8.
std::string escape(std::string_view text);

}  // namespace unseen::report
