// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <vector>

namespace unseen {

/// Asks for pages of 2 MB under the part of a block of fresh memory that can have them. Where the system gives
/// none, nothing changes. (The first touch of each page of 4 kB costs more than filling it.)
void prefer_large_pages(void* begin, std::size_t bytes);

/// Makes room for `count` elements, in large pages.
template <class T>
void reserve_large(std::vector<T>& v, std::size_t count) {
  v.reserve(count);
  prefer_large_pages(v.data(), count * sizeof(T));
}

}  // namespace unseen
