// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include "planes/scan/neighbourhoods.h"

namespace unseen::planes {

/// A survey's sample in slabs across its longest axis: for some hundred probes, to make and search them costs less than a tree.
class SampleSlabs {
 public:
  explicit SampleSlabs(const Survey& survey);
  /// At most `points` points around one of the sample; of those just as far, the ones that come first in the sample.
  Neighbourhood around(std::size_t probe, std::size_t points) const;

 private:
  struct Entry {
    Vec3 point;
    std::uint32_t place;  ///< in the sample
  };
  std::size_t slab_of(const Vec3& p) const;

  const LargeVector<Vec3>& sample_;
  int axis_ = 0;
  double low_ = 0, width_ = 1;       ///< m, along the axis
  std::vector<std::uint32_t> first_;  ///< [first_[s]…first_[s + 1]) are the entries of slab s
  LargeVector<Entry> entries_;
};

}  // namespace unseen::planes
