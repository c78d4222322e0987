// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include "unseen/io/describe.h"

namespace unseen::io {

OptionTable describe(ReadOptions& o) {
  constexpr double kInf = std::numeric_limits<double>::infinity();
  OptionTable table;
  table.add({"threshold",
             &o.threshold,
             "1",
             "images: pixels darker than this share of white become points",
             0,
             1,
             {}});
  table.add({"depth_range",
             &o.depth_range,
             "m",
             "depth folders: nearest and farthest depth that counts",
             0,
             kInf,
             {},
             {"nearest", "farthest"},
             true});
  table.add(
      {"depth_step", &o.depth_step, "", "depth folders: every n-th pixel in both directions", 1, 1e9, {}});
  table.add({"frame_step", &o.frame_step, "", "depth folders: every n-th frame", 1, 1e9, {}});
  return table;
}

}  // namespace unseen::io
