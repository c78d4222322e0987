// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "report/interactions_motion.h"


#include "unseen/core/quantile.h"

namespace unseen::report {

using namespace interactions;

std::array<double, kBones.size()> bone_lengths(const Person& person) {
  std::array<double, kBones.size()> lengths = {};
  if (person.frames.empty()) return lengths;
  for (std::size_t b = 0; b < kBones.size(); ++b) {
    std::vector<double> all;
    for (const PersonFrame& f : person.frames) all.push_back((f.pose.col(kBones[b][1]) - f.pose.col(kBones[b][0])).norm());
    lengths[b] = median(std::move(all));
  }
  return lengths;
}

}  // namespace unseen::report
