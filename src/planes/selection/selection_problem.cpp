// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <algorithm>
#include <cmath>

#include "planes/selection/select.h"

namespace unseen::planes {

SelectionProblem make_problem(const Patches& patches, const std::vector<int>& members,
                              const std::vector<OrientationFrame>& frames, std::size_t fixed,
                              const AngleSet& angles, const std::vector<Vec3>& locals, double lambda,
                              double patch_angle, const SelectionProblem& known, const Context& context) {
  SelectionProblem p;
  p.lambda = lambda;
  const int rows = static_cast<int>(members.size()), cols = static_cast<int>(frames.size()), old = known.frames();
  p.data = Table<double>(rows, cols, 0.0);
  p.orientation = Table<int>(rows, cols, -1);
  p.irregularity = Table<double>(cols, cols, 0.0);
  p.fixed.assign(cols, 0);
  std::fill(p.fixed.begin(), p.fixed.begin() + static_cast<std::ptrdiff_t>(fixed), 1);

  std::vector<Vec3> orientations;
  std::vector<std::vector<int>> orientation_of(cols);  // per frame and local direction
  for (int k = 0; k < cols; ++k)
    for (std::size_t l = 0; l < (frames[k].closed ? locals.size() : 1); ++l) {
      const Vec3 n = frames[k].direction(locals[l]);
      const auto it = std::find_if(orientations.begin(), orientations.end(), [&](const Vec3& o) {
        return std::abs(o.dot(n)) > std::cos(kSameOrientation);
      });
      orientation_of[k].push_back(static_cast<int>(it - orientations.begin()));
      if (it == orientations.end()) orientations.push_back(n);
    }
  p.data.set_corner(known.data);
  p.orientation.set_corner(known.orientation);
  p.irregularity.set_corner(known.irregularity);
  parallel_blocks(context, cols - old, 8, [&](std::size_t begin, std::size_t end) {
    for (int k = old + static_cast<int>(begin); k < old + static_cast<int>(end); ++k) {
      for (int j = 0; j < rows; ++j) {
        const Candidate c = best_candidate(patches.patches[members[j]], frames[k], locals, patch_angle);
        p.data(j, k) = c.cost;
        if (c.local >= 0) p.orientation(j, k) = orientation_of[k][c.local];
      }
      for (int b = 0; b < k; ++b)
        p.irregularity(k, b) = p.irregularity(b, k) = irregularity(frames[k], frames[b], locals, angles);
    }
  });
  std::vector<int> row_of(patches.patches.size(), -1);
  for (int j = 0; j < rows; ++j) row_of[members[j]] = j;
  for (const auto& [a, b] : patches.neighbours)
    if (row_of[a] >= 0 && row_of[b] >= 0) p.neighbours.emplace_back(row_of[a], row_of[b]);
  return p;
}

}  // namespace unseen::planes
