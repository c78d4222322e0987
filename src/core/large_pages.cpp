// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "core/large_pages.h"

#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <fstream>
#include <mutex>
#include <string>
#include <utility>

namespace unseen {
namespace {

constexpr std::size_t kPage = std::size_t{1} << 21;

std::size_t whole_pages(std::size_t bytes) { return (bytes + kPage - 1) & ~(kPage - 1); }

/// Parts of large pages, each of a power of two of bytes, kSmallestPart at least.
class Parts {
 public:
  void* take(std::size_t bytes) {
    const std::size_t size = size_of(bytes);
    const std::lock_guard lock(mutex_);
    Free*& first = free_[std::bit_width(size)];
    if (first != nullptr) return std::exchange(first, first->next);
    if (size > left_) {
      while (left_ > 0) {
        const std::size_t rest = std::bit_floor(left_);
        put_back(cut_off(rest), rest);
      }
      page_ = static_cast<char*>(take_large_pages(kPage));
      left_ = kPage;
    }
    return cut_off(size);
  }
  void give_back(void* part, std::size_t bytes) {
    const std::lock_guard lock(mutex_);
    put_back(part, size_of(bytes));
  }

 private:
  struct Free {
    Free* next;
  };
  static std::size_t size_of(std::size_t bytes) { return std::max(std::bit_ceil(bytes), kSmallestPart); }
  char* cut_off(std::size_t size) { return page_ + (left_ -= size); }
  void put_back(void* part, std::size_t size) {
    Free*& first = free_[std::bit_width(size)];
    first = new (part) Free{first};
  }
  std::mutex mutex_;
  std::array<Free*, 64> free_{};  // by the bits of their size
  char* page_ = nullptr;          // the latest one
  std::size_t left_ = 0;          // bytes of it, from its begin, that are not given away
};

Parts& parts() {
  static Parts& all = *new Parts;  // never destroyed: arrays may end after it would
  return all;
}

}  // namespace

bool has_large_pages() {
#ifdef __SANITIZE_ADDRESS__
  return false;  // the sanitizer watches only what it allocated itself
#else
  static const bool offered = [] {
    std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
    std::string line;
    return std::getline(file, line) && line.find("[never]") == std::string::npos;
  }();
  return offered;
#endif
}

void* take_large_pages(std::size_t bytes) {
  const std::size_t size = whole_pages(bytes);
  void* const taken = mmap(nullptr, size + kPage, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (taken == MAP_FAILED) throw std::bad_alloc();
  // A large page starts at a multiple of its size: what lies before and behind goes back.
  char* const from = static_cast<char*>(taken);
  char* const first = reinterpret_cast<char*>(whole_pages(reinterpret_cast<std::uintptr_t>(from)));
  if (first != from) munmap(from, static_cast<std::size_t>(first - from));
  if (const std::size_t behind = kPage - static_cast<std::size_t>(first - from); behind > 0) munmap(first + size, behind);
  madvise(first, size, MADV_HUGEPAGE);
  return first;
}

void return_large_pages(void* begin, std::size_t bytes) { munmap(begin, whole_pages(bytes)); }

void* take_part_of_page(std::size_t bytes) { return parts().take(bytes); }
void return_part_of_page(void* begin, std::size_t bytes) { parts().give_back(begin, bytes); }

}  // namespace unseen
