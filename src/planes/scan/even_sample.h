// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/large_pages.h"
#include "unseen/core/geometry.h"

namespace unseen::planes {

/// Depends on the coordinates alone (0.0 and −0.0 are the same).
std::uint64_t hash_of(const Vec3& p);

struct Sampled {
  std::uint64_t hash;
  Vec3 position;
  Vec3f normal;
};

/// At most kMost of the places seen: those whose hash starts with enough zeros. Which these are depends on
/// all places seen, not on their order. A place is known by its hash, and holds the normal whose own hash is
/// smallest.
class EvenSample {
 public:
  explicit EvenSample(std::size_t expected) { places_.reserve(std::min(expected, kMost + 1)); }
  bool wants(std::uint64_t hash) const { return zeros_ == 0 || hash >> (64 - zeros_) == 0; }
  void add(const Sampled& x);
  bool twins() const { return twins_; }
  bool has_all() const { return zeros_ == 0; }
  LargeVector<Sampled> by_hash() const;

 private:
  static constexpr std::size_t kMost = 300'000;

  std::uint32_t& slot_of(std::uint64_t hash);
  void thin();
  void fill(std::size_t slots);

  int zeros_ = 0;
  bool twins_ = false;
  LargeVector<Sampled> places_;
  LargeVector<std::uint32_t> slots_ = LargeVector<std::uint32_t>(4096);  ///< a power of two; index + 1 into places_, 0 = free
};

}  // namespace unseen::planes
