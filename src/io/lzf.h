// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <string>
#include <string_view>

namespace unseen::io {

/// Decompresses LZF, the compression of PCD files, to exactly `size` bytes; false if the data is broken.
bool lzf_decompress(std::string_view compressed, std::size_t size, std::string& result);

}  // namespace unseen::io
