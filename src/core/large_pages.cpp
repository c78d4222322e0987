// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "core/large_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace unseen {

void prefer_large_pages(void* begin, std::size_t bytes) {
  constexpr std::uintptr_t kPage = std::uintptr_t{1} << 21;
  const auto from = reinterpret_cast<std::uintptr_t>(begin);
  const std::uintptr_t first = (from + kPage - 1) & ~(kPage - 1), last = (from + bytes) & ~(kPage - 1);
  if (first < last) madvise(reinterpret_cast<void*>(first), last - first, MADV_HUGEPAGE);
}

}  // namespace unseen
