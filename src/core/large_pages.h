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

/// Memory of arrays that are filled once: to fill a page of 4 kB costs less than the fault of its first touch,
/// and large pages have a five hundredth of the faults. Small arrays are allocated as ever.
template <class T>
struct LargePages {
  using value_type = T;
  LargePages() = default;
  template <class U>
  LargePages(const LargePages<U>&) {}

  static bool large(std::size_t count) { return count >= kLeast / sizeof(T) && has_large_pages(); }
  T* allocate(std::size_t count) {
    if (count > static_cast<std::size_t>(-1) / 2 / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(large(count) ? take_large_pages(count * sizeof(T)) : ::operator new(count * sizeof(T)));
  }
  void deallocate(T* begin, std::size_t count) {
    if (large(count)) return return_large_pages(begin, count * sizeof(T));
    ::operator delete(begin);
  }
  bool operator==(const LargePages&) const { return true; }

 private:
  static constexpr std::size_t kLeast = std::size_t{1} << 19;  // bytes
};

template <class T>
using LargeVector = std::vector<T, LargePages<T>>;

}  // namespace unseen
