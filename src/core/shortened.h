// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <string>

namespace unseen {

/// At most so many bytes of a text, and "…" if there are more; no character of UTF-8 is cut in two.
std::string shortened(std::string text, std::size_t most);

}  // namespace unseen
