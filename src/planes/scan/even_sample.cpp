// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/even_sample.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace unseen::planes {
namespace {

constexpr std::size_t kOfBucket = 8;

std::uint64_t mix(std::uint64_t h) {
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ull;
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBull;
  return h ^ (h >> 31);
}

}  // namespace

std::uint64_t hash_of(const Vec3& p) {
  std::uint64_t h = 0x9E3779B97F4A7C15ull;
  for (int a = 0; a < 3; ++a) h = mix(h + std::bit_cast<std::uint64_t>(p[a] + 0.0));
  return h;
}

void EvenSample::add(const Sampled& x) {
  std::uint32_t& slot = slot_of(x.hash);
  if (slot == 0) {
    places_.push_back(x);
    slot = static_cast<std::uint32_t>(places_.size());
    if (places_.size() > kMost) thin();
    if (2 * places_.size() > slots_.size()) fill(2 * slots_.size());
    return;
  }
  twins_ = true;
  Sampled& known = places_[slot - 1];
  if (hash_of(x.normal.cast<double>()) < hash_of(known.normal.cast<double>())) known.normal = x.normal;
}

LargeVector<Sampled> EvenSample::by_hash() const {
  const auto less = [](const Sampled& a, const Sampled& b) { return a.hash < b.hash; };
  // Hashes are spread evenly: buckets of their leading digits hold a few places each.
  const int digits = std::bit_width(places_.size() / kOfBucket);
  const auto bucket_of = [&](const Sampled& x) { return digits == 0 ? 0 : (x.hash << zeros_) >> (64 - digits); };
  std::vector<std::uint32_t> first((std::size_t{1} << digits) + 1, 0);
  for (const Sampled& x : places_) ++first[bucket_of(x)];
  std::partial_sum(first.begin(), first.end(), first.begin());
  LargeVector<Sampled> sorted(places_.size());
  for (const Sampled& x : places_) sorted[--first[bucket_of(x)]] = x;
  for (std::size_t b = 0; b + 1 < first.size(); ++b) std::sort(sorted.begin() + first[b], sorted.begin() + first[b + 1], less);
  return sorted;
}

std::uint32_t& EvenSample::slot_of(std::uint64_t hash) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = hash & mask;
  while (slots_[at] != 0 && places_[slots_[at] - 1].hash != hash) at = (at + 1) & mask;
  return slots_[at];
}

void EvenSample::thin() {
  while (places_.size() > kMost) {
    ++zeros_;
    std::erase_if(places_, [&](const Sampled& x) { return !wants(x.hash); });
  }
  fill(slots_.size());
}

void EvenSample::fill(std::size_t slots) {
  slots_.assign(slots, 0);
  for (std::size_t i = 0; i < places_.size(); ++i)
    slot_of(places_[i].hash) = static_cast<std::uint32_t>(i + 1);
}

}  // namespace unseen::planes
