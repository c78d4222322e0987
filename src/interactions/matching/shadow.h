// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <vector>

#include "unseen/core/geometry.h"

namespace unseen::interactions {

/// The volume that a box hides from a camera, as planes: a point is in it where none of their signed distances is positive (at most 3 faces that
/// look at the camera and 6 planes through the camera and an edge of the outline).
class Shadow {
 public:
  Shadow(const OrientedBox& box, const Vec3& camera);

  /// Signed distance to the shadow, negative where hidden: the largest distance to one of its planes, exact up to edges. `gradient` by the point.
  double distance(const Vec3& point, Vec3* gradient = nullptr) const;

 private:
  std::vector<Plane> planes_;
};

/// What it costs that a joint which is hardly detected is seen free: (c − ½)² v², v the distance to the nearest shadow, at most 1 m; 0 where c ≥ ½.
/// Thesis Eq. 6.4. `gradient` by the joint.
double occlusion_cost(const Vec3& joint, double confidence, const std::vector<Shadow>& shadows, Vec3* gradient = nullptr);

}  // namespace unseen::interactions
