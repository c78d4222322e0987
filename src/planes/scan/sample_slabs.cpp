// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "planes/scan/sample_slabs.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace unseen::planes {

SampleSlabs::SampleSlabs(const Survey& survey) : sample_(survey.sample) {
  constexpr std::size_t kOfSlab = 64;  // points, on average
  const double extent = (survey.high - survey.low).maxCoeff(&axis_);
  const std::size_t slabs = 1 + sample_.size() / kOfSlab;
  low_ = survey.low[axis_];
  if (extent > 0) width_ = extent / static_cast<double>(slabs);
  first_.assign(slabs + 1, 0);
  for (const Vec3& p : sample_) ++first_[slab_of(p)];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  entries_.resize(sample_.size());
  for (std::size_t i = sample_.size(); i-- > 0;) entries_[--first_[slab_of(sample_[i])]] = {sample_[i], static_cast<std::uint32_t>(i)};
}

std::size_t SampleSlabs::slab_of(const Vec3& p) const {
  return std::min(static_cast<std::size_t>((p[axis_] - low_) / width_), first_.size() - 2);
}

Neighbourhood SampleSlabs::around(std::size_t probe, std::size_t points) const {
  const Vec3 center = sample_[probe];
  std::vector<std::pair<double, std::uint32_t>> nearest;  // a heap, the farthest first
  const auto farthest = [&] { return nearest.size() < points ? std::numeric_limits<double>::infinity() : nearest.front().first; };
  const auto look_into = [&](std::size_t slab) {
    for (std::uint32_t e = first_[slab]; e < first_[slab + 1]; ++e) {
      const std::pair<double, std::uint32_t> found{(entries_[e].point - center).squaredNorm(), entries_[e].place};
      if (nearest.size() == points) {
        if (!(found < nearest.front())) continue;
        std::pop_heap(nearest.begin(), nearest.end());
        nearest.pop_back();
      }
      nearest.push_back(found);
      std::push_heap(nearest.begin(), nearest.end());
    }
  };
  const std::size_t home = slab_of(center), slabs = first_.size() - 1;
  // A slab's points are at least as far as its nearer side, but for rounding.
  const auto beyond = [&](std::size_t slab) {
    const double side = width_ * static_cast<double>(slab < home ? slab + 1 : slab);
    const double apart = std::max(0.0, std::abs(side - (center[axis_] - low_)) - 1e-6 * width_);
    return apart * apart > farthest();
  };
  look_into(home);
  for (std::size_t s = home; s-- > 0 && !beyond(s);) look_into(s);
  for (std::size_t s = home + 1; s < slabs && !beyond(s); ++s) look_into(s);
  std::sort_heap(nearest.begin(), nearest.end());
  Neighbourhood result;
  for (const auto& [squared, place] : nearest) result.push_back(sample_[place]);
  return result;
}

}  // namespace unseen::planes
