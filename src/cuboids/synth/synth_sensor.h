// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#pragma once

#include <limits>
#include <vector>

#include "cuboids/synth/synth_builder.h"

namespace unseen::cuboids {

/// What a ray meets first.
struct RayHit {
  double distance = std::numeric_limits<double>::infinity();  ///< in lengths of the direction
  int body = -1;      ///< index of a box, −1 − index of a support, if distance is finite
  Vec3 normal = Vec3::Zero();
};

/// Boxes and bounded supports, intersected in closed form.
class RayScene {
 public:
  RayScene(const SynthModel& model, const std::vector<bool>& shown) : model_(model), shown_(shown) {}
  RayHit first_hit(const Vec3& origin, const Vec3& direction) const;

 private:
  const SynthModel& model_;
  const std::vector<bool>& shown_;
};

/// Fills exact depth, colour and masks of a view.
void render(const SynthModel& model, const std::vector<bool>& shown, const RigidTransform& T_world_camera, SynthView& view,
            Context& context);

/// What a structured-light camera makes of it: noise of disparity, rounded to its steps, together `noise` metres at
/// 1 m; pixels at depth edges and on surfaces seen edge-on drop out, and what is beyond its range.
std::vector<float> measure(const std::vector<float>& exact, const Camera& camera, double noise, double dropout,
                           Random& random);

}  // namespace unseen::cuboids
