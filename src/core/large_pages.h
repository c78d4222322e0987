// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace unseen {

/// Fresh memory in pages of 2 MB. Throws std::bad_alloc.
void* take_large_pages(std::size_t bytes);
void return_large_pages(void* begin, std::size_t bytes);
bool has_large_pages();

/// A part of a large page, of at least `bytes` (≤ kLargestPart). Parts that were returned are taken again: they never go back to the system.
void* take_part_of_page(std::size_t bytes);
void return_part_of_page(void* begin, std::size_t bytes);
constexpr std::size_t kSmallestPart = std::size_t{1} << 13, kLargestPart = std::size_t{1} << 20;

/// Memory of arrays that are filled once: to fill a page of 4 kB costs less than the fault of its first touch,
/// and large pages have a five hundredth of the faults. Small arrays are allocated as ever.
template <class T>
struct LargePages {
  using value_type = T;
  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>&) {}

  T* allocate(std::size_t count) {
    if (count > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_array_new_length();
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kSmallestPart || !has_large_pages()) return static_cast<T*>(::operator new(bytes, kAlign));
    return static_cast<T*>(bytes > kLargestPart ? take_large_pages(bytes) : take_part_of_page(bytes));
  }
  void deallocate(T* begin, std::size_t count) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes < kSmallestPart || !has_large_pages()) return ::operator delete(begin, kAlign);
    if (bytes > kLargestPart) return_large_pages(begin, bytes);
    else return_part_of_page(begin, bytes);
  }
  bool operator==(const LargePages&) const { return true; }

 private:
  static constexpr std::align_val_t kAlign{alignof(T)};
};

template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

}  // namespace unseen
