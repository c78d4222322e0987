// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace unseen::report {

/// Text for HTML content and attributes: & < > " ' are replaced, and so are control characters and what is
/// not UTF-8.
std::string escape(std::string_view text);

/// A table; cells are HTML already.
std::string html_table(const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows);

/// A whole page with the style of all reports: light and dark, legible on a phone, nothing from the network.
/// `title` is escaped here, `body` is HTML already.
std::string html_page(std::string_view title, const std::string& body);

}  // namespace unseen::report
